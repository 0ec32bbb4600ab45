#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

/// Robots with bodies of simple shapes, and scenes made of them, for tests of
/// collision checking and planning that need no file.
namespace handway::test {

/// tx90_sah() with a cylinder, box or cone on every link. Neighbours, and links
/// that touch each other in the neutral configuration, may collide.
[[nodiscard]] geometric::RobotDescription solid_tx90_sah();

/// Returns a robot of three sliding joints "x", "y", "z" (±1 m, along the world's axes) that carry
/// a link "probe" of the given shape, centred at the joints' values.
[[nodiscard]] geometric::RobotDescription gantry(const geometric::Shape& probe);

/// An arm in the plane z = 0: "shoulder" and "elbow" (±2.5 rad, links "upper" and
/// "lower" of 0.3 m along x) and a hand of a "palm", a "left" and a "right"
/// finger at its sides (joints "left", "right", 0 to 1.5 rad outwards), each with
/// a tip coupled to it ("left_tip", "right_tip": half the finger's angle), and a
/// "thumb" in the middle (±1.2 rad). Straight ahead everything reaches x = 0.78 m.
/// Groups "arm" (2 joints) and "hand" (thumb, left, right).
[[nodiscard]] geometric::RobotDescription planar_hand_arm();

/// Adds the pairs joined by a joint as allowed to collide.
void allow_neighbours(geometric::RobotDescription& robot);

/// A scene with this robot alone, at the origin and in its neutral configuration.
[[nodiscard]] geometric::Scene scene_of(geometric::RobotDescription robot);

/// Adds an object that stands still.
void add_object(geometric::Scene& scene, const std::string& name, const geometric::Shape& shape,
                const geometric::Pose& X_WO);
void add_object(geometric::Scene& scene, const std::string& name, const geometric::Shape& shape,
                const Eigen::Vector3d& p_WO);

/// The shape as a mesh in memory.
[[nodiscard]] geometric::Mesh as_mesh(const geometric::Shape& shape);

}  // namespace handway::test
