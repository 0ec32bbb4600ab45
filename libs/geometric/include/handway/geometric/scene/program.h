#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"

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
  std::string support;  ///< The object on whose upward faces it is placed; empty: see `pose`.
  /// Pose of the object in the world, without a support.
  Pose pose = Pose::Identity();
  double lower = 0.1;    ///< m: height of the straight motion downwards; less where it is blocked.
  double retreat = 0.1;  ///< m: length of the straight motion that leaves the object.
};

/// A step that moves to a posture of the scene or of its robot, or to the scene's start.
struct PostureStep {
  std::string posture;  ///< Its name, or "start".
};

/// A step of a program.
using ProgramStep = std::variant<PickStep, PlaceStep, PostureStep>;

/// Steps in their order.
struct Program {
  std::string name;  ///< Empty for the only program of a scene.
  std::vector<ProgramStep> steps;
};

/// Replaces the name of an object in all steps.
HANDWAY_GEOMETRIC_EXPORT void rename_object(std::vector<Program>& programs, const std::string& name,
                                            const std::string& new_name);

}  // namespace handway::geometric
