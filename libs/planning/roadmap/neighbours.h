#pragma once

#include "handway/geometric/math/periods.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace handway::planning {

/// Distance and number of a point.
using Neighbour = std::pair<double, int>;

/// Incremental set of points for nearest-neighbour queries. Distances are Euclidean: weights of
/// joints, and of a tool's rotation against its translation, are scales of the coordinates, as
/// those of a StateSpace have them.
///
/// Exact, and bitwise equal to a linear search; of equally far points the one with the lower number
/// comes first. Points are in kd-trees over runs of 2ⁱ `linear` of them, the last few in none: a
/// run is joined with the one before when both are equally long, so that adding a point takes
/// O(log² n).
///
/// Source: Bentley, Saxe, "Decomposable searching problems I: static-to-dynamic transformation",
/// Journal of Algorithms 1(4), 1980, doi:10.1016/0196-6774(80)90015-2.
class Neighbours {
 public:
  /// Below so many points a linear search is faster (bench_neighbours).
  static constexpr int kLinear = 512;

  /// @param periods of the coordinates. With periods, all points are searched linearly.
  explicit Neighbours(int linear = kLinear, geometric::Periods periods = {});
  ~Neighbours();
  Neighbours(const Neighbours&) = delete;
  Neighbours& operator=(const Neighbours&) = delete;

  /// @param point shape [dimension], the same of all points.
  void add(int number, const Eigen::VectorXd& point);

  /// Up to `most` points that are no farther than `radius`, nearest first.
  /// @param wanted predicate on a point's number; empty: all count.
  [[nodiscard]] std::vector<Neighbour> nearest(
      const Eigen::VectorXd& point, int most,
      double radius = std::numeric_limits<double>::infinity(),
      const std::function<bool(int)>& wanted = {}) const;

 private:
  struct Run;

  int linear_;
  geometric::Periods periods_;
  std::vector<int> numbers_;
  Eigen::MatrixXd points_;  ///< One column per point; grows by doubling.
  std::vector<std::unique_ptr<Run>> runs_;
};

}  // namespace handway::planning
