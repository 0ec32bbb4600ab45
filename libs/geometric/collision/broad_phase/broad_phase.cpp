#include "collision/broad_phase/broad_phase.h"

#include "collision/volumes/vector_units.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kRounding = 2e-6;  // share of the coordinates: bound of rounding
constexpr double kNear = 10.0;      // m: the same for all below

using FloatBox = Eigen::AlignedBox3f;

FloatBox box_from(const Eigen::Vector3d& p_WO, const CollisionBody& body) {
  FloatBox box;
  double farthest = kNear;
  for (const Eigen::Vector3d& vertex : body.mesh->vertices) {
    const Eigen::Vector3d p = body.X_FB * vertex - p_WO;
    farthest = std::max(farthest, p.lpNorm<Eigen::Infinity>());
    box.extend(p.cast<float>());
  }
  const auto rounding = static_cast<float>(kRounding * farthest);
  box.min().array() -= rounding;
  box.max().array() += rounding;
  return box;
}

// Query of Eigen's bounding volume tree.
struct NearBodies {
  const Eigen::Vector3f& centre;
  float squared;
  const std::vector<int>& pair_of;
  std::vector<int>& pairs;

  // NOLINTNEXTLINE(readability-identifier-naming)
  [[nodiscard]] bool intersectVolume(const FloatBox& box) const {
    return box.squaredExteriorDistance(centre) <= squared;
  }
  // NOLINTNEXTLINE(readability-identifier-naming)
  [[nodiscard]] bool intersectObject(int still) const {
    if (const int pair = pair_of[static_cast<std::size_t>(still)]; pair >= 0) {
      pairs.push_back(pair);
    }
    return false;  // go on
  }
};

}  // namespace

StaticBodies::StaticBodies(const CollisionWorld& world, const Eigen::Vector3d& p_WO) {
  std::vector<int> numbers(world.bodies().size(), -1);
  std::vector<int> still;
  std::vector<FloatBox> boxes;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!world.bodies()[i].moves()) {
      numbers[i] = static_cast<int>(still.size());
      still.push_back(numbers[i]);
      boxes.push_back(box_from(p_WO, world.bodies()[i]));
    }
  }
  tree_.init(still.begin(), still.end(), boxes.begin(), boxes.end());
  pair_of_.resize(numbers.size());
  for (const int body : world.moving()) {
    pair_of_[static_cast<std::size_t>(body)].assign(still.size(), -1);
  }
  for (std::size_t p = 0; p < world.pairs().size(); ++p) {
    const BodyPair& pair = world.pairs()[p];
    if (const int number = numbers[static_cast<std::size_t>(pair.b)]; number >= 0) {
      pair_of_[static_cast<std::size_t>(pair.a)][static_cast<std::size_t>(number)] =
          static_cast<int>(p);
    }
  }
}

void StaticBodies::append_near(int body, const Eigen::Vector3f& centre, float reach,
                               std::vector<int>& pairs) const {
  if (reach <= 0.0F) {
    return;
  }
  NearBodies near{centre, reach * reach, pair_of_[static_cast<std::size_t>(body)], pairs};
  Eigen::BVIntersect(tree_, near);
}

