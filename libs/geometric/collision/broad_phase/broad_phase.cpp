#include "collision/broad_phase/broad_phase.h"

#include "math/pose_columns.h"
#include "math/vector_units.h"

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
    : width(full_lanes(column_count)),
      radii(row_count * width, kNoPair),
      pairs(row_count * width, -1) {}

void BroadPhase::Table::add(int pair, Cell cell, float radius) {
  radii[cell.row * width + cell.column] = radius;
  pairs[cell.row * width + cell.column] = pair;
}

void BroadPhase::Table::list_blocks() {
  for (std::size_t first = 0; first < pairs.size(); first += kLanes) {
    const auto begin = pairs.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::any_of(begin, begin + kLanes, [](int pair) { return pair >= 0; })) {
      blocks.push_back({first / width, first % width});
    }
  }
}

void BroadPhase::Table::append_found(const std::uint32_t* near, std::vector<int>& found) const {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::uint32_t bits = near[b]; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      found.push_back(pairs[blocks[b].row * width + blocks[b].first + lane]);
    }
  }
}

BroadPhase::BroadPhase(const CollisionWorld& world, std::vector<BoundingSphere> spheres)
    : p_WO_(origin_near(world.X_WB().translation())),
      spheres_(std::move(spheres)),
      bodies_(world.moving()),
      moving_(bodies_.size(), bodies_.size()),
      still_(count_still(world), bodies_.size()) {
  for (const CollisionBody& body : world.bodies()) {
    if (!body.moves()) {
      add_box(body);
    }
  }
  const std::vector<std::size_t> column = columns(world);
  for (const auto& [a, b] : world.pairs()) {
    add_pair(a, b, column, world.body(b).moves(), world.padding(static_cast<int>(cells_.size())));
  }
  if (cells_.size() - moving_pairs_ > kMany) {
    many_.emplace(world, p_WO_);
  }
  moving_.list_blocks();
  still_.list_blocks();
}

void BroadPhase::add_pair(int a, int b, const std::vector<std::size_t>& column, bool both_move,
                          double padding) {
  const auto first = static_cast<std::size_t>(a);
  const auto second = static_cast<std::size_t>(b);
  const auto pair = static_cast<int>(cells_.size());
  cells_.push_back(both_move ? Cell{column[first], column[second]}
                             : Cell{column[second], column[first]});
  const float radius = spheres_[first].radius + (both_move ? spheres_[second].radius : 0.0F) +
                       static_cast<float>(padding);
  most_padding_ = std::max(most_padding_, static_cast<float>(padding));
  const float rounding =
      kRootRounding + rounding_beyond(radius) + (both_move ? 0.0F : box_rounding_[column[second]]);
  (both_move ? moving_ : still_).add(pair, cells_.back(), radius + rounding);
  moving_pairs_ += both_move ? 1 : 0;
}

void BroadPhase::add_box(const CollisionBody& still) {
  const Aabb box = bounding_box(*still.mesh);
  const Pose X_BoxO =
      Eigen::Translation3d(-box.centre()) * still.X_FB.inverse() * Eigen::Translation3d(p_WO_);
  StillBox placed{};
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index k = 0; k < 4; ++k) {
      placed.X_BoxO.at(static_cast<std::size_t>(4 * row + k)) =
          static_cast<float>(X_BoxO.matrix()(row, k));
    }
    placed.half.at(static_cast<std::size_t>(row)) = static_cast<float>(0.5 * box.size()[row]);
  }
  boxes_.push_back(placed);
  box_rounding_.push_back(rounding_beyond(X_BoxO.translation().norm() + 0.5 * box.size().norm()));
}

BroadPhase::Placement BroadPhase::placement() const {
  const std::vector<float> zeros(moving_.width);
  const std::size_t blocks = std::max(moving_.blocks.size(), many_ ? 0 : still_.blocks.size());
  return {zeros, zeros, zeros, 0.0F, std::vector<std::uint32_t>(blocks), {}};
}

