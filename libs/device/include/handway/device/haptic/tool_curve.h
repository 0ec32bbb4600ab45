#pragma once

#include "handway/device/export.h"

#include <Eigen/Core>

#include <vector>

namespace handway::device {

/// The way that a tool goes, as a polyline in space; measured by arc length (m) from its beginning.
class HANDWAY_DEVICE_EXPORT ToolCurve {
 public:
  /// @param points m; neighbours may be in the same place.
  /// @throws std::invalid_argument if there are none, or one is not finite.
  explicit ToolCurve(std::vector<Eigen::Vector3d> points);

  [[nodiscard]] double length() const { return arc_.back(); }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /// Where each point is; shape [points], not falling.
  [[nodiscard]] const std::vector<double>& arc_lengths() const { return arc_; }

  /// `s` is clamped to the curve.
  [[nodiscard]] Eigen::Vector3d at(double s) const;
  /// Of length 1, forwards; of zeros if the curve has no length.
  [[nodiscard]] Eigen::Vector3d tangent(double s) const;

  /// The arc length from `from` to `to` at which the curve is nearest to `point`. A stretch, so
  /// that nobody jumps where the curve comes near to itself.
  [[nodiscard]] double nearest(const Eigen::Vector3d& point, double from, double to) const;

 private:
  [[nodiscard]] std::size_t segment(double s) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<double> arc_;
};

}  // namespace handway::device
