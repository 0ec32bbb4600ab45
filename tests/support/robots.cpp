#include "handway_test/robots.h"

#include "handway/geometric/math/units.h"

#include <array>
#include <span>
#include <string>
#include <utility>

namespace handway::test {
namespace {

using geometric::Joint;
using geometric::JointType;
using geometric::metres;
using geometric::Mimic;
using geometric::Pose;
using geometric::radians;
using geometric::RobotDescription;

/// One row of a modified Denavit-Hartenberg table: degrees and millimetres.
struct DhRow {
  double alpha, a, theta, d;
};

struct Range {
  double lower, upper;  ///< Degrees.
};

constexpr std::array<Range, 6> kArmLimits = {
    {{-180, 180}, {-130, 147.5}, {-145, 145}, {-270, 270}, {-115, 140}, {-270, 270}}};

Pose dh_pose(const DhRow& row) {
  Pose X = Pose::Identity();
  X.rotate(Eigen::AngleAxisd(radians(row.alpha), Eigen::Vector3d::UnitX()));
  X.translate(Eigen::Vector3d(metres(row.a), 0, 0));
  X.rotate(Eigen::AngleAxisd(radians(row.theta), Eigen::Vector3d::UnitZ()));
  X.translate(Eigen::Vector3d(0, 0, metres(row.d)));
  return X;
}

Pose translation_mm(double x, double y, double z) {
  return Pose(Eigen::Translation3d(metres(x), metres(y), metres(z)));
}

void add(RobotDescription& robot, std::string parent, const std::string& name,
         const std::string& joint_name, const Pose& X_PJ, const Eigen::Vector3d& axis,
         const Range& range) {
  robot.links.push_back({name, {}, {}});
  Joint joint;
  joint.name = joint_name;
  joint.type = JointType::kRevolute;
  joint.parent = std::move(parent);
  joint.child = name;
  joint.X_PJ = X_PJ;
  joint.axis = axis;
  joint.limits.lower = radians(range.lower);
  joint.limits.upper = radians(range.upper);
  robot.joints.push_back(joint);
}

void add_fixed(RobotDescription& robot, const std::string& parent, const std::string& name) {
  robot.links.push_back({name, {}, {}});
  Joint joint;
  joint.name = parent + "_to_" + name;
  joint.parent = parent;
  joint.child = name;
  robot.joints.push_back(joint);
}

void add_finger(RobotDescription& robot, const std::string& finger, const std::string& parent,
                const Pose& X_PF) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const auto link = [&](const char* part) { return finger + "-" + part; };
  add(robot, parent, link("Base"), link("Base"), X_PF, z, {-15, 15});
  add(robot, link("Base"), link("Prox"), link("Prox"), dh_pose({-90, 0, 0, 0}), z, {-75, 4});
  add(robot, link("Prox"), link("Med"), link("Med"), dh_pose({0, 67.8, 0, 0}), z, {-75, -4});
  add(robot, link("Med"), link("Dist"), link("Dist"), dh_pose({0, 30, -90, 0}), z, {-75, -4});
  robot.joints.back().mimic = Mimic{link("Med"), 1.0, 0.0};
}

Pose finger_mount(double x, double y, double z, const Eigen::Vector3d& axis, double angle) {
  return translation_mm(x, y, z) * Eigen::AngleAxisd(radians(angle), axis.normalized());
}

RobotDescription dh_arm(const std::string& name, std::span<const DhRow> rows,
                        std::span<const Range> limits) {
  RobotDescription robot;
  robot.name = name;
  robot.links.push_back({"base", {}, {}});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    add(robot, robot.links.back().name, "link_" + number, "joint_" + number, dh_pose(rows[i]),
        Eigen::Vector3d::UnitZ(), limits[i]);
  }
  return robot;
}

}  // namespace

RobotDescription tx90_urdf_style() {
  const std::array<Pose, 6> origins = {translation_mm(0, 0, 478),  translation_mm(50, 0, 0),
                                       translation_mm(0, 50, 425), translation_mm(0, 0, 0),
                                       translation_mm(0, 0, 425),  translation_mm(0, 0, 100)};
  const std::array<Eigen::Vector3d, 6> axes = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(),
                                               Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(),
                                               Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  RobotDescription robot;
  robot.name = "tx90";
  robot.links.push_back({"base_link", {}, {}});
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string number = std::to_string(i + 1);
    add(robot, robot.links.back().name, "link_" + number, "joint_" + number, origins[i], axes[i],
        kArmLimits[i]);
  }
  add_fixed(robot, "link_6", "flange");
  return robot;
}