HANDWAY_VECTOR_UNITS void BroadPhase::place(std::span<const Pose> X_WBody,
                                            Placement& placement) const {
  const PoseColumn origin{p_WO_.x(), p_WO_.y(), p_WO_.z(), 0.0};
  double farthest = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto body = static_cast<std::size_t>(bodies_[i]);
    const PoseColumns X(X_WBody[body]);
    const float* const p = spheres_[body].centre.data();
    const PoseColumn centre = X.x * static_cast<double>(p[0]) + X.y * static_cast<double>(p[1]) +
                              X.z * static_cast<double>(p[2]) + X.p - origin;
    farthest = std::max({farthest, std::abs(centre[0]), std::abs(centre[1]), std::abs(centre[2])});
    placement.x[i] = static_cast<float>(centre[0]);
    placement.y[i] = static_cast<float>(centre[1]);
    placement.z[i] = static_cast<float>(centre[2]);
  }
  placement.rounding = rounding_beyond(farthest);
}

void BroadPhase::find_near(Placement& placement, double tolerance, std::vector<int>& pairs) const {
  const float within = static_cast<float>(std::min(tolerance, kEverywhere)) + placement.rounding;
  pairs.clear();
  find_near_moving(placement, within, placement.near.data());
  moving_.append_found(placement.near.data(), pairs);
  if (many_) {
    append_near_still(placement, tolerance, pairs);
    return;
  }
  const auto moving_end = static_cast<std::ptrdiff_t>(pairs.size());
  find_near_still(placement, within, placement.near.data());
  still_.append_found(placement.near.data(), pairs);
  std::sort(pairs.begin() + moving_end, pairs.end());
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
  const Eigen::Vector3f p(placement.x[j], placement.y[j], placement.z[j]);
  if (static_cast<std::size_t>(pair) < moving_pairs_) {
    const Eigen::Vector3f other(placement.x[i], placement.y[i], placement.z[i]);
    return (other - p).norm() - moving_.radii[i * moving_.width + j] - placement.rounding;
  }
  const auto& [X, half] = boxes_[i];
  Eigen::Vector3f beyond;
  for (std::size_t row = 0; row < 3; ++row) {
    const float along =
        X[4 * row] * p.x() + X[4 * row + 1] * p.y() + X[4 * row + 2] * p.z() + X[4 * row + 3];
    beyond[static_cast<Eigen::Index>(row)] = std::max(std::abs(along) - half[row], 0.0F);
  }
  return beyond.norm() - still_.radii[i * still_.width + j] - placement.rounding;
}

HANDWAY_VECTOR_UNITS void BroadPhase::find_near_moving(const Placement& at, float within,
                                                       std::uint32_t* near) const {
  for (std::size_t b = 0; b < moving_.blocks.size(); ++b) {
    const auto [i, first] = moving_.blocks[b];
    const float* const radii = moving_.radii.data() + i * moving_.width;
    std::uint32_t bits = 0;
    HANDWAY_LANES
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::size_t other = first + k;
      const float x = at.x[other] - at.x[i];
      const float y = at.y[other] - at.y[i];
      const float z = at.z[other] - at.z[i];
      const float reach = radii[other] + within;
      bits |= reach > 0.0F && x * x + y * y + z * z < reach * reach ? 1U << k : 0U;
    }
    near[b] = bits;
  }
}

HANDWAY_VECTOR_UNITS void BroadPhase::find_near_still(const Placement& at, float within,
                                                      std::uint32_t* near) const {
  for (std::size_t b = 0; b < still_.blocks.size(); ++b) {
    const auto [i, first] = still_.blocks[b];
    const auto& [X, half] = boxes_[i];
    const float* const radii = still_.radii.data() + i * still_.width;
    std::uint32_t bits = 0;
    HANDWAY_LANES
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::size_t body = first + k;
      float squared = 0.0F;
      for (std::size_t row = 0; row < 3; ++row) {
        const float along = X[4 * row] * at.x[body] + X[4 * row + 1] * at.y[body] +
                            X[4 * row + 2] * at.z[body] + X[4 * row + 3];
        const float beyond = std::max(std::abs(along) - half[row], 0.0F);
        squared += beyond * beyond;
      }
      const float reach = radii[body] + within;
      bits |= reach > 0.0F && squared < reach * reach ? 1U << k : 0U;
    }
    near[b] = bits;
  }
}

}  // namespace handway::geometric
