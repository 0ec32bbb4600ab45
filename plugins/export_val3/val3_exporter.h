#pragma once

#include "handway/planning/extensions/exporter.h"

#include <array>
#include <string>
#include <vector>

namespace handway::export_val3 {

/// A joint move of the arm to a point, from rest to rest.
struct ArmMove {
  std::array<double, 6> point{};  ///< deg
  double velocity = 100.0;        ///< % of the nominal joint speed, above 0.
  double acceleration = 100.0;    ///< % of the nominal joint acceleration, above 0.
  double pause = 0.0;             ///< s: above 0 the arm rests while the hand moves.
};

/// A move to each waypoint, the first one being the start of the motion. Speeds are such that moves
/// take as long as in the motion: the joints accelerate, run and brake together at the limits that
/// the motion was timed with.
/// @throws InputError unless the arm has six revolute joints.
[[nodiscard]] std::vector<ArmMove> arm_moves(const planning::Motion& motion);

/// A VAL3 application for Staeubli controllers of the CS8 series and CS9, in a folder NAME: the
/// path's waypoints as joint points in degrees and a joint move to each. Joint moves between rests
/// are straight in the joints, so that the arm follows the certified path; the controller does not
/// blend. A motion with stages has a loop for each, with its name as a comment.
/// ExportOptions::gripper_output 1 or 2 is the valve of the tool, which VAL3 opens and closes.
class Val3Exporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "val3"; }
  [[nodiscard]] std::string description() const override {
    return "a VAL3 application for the arm, stopping at every waypoint";
  }
  [[nodiscard]] bool stops_at_waypoints() const override { return true; }
  /// Rejects arms other than Staeubli's, by the name of the robot, its file or the arm's links:
  /// VAL3's joint points are angles of the controller's own arm.
  [[nodiscard]] std::string robot_objection(const planning::Motion& motion) const override;
  /// Rejects outputs that are neither linked nor of the first basic board.
  [[nodiscard]] std::string output_objection(const geometric::OutputStep& output) const override;

 private:
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

}  // namespace handway::export_val3
