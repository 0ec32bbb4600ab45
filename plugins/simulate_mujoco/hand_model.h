#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/scene.h"

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

namespace handway::simulate_mujoco {

struct ModelDeleter {
  void operator()(mjModel* model) const;
};
using ModelPointer = std::unique_ptr<mjModel, ModelDeleter>;

struct DataDeleter {
  void operator()(mjData* data) const;
};
using DataPointer = std::unique_ptr<mjData, DataDeleter>;

/// The settings of the solver, as MJCF: steps of 4 ms, elliptic friction cones whose friction is
/// stiffer than the contact, so that little creeps; no gravity, room for 300 contacts and for
/// boxes around geoms.
inline constexpr const char* kSolver =
    "<size njmax='1500' nconmax='300' nuser_geom='6'/>"
    "<option timestep='0.004' integrator='implicit' cone='elliptic' impratio='10' "
    "noslip_iterations='2' gravity='0 0 0'/>";

/// Compiles MJCF. Any thread. Errors of MuJoCo are exceptions from the first call on, for the whole
/// program, instead of its end.
/// @throws std::runtime_error with MuJoCo's message.
[[nodiscard]] ModelPointer compile(const std::string& mjcf);

/// MuJoCo's data for a model. @throws std::runtime_error if there is no memory for it.
[[nodiscard]] DataPointer make_data(const mjModel& model);

/// Returns the name of a link's body in MuJoCo's model.
[[nodiscard]] std::string body_name(int link);

/// A joint of the hand in MuJoCo's model.
struct HandJoint {
  int link = -1;      ///< That it carries in the robot's model.
  int position = -1;  ///< Index into mjData::qpos.
  int actuator = -1;  ///< Index into mjData::ctrl; -1 of a joint that follows another.
};

/// A hand whose palm is fixed at the world's origin, and an object that is free, as a model of
/// MuJoCo. The joints that the palm carries move; each independent one has position control, the
/// others follow it by an equality. Links and objects are parts without hollows (convex_parts()),
/// boxes, balls or cylinders. Hand and object collide; links do not collide with each other.
struct HandModel {
  ModelPointer model;
  std::vector<HandJoint> joints;
  std::vector<int> slides;            ///< Actuators of prismatic joints.
  std::vector<int> rotations;         ///< Actuators of revolute joints.
  int object_body = -1;               ///< Index into mjData::xpos.
  int object_position = -1;           ///< First of 7 in mjData::qpos: place and quaternion.
  std::vector<std::string> warnings;  ///< Sentences on what is not as in the robot's model.
};

/// @throws InputError if the object or all of the hand has no shape that can be simulated.
[[nodiscard]] HandModel hand_model(const geometric::RobotModel& robot, int palm,
                                   const geometric::SceneObject& object);

}  // namespace handway::simulate_mujoco
