#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/pose_goal.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <variant>
#include <vector>

/// @file
/// Programs of a scene: steps such as "pick the can", "place it on the shelf", by the names of
/// objects and postures. planning::plan_task() plans them.

namespace handway::geometric {

/// A step that grasps an object and lifts it.
struct PickStep {
  std::string object;     ///< Stands in the world.
  double approach = 0.1;  ///< m: length of the straight motion that ends at the grasp.
  double lift = 0.1;      ///< m: height of the straight motion upwards; less where that is blocked.
};

/// A step that puts down the carried object, opens the hand and takes it away.
struct PlaceStep {
  /// The objects or frames on one of which it is placed, the first that is possible; none: `pose`
  /// is in the world.
  std::vector<std::string> supports = {};
  /// Pose of the object in the frame or the support's frame. Nothing: anywhere on the upward faces
  /// of the support, or with the middle of its underside at the origin of the frame, whose z axis
  /// then points out of the board.
  std::optional<Pose> pose = {};
  double lower = 0.1;    ///< m: height of the straight motion downwards; less where it is blocked.
  double retreat = 0.1;  ///< m: length of the straight motion that leaves the object.
};

/// A step that moves to a posture of the scene or of its robot, or to the scene's start.
struct PostureStep {
  std::string posture;  ///< Its name, or "start".
};

/// A step that moves a link of the robot to a pose.
struct PoseStep {
  /// The pose. With a reference, it is relative to where that object or frame is when the step
  /// begins.
  PoseGoal goal;
};

/// A step that moves the palm along a straight line; its orientation and the fingers stay.
struct LineStep {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< m, along the axes of …
  /// … "palm", or of an object or frame that stands in the world; empty: of the world.
  std::string reference = {};
};

/// Longest time of a WaitStep, s: a day.
inline constexpr double kLongestWait = 86400.0;

/// A step in which the robot rests.
struct WaitStep {
  double duration = 1.0;  ///< s, above 0, at most kLongestWait.
};

/// A step that sets an output of the robot's controller. Nothing moves.
struct OutputStep {
  std::string name;                         ///< Name that the controller has for it: "do3".
  std::variant<bool, double> value = true;  ///< Value of a digital or of another output.
};

struct Program;

/// A step that is one of several programs: the first that is possible, with all steps after it.
struct AlternativesStep {
  std::vector<Program> programs;  ///< In the order of preference; their names may be empty.
};

/// A step of a program.
struct ProgramStep : std::variant<PickStep, PlaceStep, PostureStep, PoseStep, LineStep, WaitStep,
                                  OutputStep, AlternativesStep> {
  using variant::variant;

  bool disabled = false;  ///< The program is planned without it.
};

/// Steps in their order.
struct Program {
  std::string name;  ///< Empty for the only program of a scene.
  std::vector<ProgramStep> steps;
};

/// Returns the words for a step: "pick can", "place on table", "move to start".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string to_string(const ProgramStep& step);

/// Returns the value of an output as text: "true", "false" or a number.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string value_text(const OutputStep& output);

/// The word that stands for the palm in LineStep::reference.
inline constexpr const char* kPalmAxes = "palm";

/// Replaces the name of an object or frame in all steps.
HANDWAY_GEOMETRIC_EXPORT void rename_object(std::vector<Program>& programs, const std::string& name,
                                            const std::string& new_name);

}  // namespace handway::geometric
