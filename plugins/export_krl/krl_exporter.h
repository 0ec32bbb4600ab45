#pragma once

#include "handway/planning/extensions/exporter.h"
#include "handway/planning/timing/joint_moves.h"

#include <string>
#include <vector>

namespace handway::export_krl {

/// Rates of a PTP move: $VEL_AXIS and $ACC_AXIS of all axes, and a wait after it.
struct AxisRates {
  int velocity = 100;      ///< %, from 1 to 100.
  int acceleration = 100;  ///< %, from 1 to 100.
  double pause = 0.0;      ///< s: what the move at these rates lacks to its duration.
};

/// Returns the rates with which a move takes at least its duration. Whole numbers are rounded down,
/// so that the move gets longer, never shorter. @param speed as of planning::Motion. @pre it moves.
[[nodiscard]] AxisRates axis_rates(const planning::JointMove& move, double speed);

/// A KRL program NAME.src with its data list NAME.dat for KUKA's KR C controllers: the waypoints in
/// degrees, and a `PTP` with exact stop to each of them. A PTP move is synchronous and straight in
/// the axes, so that the arm follows the certified path. External axes stay.
///
/// Source: KUKA, "System software: operating and programming instructions for system integrators",
/// KRL reference (PTP, AXIS, $VEL_AXIS, $ACC_AXIS, $AXIS_ACT, WAIT SEC, $OUT), and "Names in KRL":
/// at most 24 characters.
class KrlExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "krl"; }
  [[nodiscard]] std::string description() const override {
    return "a KRL program for the arm, stopping at every waypoint";
  }
  [[nodiscard]] bool stops_at_waypoints() const override { return true; }
  /// Rejects arms other than KUKA's, by the name of the robot, its file or the arm's links.
  [[nodiscard]] std::string robot_objection(const planning::Motion& motion) const override;
  /// Rejects outputs without a number of `$OUT` or `$ANOUT` at the end of their names.
  [[nodiscard]] std::string output_objection(const geometric::OutputStep& output) const override;

 private:
  /// @throws InputError unless the arm has six revolute joints, and for a gripper's output that is
  /// not from 1 to 4096. The seven joints of an LBR iiwa are refused: its controller runs Java.
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

}  // namespace handway::export_krl
