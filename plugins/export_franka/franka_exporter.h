#pragma once

#include "handway/planning/extensions/exporter.h"

#include <array>
#include <string>
#include <vector>

namespace handway::export_franka {

/// Limits of the seven joints of an arm of Franka, which its control interface enforces at every
/// millisecond: a motion beyond them ends with an error.
struct FrankaLimits {
  const char* robot;                   ///< Name for messages.
  std::array<double, 7> lower;         ///< rad
  std::array<double, 7> upper;         ///< rad
  std::array<double, 7> velocity;      ///< rad/s
  std::array<double, 7> acceleration;  ///< rad/s²
  std::array<double, 7> jerk;          ///< rad/s³
};

/// Returns the limits for the robot of a motion: those of Franka Research 3 if its name, its file's
/// name or a link of the arm contains "fr3", else those of the Franka Emika Robot (Panda).
///
/// Source: Franka Control Interface (FCI) documentation, "Robot and interface specifications",
/// "Limits in the joint space". The velocity limits of Franka Research 3 that depend on the
/// position are not among them.
[[nodiscard]] const FrankaLimits& franka_limits(const planning::Motion& motion);

/// Joint positions for control loops of libfranka (franka::JointPositions) at 1 kHz:
/// NAME_franka.csv with `time` (s), `q1` to `q7` (rad) and `dq1` to `dq7` (rad/s), and
/// NAME_franka.json with the same as arrays, the names of the joints, the limits and the stages.
class FrankaExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "franka"; }
  [[nodiscard]] std::string description() const override {
    return "joint positions and velocities for libfranka at 1 kHz, as CSV and JSON";
  }
  [[nodiscard]] double point_period() const override { return 0.001; }
  /// Rejects arms other than Franka's, by the name of the robot, its file or the arm's links.
  [[nodiscard]] std::string robot_objection(const planning::Motion& motion) const override;
  /// Rejects all outputs: libfranka sets none.
  [[nodiscard]] std::string output_objection(const geometric::OutputStep& output) const override;

 private:
  /// @throws InputError unless the arm has seven revolute joints, and for positions, or velocities,
  /// accelerations and jerks between points, beyond franka_limits().
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

}  // namespace handway::export_franka
