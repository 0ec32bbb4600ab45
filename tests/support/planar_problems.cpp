#include "handway_test/planar_problems.h"

#include <limits>
#include <memory>
#include <utility>

namespace handway::test {

using geometric::Configuration;
using geometric::RobotModel;
using geometric::Scene;
using planning::PlanningProblem;

Configuration planar_configuration(double shoulder, double elbow, double thumb, double left,
                                   double right) {
  static const RobotModel kModel(planar_hand_arm());
  Configuration q(kModel.variable_count());
  for (const auto& [joint, value] :
       {std::pair("shoulder", shoulder), std::pair("elbow", elbow), std::pair("thumb", thumb),
        std::pair("left", left), std::pair("right", right)}) {
    q[kModel.find_variable(joint).value()] = value;
  }
  return q;
}

sampling::PmdBasis planar_hand_basis() {
  sampling::PmdBasis basis;
  basis.hand = "planar";
  basis.source = "made up";
  basis.joints = {"thumb", "left", "right"};
  basis.mean = Eigen::Vector3d(0.5, 0.5, 0.5);
  basis.free_joints = {{0, 0.5, 0.5}};
  basis.directions = {{"spread", Eigen::Vector3d(0, 1, 1).normalized(), 0.7, 0.0},
                      {"sway", Eigen::Vector3d(0, 1, -1).normalized(), 0.3, 0.0}};
  return basis;
}

PlanningProblem planar_problem(Scene scene, const Configuration& start, const Configuration& goal) {
  scene.start = start;
  scene.goal = goal;
  return planning::make_problem(std::make_shared<const Scene>(std::move(scene)),
                                std::make_shared<const sampling::PmdBasis>(planar_hand_basis()));
}

PlanningProblem open_problem() {
  Scene scene = scene_of(planar_hand_arm());
  add_object(scene, "post", geometric::Cylinder{0.05, 0.3}, Eigen::Vector3d(-0.5, 0.0, 0.0));
  return planar_problem(std::move(scene), planar_configuration(-0.5, 0.3, 0.1),
                        planar_configuration(0.6, -0.2, -0.1, 0.3, 0.1));
}

PlanningProblem post_problem() {
  Scene scene = scene_of(planar_hand_arm());
  add_object(scene, "post", geometric::Cylinder{0.01, 0.3}, Eigen::Vector3d(0.755, 0.0, 0.0));
  return planar_problem(std::move(scene), planar_configuration(-0.4, 0.0),
                        planar_configuration(0.4, 0.0));
}

namespace {

Scene endless_scene() {
  geometric::RobotDescription robot = planar_hand_arm();
  geometric::JointLimits& shoulder = robot.joints.front().limits;
  shoulder.lower = -std::numeric_limits<double>::infinity();
  shoulder.upper = std::numeric_limits<double>::infinity();
  Scene scene = scene_of(std::move(robot));
  add_object(scene, "post", geometric::Cylinder{0.05, 0.3}, Eigen::Vector3d(0.0, 1.5, 0.0));
  return scene;
}

}  // namespace

PlanningProblem endless_problem(double shoulder_start, double shoulder_goal) {
  return planar_problem(endless_scene(), planar_configuration(shoulder_start, 0.0),
                        planar_configuration(shoulder_goal, 0.0));
}

PlanningProblem endless_problem_with_wall() {
  Scene scene = endless_scene();
  add_object(scene, "wall", geometric::Box{{0.6, 0.005, 0.2}}, Eigen::Vector3d(-0.5, 0.0, 0.0));
  return planar_problem(std::move(scene), planar_configuration(2.7, 0.0),
                        planar_configuration(-2.7, 0.0));
}

PlanningProblem walled_in_problem() {
  Scene scene = scene_of(planar_hand_arm());
  constexpr double kGoal = 1.0;
  for (const double side : {-0.35, 0.35}) {
    const double angle = kGoal + side;
    add_object(scene, side < 0 ? "right wall" : "left wall", geometric::Box{{0.18, 0.005, 0.2}},
               geometric::pose_from_rpy({0.19 * std::cos(angle), 0.19 * std::sin(angle), 0.0}, 0.0,
                                        0.0, angle));
  }
  return planar_problem(std::move(scene), planar_configuration(-1.0, 0.0),
                        planar_configuration(kGoal, 0.0));
}

}  // namespace handway::test