RobotDescription tx90_dh_style() {
  constexpr std::array<DhRow, 6> kRows = {{{0, 0, 0, 478},
                                           {-90, 50, -90, 50},
                                           {0, 425, 90, 0},
                                           {90, 0, 0, 425},
                                           {-90, 0, 0, 0},
                                           {90, 0, 0, 100}}};
  constexpr std::array<const char*, 6> kNames = {"Shoulder", "ForeArm", "Elbow",
                                                 "Arm",      "Wrist",   "Tcp"};
  RobotDescription robot;
  robot.name = "TX90";
  robot.links.push_back({"Base", {}, {}});
  for (std::size_t i = 0; i < 6; ++i) {
    add(robot, robot.links.back().name, kNames[i], kNames[i], dh_pose(kRows[i]),
        Eigen::Vector3d::UnitZ(), kArmLimits[i]);
  }
  return robot;
}

void add_sah_hand(RobotDescription& robot, const std::string& mount) {
  add_fixed(robot, mount, "Palm");
  add(robot, "Palm", "Thumb", "Thumb", translation_mm(-3, 27.1, 0), Eigen::Vector3d::UnitZ(),
      {-90, 0});
  add_finger(robot, "Thumb", "Thumb", finger_mount(-6, 86.9, 97, {0.419, -0.419, 0.805}, 102.31));
  add_finger(robot, "Index", "Palm",
             finger_mount(-4.3, 40.165, 145.43, {0.707, 0.0125, 0.707}, 178.5623));
  add_finger(robot, "Mid", "Palm", finger_mount(-4.3, 0, 150.143, {0.707, 0, 0.707}, 180));
  add_finger(robot, "Ring", "Palm",
             finger_mount(-4.3, -40.165, 145.43, {0.707, -0.0121, 0.707}, 181.3898));
}

RobotDescription tx90_sah() {
  RobotDescription robot = tx90_urdf_style();
  robot.name = "tx90_sah";
  robot.links.pop_back();
  robot.joints.pop_back();
  add_sah_hand(robot, "link_6");
  return robot;
}

RobotDescription ur5e() {
  constexpr std::array<DhRow, 6> kRows = {{{0, 0, 0, 162.5},
                                           {90, 0, 0, 0},
                                           {0, -425, 0, 0},
                                           {0, -392.2, 0, 133.3},
                                           {90, 0, 0, 99.7},
                                           {-90, 0, 0, 99.6}}};
  constexpr std::array<Range, 6> kLimits = {
      {{-360, 360}, {-360, 360}, {-180, 180}, {-360, 360}, {-360, 360}, {-360, 360}}};
  return dh_arm("ur5e", kRows, kLimits);
}

RobotDescription panda_arm() {
  constexpr std::array<DhRow, 7> kRows = {{{0, 0, 0, 333},
                                           {-90, 0, 0, 0},
                                           {90, 0, 0, 316},
                                           {90, 82.5, 0, 0},
                                           {-90, -82.5, 0, 384},
                                           {90, 0, 0, 0},
                                           {90, 88, 0, 107}}};
  constexpr std::array<Range, 7> kLimits = {
      {{-166, 166}, {-101, 101}, {-166, 166}, {-176, -4}, {-166, 166}, {-1, 215}, {-166, 166}}};
  return dh_arm("panda", kRows, kLimits);
}

RobotDescription iiwa14() {
  constexpr std::array<DhRow, 7> kRows = {{{0, 0, 0, 360},
                                           {-90, 0, 0, 0},
                                           {90, 0, 0, 420},
                                           {90, 0, 0, 0},
                                           {-90, 0, 0, 400},
                                           {-90, 0, 0, 0},
                                           {90, 0, 0, 126}}};
  constexpr std::array<Range, 7> kLimits = {
      {{-170, 170}, {-120, 120}, {-170, 170}, {-120, 120}, {-170, 170}, {-120, 120}, {-175, 175}}};
  return dh_arm("iiwa14", kRows, kLimits);
}

Joint turning(const std::string& name, const std::string& parent, const std::string& child,
              double lower, double upper) {
  Joint joint;
  joint.name = name;
  joint.type = JointType::kRevolute;
  joint.parent = parent;
  joint.child = child;
  joint.limits.lower = lower;
  joint.limits.upper = upper;
  return joint;
}

}  // namespace handway::test