namespace {

// Upper bound of the error of single precision, m: at coordinates up to kNear, and for each metre
// beyond.
constexpr float kRootRounding = 2e-5F;
constexpr float kRoundingBeyond = 2e-6F;
constexpr float kNoPair = -1e30F;    // a radius that nothing is within
constexpr double kEverywhere = 1e9;  // m
constexpr std::size_t kLanes = 16;

// With fewer pairs, computing bounds of all distances is faster than searching the near ones.
constexpr std::size_t kMany = 600;

std::size_t full_lanes(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

void append_found(const std::uint32_t* near, std::span<const int> pairs_of_lanes,
                  std::vector<int>& pairs) {
  for (std::size_t first = 0; first < pairs_of_lanes.size(); first += kLanes) {
    for (std::uint32_t bits = near[first / kLanes]; bits != 0; bits &= bits - 1) {
      pairs.push_back(pairs_of_lanes[first + static_cast<std::size_t>(std::countr_zero(bits))]);
    }
  }
}

// Returns the column of each body, counted among the moving or among the fixed ones.
std::vector<std::size_t> columns(const CollisionWorld& world) {
  std::array<std::size_t, 2> count{};
  std::vector<std::size_t> column;
  column.reserve(world.bodies().size());
  for (const CollisionBody& body : world.bodies()) {
    column.push_back(count[body.moves() ? 1 : 0]++);
  }
  return column;
}

float rounding_beyond(double coordinate) {
  return kRoundingBeyond *
         std::max(0.0F, static_cast<float>(coordinate) - static_cast<float>(kNear));
}

// The world's origin, or one nearer to a robot that is far from it; in whole steps, so that the
// change of origin is exact.
Eigen::Vector3d origin_near(const Eigen::Vector3d& p_WRobot) {
  return kNear * (p_WRobot / kNear).array().round().matrix();
}

std::size_t count_still(const CollisionWorld& world) {
  return world.bodies().size() - world.moving().size();
}

}  // namespace

BroadPhase::Table::Table(std::size_t row_count, std::size_t column_count)
    : rows(row_count),
      width(full_lanes(column_count)),
      radii(rows * width, kNoPair),
      pairs(rows * width, -1) {}

void BroadPhase::Table::add(int pair, Cell cell, float radius) {
  radii[cell.row * width + cell.column] = radius;
  pairs[cell.row * width + cell.column] = pair;
}

std::size_t BroadPhase::Table::blocks() const { return width / kLanes; }

BroadPhase::BroadPhase(const CollisionWorld& world, std::vector<BoundingSphere> spheres)
    : p_WO_(origin_near(world.X_WB().translation())),
      spheres_(std::move(spheres)),
      bodies_(world.moving()),
      moving_(bodies_.size(), bodies_.size()),
      still_(bodies_.size(), count_still(world)) {
  box_rounding_.resize(still_.width);
  for (std::vector<float>& numbers : X_BoxO_) {
    numbers.resize(still_.width);
  }
  for (std::vector<float>& numbers : half_) {
    numbers.resize(still_.width);
  }
  const std::vector<std::size_t> column = columns(world);
  for (std::size_t body = 0; body < column.size(); ++body) {
    const CollisionBody& still = world.bodies()[body];
    if (!still.moves()) {
      add_box(still, column[body]);
    }
  }
  for (const auto& [a, b] : world.pairs()) {
    add_pair(a, b, column, world.body(b).moves(), world.padding(static_cast<int>(cells_.size())));
  }
  if (cells_.size() - moving_pairs_ > kMany) {
    many_.emplace(world, p_WO_);
  }
}

void BroadPhase::add_pair(int a, int b, const std::vector<std::size_t>& column, bool both_move,
                          double padding) {
  const auto first = static_cast<std::size_t>(a);
  const auto second = static_cast<std::size_t>(b);
  const auto pair = static_cast<int>(cells_.size());
  cells_.push_back({column[first], column[second]});
  const float radius = spheres_[first].radius + (both_move ? spheres_[second].radius : 0.0F) +
                       static_cast<float>(padding);
  most_padding_ = std::max(most_padding_, static_cast<float>(padding));
  const float rounding =
      kRootRounding + rounding_beyond(radius) + (both_move ? 0.0F : box_rounding_[column[second]]);
  (both_move ? moving_ : still_).add(pair, cells_.back(), radius + rounding);
  moving_pairs_ += both_move ? 1 : 0;
}

void BroadPhase::add_box(const CollisionBody& still, std::size_t column) {
  const Aabb box = bounding_box(*still.mesh);
  const Pose X_BoxO =
      Eigen::Translation3d(-box.centre()) * still.X_FB.inverse() * Eigen::Translation3d(p_WO_);
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index k = 0; k < 4; ++k) {
      X_BoxO_[static_cast<std::size_t>(4 * row + k)][column] =
          static_cast<float>(X_BoxO.matrix()(row, k));
    }
    half_[static_cast<std::size_t>(row)][column] = static_cast<float>(0.5 * box.size()[row]);
  }
  box_rounding_[column] = rounding_beyond(X_BoxO.translation().norm() + 0.5 * box.size().norm());
}

BroadPhase::Placement BroadPhase::placement() const {
  const std::vector<float> zeros(moving_.width);
  const std::size_t blocks = std::max(moving_.blocks(), many_ ? 0 : still_.blocks());
  return {zeros, zeros, zeros, 0.0F, std::vector<std::uint32_t>(bodies_.size() * blocks), {}};
}

void BroadPhase::place(std::span<const Pose> X_WBody, Placement& placement) const {
  double farthest = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto body = static_cast<std::size_t>(bodies_[i]);
    const Eigen::Vector3d centre = X_WBody[body] * spheres_[body].centre.cast<double>() - p_WO_;
    farthest = std::max(farthest, centre.lpNorm<Eigen::Infinity>());
    placement.x[i] = static_cast<float>(centre.x());
    placement.y[i] = static_cast<float>(centre.y());
    placement.z[i] = static_cast<float>(centre.z());
  }
  placement.rounding = rounding_beyond(farthest);
}

