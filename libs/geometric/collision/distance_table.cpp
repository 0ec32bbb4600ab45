#include "collision/distance_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace handway::geometric {
namespace {

constexpr std::size_t kCellsOfOneJoint = 1024;
constexpr std::size_t kCellsOfTwoJoints = 128;  // each
constexpr float kUnknown = -1.0F;

}  // namespace

std::unique_ptr<DistanceTable> DistanceTable::make(const RobotModel& model, int link_a, int link_b,
                                                   int pair, const MotionBound& motion) {
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
  return std::unique_ptr<DistanceTable>(new DistanceTable(std::move(axes), cells, model.neutral()));
}

DistanceTable::DistanceTable(std::vector<Axis> axes, std::size_t cells_per_axis, Configuration rest)
    : axes_(std::move(axes)),
      rest_(std::move(rest)),
      cells_per_axis_(cells_per_axis),
      cells_(axes_.size() == 1 ? cells_per_axis : cells_per_axis * cells_per_axis) {
  for (std::atomic<float>& cell : cells_) {
    cell.store(kUnknown, std::memory_order_relaxed);
  }
}

double DistanceTable::bound(const Configuration& q, const Distance& exact) const {
  std::size_t index = 0;
  double way = 0.0;
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
    way += axis.reach * std::abs(axis.turn > 0.0 ? axis.lower + from_lower - centre[i]
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
  return static_cast<double>(distance) - way;
}

std::vector<float> DistanceTable::cells() const {
  std::vector<float> cells;
  cells.reserve(cells_.size());
  for (const std::atomic<float>& cell : cells_) {
    cells.push_back(cell.load(std::memory_order_relaxed));
  }
  return cells;
}

void DistanceTable::set_cells(std::span<const float> cells) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    cells_[i].store(cells[i], std::memory_order_relaxed);
  }
}

}  // namespace handway::geometric
