#include "collision/cache/self_distance_cache.h"

#include "collision/volumes/solid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace handway::geometric {
namespace {

constexpr std::size_t kCellsOfOneJoint = 1024;
constexpr std::size_t kCellsOfTwoJoints = 128;  // each
constexpr float kUnknown = -1.0F;

}  // namespace

std::unique_ptr<PairDistanceCache> PairDistanceCache::make(const RobotModel& model, int link_a,
                                                           int link_b, int pair,
                                                           const MotionBound& motion) {
  std::vector<int> moving;
  for (int v = 0; v < model.variable_count(); ++v) {
    if (model.moves_between(v, link_a, link_b)) {
      moving.push_back(v);
    }
  }
  if (moving.empty() || moving.size() > 2) {
    return nullptr;
  }
  const std::size_t cells = moving.size() == 1 ? kCellsOfOneJoint : kCellsOfTwoJoints;
  std::vector<Axis> axes;
  for (const int v : moving) {
    const double range = std::max(model.upper()[v] - model.lower()[v], 1e-9);
    axes.push_back({v, model.lower()[v], range / static_cast<double>(cells),
                    model.is_continuous(v) ? range : 0.0,
                    motion.bound(pair, Eigen::VectorXd::Unit(model.variable_count(), v))});
  }
  return std::unique_ptr<PairDistanceCache>(
      new PairDistanceCache(std::move(axes), cells, model.neutral()));
}

PairDistanceCache::PairDistanceCache(std::vector<Axis> axes, std::size_t cells_per_axis,
                                     Configuration rest)
    : axes_(std::move(axes)),
      rest_(std::move(rest)),
      cells_per_axis_(cells_per_axis),
      cells_(axes_.size() == 1 ? cells_per_axis : cells_per_axis * cells_per_axis) {
  for (std::atomic<float>& cell : cells_) {
    cell.store(kUnknown, std::memory_order_relaxed);
  }
}

double PairDistanceCache::bound(const Configuration& q, const Distance& exact) const {
  std::size_t index = 0;
  double motion = 0.0;
  std::array<double, 2> centre{};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    double from_lower = q[axis.variable] - axis.lower;
    if (axis.turn > 0.0) {
      from_lower -= axis.turn * std::floor(from_lower / axis.turn);
    }
    const double position = from_lower / axis.cell;
    if (position < 0.0 || position > static_cast<double>(cells_per_axis_)) {
      return 0.0;  // out of limits: not remembered
    }
    const std::size_t cell = std::min(static_cast<std::size_t>(position), cells_per_axis_ - 1);
    index = index * cells_per_axis_ + cell;
    centre[i] = axis.lower + (static_cast<double>(cell) + 0.5) * axis.cell;
    motion += axis.reach * std::abs(axis.turn > 0.0 ? axis.lower + from_lower - centre[i]
                                                    : q[axis.variable] - centre[i]);
  }
  float distance = cells_[index].load(std::memory_order_relaxed);
  if (distance == kUnknown) {
    Configuration at_centre = rest_;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      at_centre[axes_[i].variable] = centre[i];
    }
    distance = std::nextafter(static_cast<float>(exact(at_centre)), 0.0F);
    cells_[index].store(distance, std::memory_order_relaxed);
    learned_.store(true, std::memory_order_relaxed);
  }
  return static_cast<double>(distance) - motion;
}

std::vector<float> PairDistanceCache::cells() const {
  std::vector<float> cells;
  cells.reserve(cells_.size());
  for (const std::atomic<float>& cell : cells_) {
    cells.push_back(cell.load(std::memory_order_relaxed));
  }
  return cells;
}

void PairDistanceCache::set_cells(std::span<const float> cells) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    cells_[i].store(cells[i], std::memory_order_relaxed);
  }
}

namespace {

constexpr std::string_view kLayout = "distances 5";  // to change with what is in the tables

// Describes everything that a table's distances depend on: the two surfaces, and where they are
// against each other at both ends and in the middle of the joints' ranges, and at rest.
std::string description(const CollisionWorld& world, const BodyPair& pair, const Surface& a,
                        const Surface& b) {
  std::string text(a.key.begin(), a.key.end());
  text.append(b.key.begin(), b.key.end());
  for (const int body : {pair.a, pair.b}) {
    const BodySolids& solids = *world.body(body).solids;
    text += std::to_string(solids.parts.size()) + ' ' + std::to_string(solids.points.size()) + ' ';
  }
  const RobotModel& model = world.model();
  const Configuration middle = 0.5 * (model.lower() + model.upper());
  for (const Configuration& q : {model.lower(), middle, model.upper(), model.neutral()}) {
    const std::vector<Pose> X_BBody = poses_at_base(world, q);
    const Pose X_ba = X_BBody[static_cast<std::size_t>(pair.b)].inverse(Eigen::Isometry) *
                      X_BBody[static_cast<std::size_t>(pair.a)];
    text.append(reinterpret_cast<const char*>(X_ba.matrix().data()), 16 * sizeof(double));
  }
  return text;
}

}  // namespace

std::vector<Pose> poses_at_base(const CollisionWorld& world, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  world.model().forward_kinematics(q, X_BL);
  std::vector<Pose> X_BBody(world.bodies().size(), Pose::Identity());
  for (std::size_t i = 0; i < X_BBody.size(); ++i) {
    if (const CollisionBody& body = world.bodies()[i]; body.moves()) {
      const Pose& X_BLink = X_BL[static_cast<std::size_t>(body.link)];
      X_BBody[i] = body.is_carried ? X_BLink * body.X_FB : X_BLink;
    }
  }
  return X_BBody;
}

SelfDistanceCache::SelfDistanceCache(const CollisionWorld& world,
                                     const std::vector<std::shared_ptr<const Surface>>& surfaces,
                                     bool keeps)
    : keeps_(keeps) {
  const MotionBound motion(world);
  std::string all;
  for (const BodyPair& pair : world.pairs()) {
    tables_.push_back(world.is_self_pair(pair)
                          ? PairDistanceCache::make(world.model(), world.body(pair.a).link,
                                                    world.body(pair.b).link,
                                                    static_cast<int>(tables_.size()), motion)
                          : nullptr);
    if (tables_.back()) {
      all += description(world, pair, *surfaces[static_cast<std::size_t>(pair.a)],
                         *surfaces[static_cast<std::size_t>(pair.b)]);
    }
  }
  key_ = cache_key(kLayout, all);
  recall();
}

void SelfDistanceCache::recall() {
  const std::optional<std::string> cached = DiskCache::of_user().read(key_);
  std::size_t count = 0;
  for (const auto& table : tables_) {
    count += table ? table->cell_count() : 0;
  }
  if (!cached || count == 0 || cached->size() != count * sizeof(float)) {
    return;
  }
  keeps_ = true;
  std::vector<float> cells(count);
  std::memcpy(cells.data(), cached->data(), cached->size());
  std::span<const float> rest(cells);
  for (const auto& table : tables_) {
    if (table) {
      table->set_cells(rest.first(table->cell_count()));
      rest = rest.subspan(table->cell_count());
    }
  }
}

SelfDistanceCache::~SelfDistanceCache() {
  const bool learned =
      std::ranges::any_of(tables_, [](const auto& table) { return table && table->has_learned(); });
  if (!learned || !keeps_) {
    return;
  }
  std::string bytes;
  for (const auto& table : tables_) {
    if (table) {
      const std::vector<float> cells = table->cells();
      bytes.append(reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof(float));
    }
  }
  DiskCache::of_user().write(key_, bytes);
}

}  // namespace handway::geometric
