#include "handway_test/solid_robots.h"

#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/robots.h"

#include <utility>

namespace handway::test {
namespace {

using geometric::AllowedReason;
using geometric::Box;
using geometric::CollisionWorld;
using geometric::Cone;
using geometric::Cylinder;
using geometric::FclChecker;
using geometric::Joint;
using geometric::JointType;
using geometric::Link;
using geometric::Mesh;
using geometric::Mimic;
using geometric::NamedPair;
using geometric::Pose;
using geometric::RobotDescription;
using geometric::RobotInstance;
using geometric::RobotModel;
using geometric::Scene;
using geometric::Shape;
using geometric::Sphere;

Pose at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

Link& link_named(RobotDescription& robot, const std::string& name) {
  for (Link& link : robot.links) {
    if (link.name == name) {
      return link;
    }
  }
  robot.links.push_back({name, {}, {}});
  return robot.links.back();
}

void add_body(RobotDescription& robot, const std::string& link, const Shape& shape,
              const Pose& X_LG) {
  link_named(robot, link).collision.push_back({shape, X_LG, {}});
}

// Adds a bar from `begin` to `end` in the link's frame.
void add_bar(RobotDescription& robot, const std::string& link, const Eigen::Vector3d& begin,
             const Eigen::Vector3d& end, double radius) {
  Pose X = Pose::Identity();
  X.translation() = 0.5 * (begin + end);
  X.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), end - begin).toRotationMatrix();
  add_body(robot, link, Cylinder{radius, (end - begin).norm()}, X);
}

void add_joint(RobotDescription& robot, JointType type, const std::string& name,
               const std::string& parent, const std::string& child, const Pose& X_PJ,
               const Eigen::Vector3d& axis, double lower, double upper) {
  link_named(robot, parent);
  link_named(robot, child);
  Joint joint;
  joint.type = type;
  joint.name = name;
  joint.parent = parent;
  joint.child = child;
  joint.X_PJ = X_PJ;
  joint.axis = axis;
  joint.limits.lower = lower;
  joint.limits.upper = upper;
  robot.joints.push_back(joint);
}

void allow_touching_at_neutral(RobotDescription& robot) {
  FclChecker checker(std::make_shared<const CollisionWorld>(scene_of(robot)));
  for (const NamedPair& pair : find_collisions(checker, checker.world().model().neutral())) {
    robot.allowed_collisions.allow(pair.a, pair.b, AllowedReason::kUser);
  }
}

}  // namespace

void allow_neighbours(RobotDescription& robot) {
  for (const Joint& joint : robot.joints) {
    robot.allowed_collisions.allow(joint.parent, joint.child, AllowedReason::kAdjacent);
  }
}

RobotDescription solid_tx90_sah() {
  RobotDescription robot = tx90_sah();
  add_bar(robot, "base_link", {0, 0, 0}, {0, 0, 0.35}, 0.12);
  add_bar(robot, "link_1", {0, 0, -0.12}, {0, 0, 0.1}, 0.1);
  add_bar(robot, "link_2", {0, 0.1, 0}, {0, 0.1, 0.425}, 0.08);
  add_bar(robot, "link_3", {0, -0.05, 0}, {0, 0.06, 0}, 0.08);
  add_bar(robot, "link_4", {0, 0, 0.1}, {0, 0, 0.38}, 0.06);
  add_bar(robot, "link_5", {0, 0, -0.04}, {0, 0, 0.05}, 0.05);
  add_bar(robot, "link_6", {0, 0, -0.02}, {0, 0, 0}, 0.04);
  add_body(robot, "Palm", Box{{0.03, 0.1, 0.12}}, at(-0.005, 0, 0.075));
  add_body(robot, "Thumb", Box{{0.03, 0.04, 0.06}}, at(-0.003, 0.06, 0.07));
  for (const std::string finger : {"Thumb", "Index", "Mid", "Ring"}) {
    add_body(robot, finger + "-Base", Sphere{0.011}, Pose::Identity());
    add_bar(robot, finger + "-Prox", {0.01, 0, 0}, {0.06, 0, 0}, 0.01);
    add_bar(robot, finger + "-Med", {0.003, 0, 0}, {0.027, 0, 0}, 0.009);
    add_body(robot, finger + "-Dist", as_mesh(Cone{0.009, 0.03}),
             Pose(Eigen::Translation3d(0, 0.018, 0) *
                  Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX())));
  }
  allow_neighbours(robot);
  allow_touching_at_neutral(robot);
  return robot;
}

