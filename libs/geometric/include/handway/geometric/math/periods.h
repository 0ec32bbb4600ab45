#pragma once

#include <Eigen/Core>

#include <cmath>
#include <utility>

namespace handway::geometric {

/// Periods of a vector's coordinates, as 2π of an angle: values that differ by whole periods in
/// them are the same place.
///
/// Vectors stay plain numbers. A motion goes to the equivalent value nearest to its start, so that
/// straight motions take the shorter arc.
class Periods {
 public:
  /// Makes periods of no coordinate.
  Periods() = default;
  /// @param periods > 0; 0 for a coordinate without a period. Shape [dimension].
  explicit Periods(Eigen::VectorXd periods)
      : periods_((periods.array() > 0.0).any() ? std::move(periods) : Eigen::VectorXd()) {}

  [[nodiscard]] bool none() const { return periods_.size() == 0; }
  /// Shape [dimension]; false for all if none().
  [[nodiscard]] bool has(Eigen::Index coordinate) const {
    return !none() && periods_[coordinate] > 0.0;
  }

  /// Returns `to`, moved by whole periods to at most half a period from `from`.
  [[nodiscard]] Eigen::VectorXd nearest(const Eigen::VectorXd& from, Eigen::VectorXd to) const {
    for (Eigen::Index i = 0; i < periods_.size(); ++i) {
      to[i] -= whole(i, to[i] - from[i]);
    }
    return to;
  }

  /// The shortest vector from `from` to a value equivalent to `to`.
  [[nodiscard]] Eigen::VectorXd difference(const Eigen::VectorXd& from,
                                           const Eigen::VectorXd& to) const {
    return nearest(from, to) - from;
  }

  /// Squared length of difference().
  template <typename A, typename B>
  [[nodiscard]] double squared_distance(const A& from, const B& to) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < from.size(); ++i) {
      const double way = to[i] - from[i];
      const double shortest = none() ? way : way - whole(i, way);
      sum += shortest * shortest;
    }
    return sum;
  }

 private:
  // Returns the whole periods in `way`. Half a period stays as it is, up to roundings: so the
  // direction of rotation is the same however often it is called.
  [[nodiscard]] double whole(Eigen::Index i, double way) const {
    constexpr double kTie = 0.5 + 1e-9;
    const double period = periods_[i];
    return period > 0.0 && std::abs(way) > kTie * period ? period * std::round(way / period) : 0.0;
  }

  Eigen::VectorXd periods_;  ///< Empty: none.
};

}  // namespace handway::geometric
