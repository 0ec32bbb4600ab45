#pragma once

#include "handway/device/export.h"
#include "handway/device/haptic/haptic_protocol.h"
#include "handway/geometric/io/parameter.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace handway::device {

/// The curve of a tool, a polyline in space; parameterized by arc length (m) from its
/// beginning.
class HANDWAY_DEVICE_EXPORT ToolCurve {
 public:
  /// @param points m; neighbours may be in the same place.
  /// @throws std::invalid_argument without points, or if one is not finite.
  explicit ToolCurve(std::vector<Eigen::Vector3d> points);

  [[nodiscard]] double length() const { return arc_.back(); }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /// Arc length at each point; shape [points], not falling.
  [[nodiscard]] const std::vector<double>& arc_lengths() const { return arc_; }

  /// `s` is clamped to the curve.
  [[nodiscard]] Eigen::Vector3d at(double s) const;
  /// Unit tangent, forwards; zero if the curve has no length.
  [[nodiscard]] Eigen::Vector3d tangent(double s) const;

  /// The arc length from `from` to `to` at which the curve is nearest to `point`. The range
  /// prevents jumps where the curve comes near to itself.
  [[nodiscard]] double nearest(const Eigen::Vector3d& point, double from, double to) const;

 private:
  [[nodiscard]] std::size_t segment(double s) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<double> arc_;
};

/// Settings of the guidance. Forces and distances are those of the hand on the handle.
struct ForceGuideSettings {
  double scale = 3.0;        ///< Motion of the tool per motion of the hand.
  double tube = 0.003;       ///< Distance from the curve without a pull, m.
  double stiffness = 150.0;  ///< Stiffness of the spring towards the tube, N/m.
  double damping = 2.0;      ///< N s/m, in all directions.
  double assistance = 0.8;   ///< Force along the curve, at rest, on the curve, N.
  double top_speed = 0.1;    ///< Speed of the hand along the curve without assistance, m/s.
  double lead = 0.01;        ///< Largest lead over the robot, m; the hand is held beyond.
  double strongest = 3.0;    ///< N
  /// Rotation of the device's frame in the base: its x to the right, y up and z towards the user
  /// are the base's y, z and x.
  Eigen::Matrix3d R_BD = (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
};

/// Describes the settings that users choose.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    ForceGuideSettings& settings);

/// Reaction to a sample of the handle.
struct GuideStep {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< On the hand, N, in the device's frame.
  double progress = 0.0;   ///< Arc length to which the hand has guided the tool, m of the curve.
  double deviation = 0.0;  ///< Distance of the hand from the curve, m of the hand.
  bool engaged = false;    ///< The button is held.
  bool arrived = false;    ///< At the curve's end, within 3 mm of the hand.
};

/// Guides a hand along a curve: a virtual fixture (Rosenberg 1993) made of a spring and a damper
/// towards the nearest point of the curve beyond a tube around it, and assistance along it that
/// fades with the distance from the curve and with speed. While the button is held, the handle
/// moves the tool: displacements of the hand since the button was pressed, times the scale, are
/// displacements of the tool. Without the button there is no force and no progress: release it,
/// bring the hand back, and press again to continue.
///
/// The force is bounded for all samples, and 0 for invalid ones.
class HANDWAY_DEVICE_EXPORT ForceGuide {
 public:
  /// @param curve of the tool, in the base's frame, m.
  /// @throws std::invalid_argument for invalid settings.
  ForceGuide(std::shared_ptr<const ToolCurve> curve, const ForceGuideSettings& settings);

  /// Takes a sample. @param followed arc length of the robot on the curve, m.
  GuideStep update(const HapticSample& sample, double followed);

  [[nodiscard]] double progress() const { return progress_; }
  /// Number of times that the button was pressed.
  [[nodiscard]] int grips() const { return grips_; }

 private:
  [[nodiscard]] Eigen::Vector3d pull(const Eigen::Vector3d& away, const Eigen::Vector3d& velocity,
                                     double followed) const;

  std::shared_ptr<const ToolCurve> curve_;
  ForceGuideSettings settings_;
  double progress_ = 0.0;
  /// Origin of the device's frame, set by the last press of the button: p_BD times the scale.
  std::optional<Eigen::Vector3d> origin_;
  int grips_ = 0;
};

}  // namespace handway::device
