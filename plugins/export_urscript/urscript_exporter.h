#pragma once

#include "handway/planning/extensions/exporter.h"

#include <string>
#include <vector>

namespace handway::export_urscript {

/// A URScript program NAME.script for arms of Universal Robots: a function NAME() with a `movej` to
/// each waypoint. A `movej` without a blend radius stops at its end and is straight in the joints,
/// so that the arm follows the certified path. `t` is the duration in the motion, which the
/// controller uses; `a` and `v` of the leading joint are those of the motion.
///
/// Source: Universal Robots, "The URScript Programming Language", modules "motion" (movej, servoj,
/// stopj) and "internals" (get_actual_joint_positions, popup, sleep), and "interfaces"
/// (set_standard_digital_out, outputs 0 to 7).
class UrScriptExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "urscript"; }
  [[nodiscard]] std::string description() const override {
    return "a URScript program for the arm, stopping at every waypoint";
  }
  [[nodiscard]] bool stops_at_waypoints() const override { return true; }
  /// Rejects arms other than those of Universal Robots, by the name of the robot, its file or the
  /// arm's links.
  [[nodiscard]] std::string robot_objection(const planning::Motion& motion) const override;
  /// Rejects outputs without a number of the controller at the end of their names.
  [[nodiscard]] std::string output_objection(const geometric::OutputStep& output) const override;

 private:
  /// @throws InputError unless the arm has six revolute joints within ±363°, and for a gripper's
  /// output above 7.
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

/// A URScript program NAME_servo.script that streams the timed motion: a `servoj` every 8 ms, arcs
/// included. The controller interpolates and smooths between the points over `lookahead_time`, the
/// shortest that it accepts.
class UrScriptServoExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "urscript-servo"; }
  [[nodiscard]] std::string description() const override {
    return "a URScript program that streams the timed motion to the arm every 8 ms";
  }
  [[nodiscard]] double point_period() const override { return 0.008; }
  /// Rejects the same arms as UrScriptExporter.
  [[nodiscard]] std::string robot_objection(const planning::Motion& motion) const override;
  /// Rejects the same outputs as UrScriptExporter.
  [[nodiscard]] std::string output_objection(const geometric::OutputStep& output) const override;

 private:
  /// @throws InputError as UrScriptExporter does.
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

}  // namespace handway::export_urscript
