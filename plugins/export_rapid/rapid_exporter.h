#pragma once

#include "handway/planning/extensions/exporter.h"

#include <string>
#include <vector>

namespace handway::export_rapid {

/// A RAPID module NAME.mod for ABB's controllers: `jointtarget` constants in degrees, and a
/// procedure run_NAME() with a `MoveAbsJ` to each of them. A `MoveAbsJ` with zone `fine` stops at
/// its end and moves all joints together, so that the arm follows the certified path. `\T` is the
/// duration in the motion.
///
/// Source: ABB, "Technical reference manual: RAPID Instructions, Functions and Data types"
/// (MoveAbsJ, WaitTime, SetDO, CJointT, jointtarget), and "RAPID overview", lexical elements
/// (identifiers of at most 32 characters, strings of at most 80).
class RapidExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "rapid"; }
  [[nodiscard]] std::string description() const override {
    return "a RAPID module for the arm, stopping at every waypoint";
  }
  [[nodiscard]] bool stops_at_waypoints() const override { return true; }
  /// Rejects arms other than ABB's, by the name of the robot, its file or the arm's links.
  [[nodiscard]] std::string robot_objection(const planning::Motion& motion) const override;
  /// Rejects names that no signal can have.
  [[nodiscard]] std::string output_objection(const geometric::OutputStep& output) const override;

 private:
  /// The gripper's output N is the signal `doN` of the controller.
  /// @throws InputError unless the arm has six revolute joints, and for a negative output.
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

}  // namespace handway::export_rapid