void BroadPhase::find_near(Placement& placement, double tolerance, std::vector<int>& pairs) const {
  const float within = static_cast<float>(std::min(tolerance, kEverywhere)) + placement.rounding;
  pairs.clear();
  find_near_moving(placement, within, placement.near.data());
  append_found(placement.near.data(), moving_.pairs, pairs);
  if (many_) {
    append_near_still(placement, tolerance, pairs);
  } else {
    find_near_still(placement, within, placement.near.data());
    append_found(placement.near.data(), still_.pairs, pairs);
  }
}

void BroadPhase::append_near_still(Placement& placement, double tolerance,
                                   std::vector<int>& pairs) const {
  std::vector<int>& candidates = placement.candidates;
  candidates.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const int body = bodies_[i];
    const float radius = spheres_[static_cast<std::size_t>(body)].radius;
    const float reach = radius + most_padding_ + kRootRounding +
                        rounding_beyond(radius + most_padding_) + placement.rounding +
                        static_cast<float>(tolerance);
    many_->append_near(body, {placement.x[i], placement.y[i], placement.z[i]}, reach, candidates);
  }
  std::ranges::sort(candidates);
  std::ranges::copy_if(candidates, std::back_inserter(pairs),
                       [&](int pair) { return bound(placement, pair) < tolerance; });
}

double BroadPhase::bound(const Placement& placement, int pair) const {
  const auto [i, j] = cells_[static_cast<std::size_t>(pair)];
  const Eigen::Vector3f p(placement.x[i], placement.y[i], placement.z[i]);
  if (static_cast<std::size_t>(pair) < moving_pairs_) {
    const Eigen::Vector3f other(placement.x[j], placement.y[j], placement.z[j]);
    return (p - other).norm() - moving_.radii[i * moving_.width + j] - placement.rounding;
  }
  Eigen::Vector3f beyond;
  for (std::size_t row = 0; row < 3; ++row) {
    const float along = X_BoxO_[4 * row][j] * p.x() + X_BoxO_[4 * row + 1][j] * p.y() +
                        X_BoxO_[4 * row + 2][j] * p.z() + X_BoxO_[4 * row + 3][j];
    beyond[static_cast<Eigen::Index>(row)] = std::max(std::abs(along) - half_[row][j], 0.0F);
  }
  return beyond.norm() - still_.radii[i * still_.width + j] - placement.rounding;
}

HANDWAY_VECTOR_UNITS void BroadPhase::find_near_moving(const Placement& at, float within,
                                                       std::uint32_t* near) const {
  const std::size_t blocks = moving_.blocks();
  for (std::size_t i = 0; i < moving_.rows; ++i) {
    for (std::size_t block = 0; block < blocks; ++block) {
      const float* const radii = moving_.radii.data() + i * moving_.width;
      std::uint32_t bits = 0;
      HANDWAY_LANES
      for (std::size_t k = 0; k < kLanes; ++k) {
        const std::size_t other = block * kLanes + k;
        const float x = at.x[other] - at.x[i];
        const float y = at.y[other] - at.y[i];
        const float z = at.z[other] - at.z[i];
        const float reach = radii[other] + within;
        bits |= reach > 0.0F && x * x + y * y + z * z < reach * reach ? 1U << k : 0U;
      }
      near[i * blocks + block] = bits;
    }
  }
}

HANDWAY_VECTOR_UNITS void BroadPhase::find_near_still(const Placement& at, float within,
                                                      std::uint32_t* near) const {
  const std::size_t blocks = still_.blocks();
  for (std::size_t i = 0; i < still_.rows; ++i) {
    const float x = at.x[i];
    const float y = at.y[i];
    const float z = at.z[i];
    for (std::size_t block = 0; block < blocks; ++block) {
      const float* const radii = still_.radii.data() + i * still_.width;
      std::uint32_t bits = 0;
      HANDWAY_LANES
      for (std::size_t k = 0; k < kLanes; ++k) {
        const std::size_t box = block * kLanes + k;
        float squared = 0.0F;
        for (std::size_t row = 0; row < 3; ++row) {
          const float along = X_BoxO_[4 * row][box] * x + X_BoxO_[4 * row + 1][box] * y +
                              X_BoxO_[4 * row + 2][box] * z + X_BoxO_[4 * row + 3][box];
          const float beyond = std::max(std::abs(along) - half_[row][box], 0.0F);
          squared += beyond * beyond;
        }
        const float reach = radii[box] + within;
        bits |= reach > 0.0F && squared < reach * reach ? 1U << k : 0U;
      }
      near[i * blocks + block] = bits;
    }
  }
}

}  // namespace handway::geometric
