#pragma once

#include "handway/geometric/collision/motion_bound.h"
#include "handway/geometric/robot/robot_model.h"

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace handway::geometric {

/// Distances of a pair of bodies that one or two joints alone move against each
/// other (neighbouring finger links, wrist and palm), remembered on a grid over
/// those joints. Cells are filled when first asked for, by any thread, with the other
/// joints at rest: to the last bit, what is in a cell does not depend on who fills it.
class DistanceTable {
 public:
  /// The exact distance (m) of the pair in a configuration.
  using Distance = std::function<double(const Configuration&)>;

  /// A table for `pair` (of two links of the robot), or nothing if none or more
  /// than two variables move it.
  [[nodiscard]] static std::unique_ptr<DistanceTable> make(const RobotModel& model, int link_a,
                                                           int link_b, int pair,
                                                           const MotionBound& motion);

  /// A lower bound (m) of the distance in `q`: that of the cell's centre less
  /// what the way from there can take; 0 or less if it can't tell.
  [[nodiscard]] double bound(const Configuration& q, const Distance& exact) const;

  /// What is known, shape [cells]; negative where nothing is.
  [[nodiscard]] std::vector<float> cells() const;
  void set_cells(std::span<const float> cells);
  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  /// Whether anything was learned since set_cells().
  [[nodiscard]] bool has_learned() const { return learned_.load(std::memory_order_relaxed); }

 private:
  struct Axis {
    int variable;
    double lower;
    double cell;   ///< rad or m
    double turn;   ///< rad, after which it comes round again; 0: it does not.
    double reach;  ///< m per rad, or m per m
  };

  DistanceTable(std::vector<Axis> axes, std::size_t cells_per_axis, Configuration rest);

  std::vector<Axis> axes_;
  Configuration rest_;
  std::size_t cells_per_axis_;
  mutable std::atomic<bool> learned_ = false;
  mutable std::vector<std::atomic<float>> cells_;  ///< Negative: not known yet.
};

}  // namespace handway::geometric