RobotDescription gantry(const Shape& probe) {
  RobotDescription robot;
  robot.name = "gantry";
  const JointType slides = JointType::kPrismatic;
  add_joint(robot, slides, "x", "frame", "bridge", Pose::Identity(), Eigen::Vector3d::UnitX(), -1,
            1);
  add_joint(robot, slides, "y", "bridge", "carriage", Pose::Identity(), Eigen::Vector3d::UnitY(),
            -1, 1);
  add_joint(robot, slides, "z", "carriage", "probe", Pose::Identity(), Eigen::Vector3d::UnitZ(), -1,
            1);
  add_body(robot, "probe", probe, Pose::Identity());
  return robot;
}

RobotDescription planar_hand_arm() {
  RobotDescription robot;
  robot.name = "planar";
  const auto turning = [&](const std::string& name, const std::string& parent,
                           const std::string& child, const Pose& X_PJ, double lower, double upper,
                           double direction) {
    add_joint(robot, JointType::kRevolute, name, parent, child, X_PJ,
              direction * Eigen::Vector3d::UnitZ(), lower, upper);
  };
  turning("shoulder", "base", "upper", Pose::Identity(), -2.5, 2.5, 1);
  turning("elbow", "upper", "lower", at(0.3, 0, 0), -2.5, 2.5, 1);
  add_joint(robot, JointType::kFixed, "wrist", "lower", "palm", at(0.3, 0, 0),
            Eigen::Vector3d::UnitZ(), 0, 0);
  turning("thumb", "palm", "thumb", at(0.06, 0, 0), -1.2, 1.2, 1);
  for (const auto& [finger, side] : {std::pair<std::string, double>("left", 1), {"right", -1}}) {
    turning(finger, "palm", finger, at(0.06, 0.05 * side, 0), 0, 1.5, side);
    turning(finger + "_tip", finger, finger + "_tip", at(0.06, 0, 0), 0, 1.5, side);
    robot.joints.back().mimic = Mimic{finger, 0.5, 0.0};
    add_body(robot, finger, Box{{0.05, 0.016, 0.02}}, at(0.03, 0, 0));
    add_body(robot, finger + "_tip", Box{{0.05, 0.014, 0.02}}, at(0.035, 0, 0));
  }
  add_body(robot, "upper", Box{{0.28, 0.04, 0.03}}, at(0.15, 0, 0));
  add_body(robot, "lower", Box{{0.26, 0.04, 0.03}}, at(0.16, 0, 0));
  add_body(robot, "palm", Box{{0.04, 0.12, 0.03}}, at(0.02, 0, 0));
  add_body(robot, "thumb", Box{{0.06, 0.016, 0.02}}, at(0.04, 0, 0));
  allow_neighbours(robot);
  robot.groups = {{"arm", {"shoulder", "elbow"}}, {"hand", {"thumb", "left", "right"}}};
  return robot;
}

Scene scene_of(RobotDescription robot) {
  Scene scene;
  RobotInstance instance;
  instance.name = robot.name;
  instance.model = std::make_shared<const RobotModel>(std::move(robot));
  instance.configuration = instance.model->neutral();
  scene.robots.push_back(std::move(instance));
  return scene;
}

void add_object(Scene& scene, const std::string& name, const Shape& shape, const Pose& X_WO) {
  scene.objects.push_back({name, shape, X_WO, {}, {}});
}

void add_object(Scene& scene, const std::string& name, const Shape& shape,
                const Eigen::Vector3d& p_WO) {
  add_object(scene, name, shape, Pose(Eigen::Translation3d(p_WO)));
}

Mesh as_mesh(const Shape& shape) { return {"", Eigen::Vector3d::Ones(), tessellate(shape)}; }

}  // namespace handway::test
