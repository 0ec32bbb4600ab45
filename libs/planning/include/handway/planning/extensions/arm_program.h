#pragma once

#include "handway/planning/export.h"
#include "handway/planning/extensions/exporter.h"
#include "handway/planning/timing/joint_moves.h"
#include "handway/planning/timing/time_path.h"

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// @file
/// Programs for the controllers of arms, before they are written in the language of one: exporters
/// of several languages share them.

namespace handway::planning {

/// A remark in a program, one line of printable ASCII.
struct ArmComment {
  std::string text;
};

/// A joint move to a point, with a stop there.
struct ArmMove {
  std::size_t point = 0;  ///< Index of a waypoint of the motion.
  JointMove move;
};

/// A time in which the arm rests.
struct ArmWait {
  double duration = 0.0;  ///< s
  /// True if the motion has a waypoint at its end, where only the hand has moved. Otherwise the
  /// time is added to the motion.
  bool is_waypoint = true;
  bool rests = false;  ///< The hand rests, too: the trajectory has no points between.
};

/// A digital output of the controller that closes the hand.
struct GripperOutput {
  int number = 0;
  bool closes = false;
};

/// An output of the controller that a step of a program sets.
struct ArmOutput {
  geometric::OutputStep output;
};

/// An instruction of a program.
using ArmInstruction = std::variant<ArmComment, ArmMove, ArmWait, GripperOutput, ArmOutput>;

/// Requirements of a language on an arm.
struct ArmRequirements {
  std::string language;     ///< For messages: "KRL".
  std::size_t joints = 6;   ///< Number of revolute joints.
  std::string advice = {};  ///< For an arm with another number of joints; may be empty.
};

/// Throws an InputError unless the arm of the motion is a chain of that many revolute joints, from
/// the base to the flange, and no joint moves besides those of the arm and of the hand.
HANDWAY_PLANNING_EXPORT void require_arm(const Motion& motion, const ArmRequirements& required);

/// Returns whether the robot's name, its file's name or the name of a link of the arm contains a
/// match of `pattern`, an ECMAScript regular expression; case does not count.
[[nodiscard]] HANDWAY_PLANNING_EXPORT bool is_robot_named(const Motion& motion,
                                                          const std::string& pattern);

/// Returns the motion of the arm from its first waypoint as instructions: a comment at each stage,
/// moves, and waits while the hand moves alone. With ExportOptions::gripper_output the output is
/// set at the beginning of stages that close or open the hand, which then last at least
/// gripper_time. Without it a comment names the hand's file.
/// @pre check_motion() accepts the motion.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<ArmInstruction> arm_instructions(
    const Motion& motion, const ExportOptions& options);

/// Returns the number at the end of an output's name, before brackets: 3 for "do3", "3" and
/// "$OUT[3]". Nothing without one, or beyond 9999.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<int> output_number(const std::string& name);

/// Returns the comment in place of an output that a format can't set.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string unset_output_comment(
    const geometric::OutputStep& output);

/// Returns comments for the beginning of a program: the motion, its robot, number of moves and
/// duration.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> program_heading(
    const Motion& motion);

/// Returns NAME_hand_targets.csv, the joints of the hand that belong to the moves of an arm's
/// program: `move` (0: the start), `time` (s), `stage` and the joints of the hand (rad or m), a row
/// for each waypoint. A row "hold" follows a stage that closes the hand: targets that hold the
/// object. No file if the hand does not move, or an output drives it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<ExportedFile> hand_target_files(
    const Motion& motion, const ExportOptions& options);

}  // namespace handway::planning
