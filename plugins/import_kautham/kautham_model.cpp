#include "kautham_model.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/robot/base_joint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace handway::import_kautham {
namespace {

using geometric::AllowedReason;
using geometric::Pose;

constexpr std::string_view kUncheckedLink = "Palm";

const KauthamJoint& joint_at(const KauthamRobot& robot, int index) {
  return robot.joints[static_cast<std::size_t>(index)];
}

// PreTrans * Rx(alpha) Tx(a) Rz(theta) Tz(d): the link's pose at q = 0.
Pose zero_pose(const KauthamJoint& joint) {
  return joint.X_PreTrans * Eigen::AngleAxisd(joint.alpha, Eigen::Vector3d::UnitX()) *
         Eigen::Translation3d(joint.a, 0.0, 0.0) *
         Eigen::AngleAxisd(joint.theta, Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(0.0, 0.0, joint.d);
}

// The rotation about, or the slide along, z by q: commutes with Rz(theta) Tz(d).
Pose motion(const KauthamJoint& joint, double q) {
  Pose X = Pose::Identity();
  if (joint.rotational) {
    X.linear() = Eigen::AngleAxisd(q, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  } else {
    X.translation().z() = q;
  }
  return X;
}

bool have_same_range(const KauthamJoint& a, const KauthamJoint& b) {
  return moves(a) && moves(b) && a.rotational == b.rotational && a.lower == b.lower &&
         a.upper == b.upper;
}

// Returns whether the controls always give the joint the value of the one above it. Warns of a
// joint that differs in some controls while others move both together.
bool is_coupled(const KauthamRobot& robot, int joint, std::vector<std::string>& warnings) {
  const int parent = joint_at(robot, joint).parent;
  if (parent <= 0 || !have_same_range(joint_at(robot, parent), joint_at(robot, joint)) ||
      robot.offset[parent] != robot.offset[joint]) {
    return false;
  }
  bool alike = false;
  std::string differing;
  for (const KauthamControl& control : robot.controls) {
    if (control.factors[joint] != control.factors[parent]) {
      differing += " " + control.name;
    } else {
      alike = alike || control.factors[joint] != 0.0;
    }
  }
  if (alike && !differing.empty()) {
    warnings.push_back("joint " + joint_at(robot, joint).name + " would follow " +
                       joint_at(robot, parent).name + " but for control" + differing +
                       "; it moves on its own");
  }
  return alike && differing.empty();
}

// For each joint its leader; itself if it is not coupled.
std::vector<int> find_leaders(const KauthamRobot& robot, std::vector<std::string>& warnings) {
  std::vector<int> leaders;
  leaders.reserve(robot.joints.size());
  for (int i = 0; i < static_cast<int>(robot.joints.size()); ++i) {
    leaders.push_back(is_coupled(robot, i, warnings)
                          ? leaders[static_cast<std::size_t>(joint_at(robot, i).parent)]
                          : i);
  }
  return leaders;
}

geometric::Joint convert_joint(const KauthamRobot& robot, int index, int leader) {
  const KauthamJoint& from = joint_at(robot, index);
  geometric::Joint joint;
  joint.name = from.name;
  joint.parent = joint_at(robot, from.parent).name;
  joint.child = from.name;
  joint.X_PJ = zero_pose(from);
  if (!moves(from)) {
    const bool held = from.lower == from.upper;
    joint.X_PJ = joint.X_PJ * motion(from, held ? from.lower : 0.0);
    return joint;
  }
  joint.type = from.rotational ? geometric::JointType::kRevolute : geometric::JointType::kPrismatic;
  joint.limits.lower = from.lower;
  joint.limits.upper = from.upper;
  if (leader != index) {
    joint.mimic = geometric::Mimic{joint_at(robot, leader).name, 1.0, 0.0};
  }
  return joint;
}

void allow_unchecked_pairs(geometric::RobotDescription& description) {
  const auto& links = description.links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (std::size_t j = i + 1; j < links.size(); ++j) {
      if (j == i + 1) {
        description.allowed_collisions.allow(links[i].name, links[j].name,
                                             AllowedReason::kAdjacent);
      } else if (links[i].name == kUncheckedLink) {
        description.allowed_collisions.allow(links[i].name, links[j].name, AllowedReason::kUser);
      }
    }
  }
}

// Joints up to the first link that carries more than one other.
std::vector<bool> joints_before_branching(const KauthamRobot& robot) {
  std::vector<bool> result(robot.joints.size(), false);
  int at = 0;
  while (true) {
    result[static_cast<std::size_t>(at)] = true;
    if (std::ranges::count(robot.joints, at, &KauthamJoint::parent) != 1) {
      return result;
    }
    at = static_cast<int>(std::ranges::find(robot.joints, at, &KauthamJoint::parent) -
                          robot.joints.begin());
  }
}

std::vector<bool> arm_joints(const KauthamRobot& robot) {
  if (robot.trunk_controls < 0) {
    return joints_before_branching(robot);
  }
  std::vector<bool> result(robot.joints.size(), false);
  for (int c = 0; c < robot.trunk_controls; ++c) {
    const Eigen::VectorXd& factors = robot.controls[static_cast<std::size_t>(c)].factors;
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = result[i] || factors[static_cast<Eigen::Index>(i)] != 0.0;
    }
  }
  return result;
}

// Ends of the base's range in the frame of the Home, by Kautham's rule: the coordinates of the two
// corners there.
BaseLimits home_limits(const BaseLimits& limits, const Pose& X_WH) {
  const auto corner = [&](auto end) -> Eigen::Vector3d {
    return X_WH.inverse() * Eigen::Vector3d(end(limits[0]), end(limits[1]), end(limits[2]));
  };
  const Eigen::Vector3d low = corner([](const auto& range) { return range.first; });
  const Eigen::Vector3d high = corner([](const auto& range) { return range.second; });
  BaseLimits home{};
  for (std::size_t axis = 0; axis < home.size(); ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    home[axis] = low[i] == high[i] ? std::pair(0.0, 0.0) : std::pair(low[i], high[i]);
  }
  return home;
}

constexpr std::array<const char*, 3> kSlides = {"X", "Y", "Z"};

enum class BaseTurns { kNone, kYaw, kAll };

BaseTurns turns_of(const KauthamRobot& robot) {
  const std::array<bool, 6> moving = moving_base(robot);
  if (!moving[3] && !moving[4] && !moving[5]) {
    return BaseTurns::kNone;
  }
  return !moving[3] && robot.base_offset[3] == 0.0 ? BaseTurns::kYaw : BaseTurns::kAll;
}

bool base_moves(const KauthamRobot& robot) {
  const std::array<bool, 6> moving = moving_base(robot);
  return std::ranges::count(moving, true) > 0;
}

// Appends a link without shape and the joint that carries it.
void add_base_link(geometric::RobotDescription& robot, const std::string& name,
                   geometric::Joint joint) {
  joint.name = name;
  joint.parent = robot.links.back().name;
  joint.child = name;
  robot.links.push_back({name, {}, {}});
  robot.joints.push_back(std::move(joint));
}

// The joints that move the base, before its first link; that one is added by the caller.
void add_base(const KauthamRobot& robot, const BaseLimits& home, geometric::RobotDescription& to) {
  constexpr double kForever = std::numeric_limits<double>::infinity();
  const std::array<bool, 6> moving = moving_base(robot);
  to.links.push_back({"home", {}, {}});
  Pose X = Pose::Identity();  // of what stands still before the next joint
  for (std::size_t axis = 0; axis < kSlides.size(); ++axis) {
    const auto [low, high] = home[axis];
    const auto i = static_cast<Eigen::Index>(axis);
    if (!moving[axis] || low == high) {
      X.translation()[i] += low + robot.base_offset[i] * (high - low);
      continue;
    }
    geometric::Joint slide;
    slide.type = geometric::JointType::kPrismatic;
    slide.X_PJ = std::exchange(X, Pose::Identity());
    slide.axis = Eigen::Vector3d::Unit(i);
    slide.limits.lower = std::min(low, high);
    slide.limits.upper = std::max(low, high);
    add_base_link(to, kSlides[axis], std::move(slide));
  }
  const BaseTurns turns = turns_of(robot);
  if (turns == BaseTurns::kNone) {
    X = X * base_rotation(robot.base_offset);
  }
  const auto turn = [&](const char* name, const Eigen::Vector3d& axis, double most) {
    geometric::Joint joint;
    joint.type = geometric::JointType::kRevolute;
    joint.X_PJ = std::exchange(X, Pose::Identity());
    joint.axis = axis;
    joint.limits.lower = -most;
    joint.limits.upper = most;
    add_base_link(to, name, std::move(joint));
  };
  if (turns != BaseTurns::kNone) {
    turn("yaw", Eigen::Vector3d::UnitZ(), kForever);
  }
  if (turns == BaseTurns::kAll) {
    turn("pitch", Eigen::Vector3d::UnitY(), std::numbers::pi / 2.0);
    turn("roll", Eigen::Vector3d::UnitX(), kForever);
  }
  geometric::Joint last;
  last.X_PJ = X * zero_pose(robot.joints.front());
  last.name = "base";
  last.parent = to.links.back().name;
  last.child = robot.joints.front().name;
  to.joints.push_back(std::move(last));
}

void add_groups(const KauthamRobot& robot, geometric::RobotDescription& description) {
  const std::vector<bool> in_arm = arm_joints(robot);
  geometric::JointGroup arm{"arm", {}};
  geometric::JointGroup hand{"hand", {}};
  for (const geometric::Joint& joint : description.joints) {
    if (joint.type != geometric::JointType::kFixed &&
        std::ranges::count(robot.joints, joint.child, &KauthamJoint::name) == 0) {
      arm.joints.push_back(joint.name);
    }
  }
  for (std::size_t i = 1; i < robot.joints.size(); ++i) {
    if (moves(robot.joints[i])) {
      (in_arm[i] ? arm : hand).joints.push_back(robot.joints[i].name);
    }
  }
  for (geometric::JointGroup& group : {std::ref(arm), std::ref(hand)}) {
    if (!group.joints.empty()) {
      description.groups.push_back(std::move(group));
    }
  }
}

// Index of the joint that carries the variable's link; nothing for one of the base.
std::optional<int> joint_of(const KauthamRobot& robot, const geometric::RobotModel& model,
                            int variable) {
  const auto found =
      std::ranges::find(robot.joints, model.variable(variable).child, &KauthamJoint::name);
  return found == robot.joints.end()
             ? std::nullopt
             : std::optional(static_cast<int>(found - robot.joints.begin()));
}

}  // namespace

Pose root_pose(const KauthamRobot& robot) {
  return base_moves(robot) ? Pose::Identity() : zero_pose(robot.joints.front());
}

std::shared_ptr<const geometric::RobotModel> make_robot_model(const KauthamRobot& robot,
                                                              double scale,
                                                              const BaseLimits& limits,
                                                              const Pose& X_WH,
                                                              InventorMeshes& meshes) {
  geometric::RobotDescription description;
  description.name = robot.name;
  description.file = robot.file;
  description.warnings = robot.warnings;
  const std::vector<int> leaders = find_leaders(robot, description.warnings);
  std::vector<std::string> in_other_letters;
  const auto geometry_of = [&](const std::filesystem::path& written) {
    const std::filesystem::path file = geometric::existing_file(written);
    if (geometric::differs_in_case(written, file)) {
      in_other_letters.push_back(written.filename().string());
    }
    const InventorMesh& mesh = meshes.load(file, scale);
    const geometric::Mesh shape{std::filesystem::absolute(file).lexically_normal(),
                                Eigen::Vector3d::Constant(scale), mesh.triangles};
    return geometric::LinkGeometry{shape, Pose::Identity(), mesh.color};
  };
  if (base_moves(robot)) {
    add_base(robot, home_limits(limits, X_WH), description);
  }
  for (int i = 0; i < static_cast<int>(robot.joints.size()); ++i) {
    const KauthamJoint& from = joint_at(robot, i);
    const geometric::LinkGeometry seen = geometry_of(from.mesh);
    description.links.push_back(
        {from.name,
         {seen},
         {from.collision_mesh.empty() ? seen : geometry_of(from.collision_mesh)}});
    if (i > 0) {
      description.joints.push_back(convert_joint(robot, i, leaders[static_cast<std::size_t>(i)]));
    }
  }
  if (!in_other_letters.empty()) {
    description.warnings.push_back(
        fmt::format("meshes whose names have other letters on the disk: {}",
                    fmt::join(in_other_letters, ", ")));
  }
  allow_unchecked_pairs(description);
  add_groups(robot, description);
  return std::make_shared<const geometric::RobotModel>(std::move(description));
}

std::shared_ptr<const sampling::PmdBasis> make_hand_basis(const KauthamRobot& robot,
                                                          const geometric::RobotModel& model,
                                                          std::vector<std::string>& warnings) {
  const auto hand = model.find_group("hand");
  if (!hand) {
    return nullptr;
  }
  auto basis = std::make_shared<sampling::PmdBasis>();
  basis->hand = robot.name;
  basis->source = robot.file.filename().string();
  std::vector<int> joints;
  for (const int variable : *hand) {
    basis->joints.push_back(model.variable(variable).name);
    joints.push_back(joint_of(robot, model, variable).value());
  }
  basis->mean = robot.offset(joints);
  std::string not_unit;
  for (std::size_t c = 0; c < robot.controls.size(); ++c) {
    const KauthamControl& control = robot.controls[c];
    const Eigen::VectorXd vector = control.factors(joints);
    const auto driven = (vector.array() != 0.0).count();
    if (driven == 0) {
      continue;
    }
    if (static_cast<int>(c) < robot.trunk_controls) {
      warnings.push_back("control " + control.name + " moves arm and hand together; the basis " +
                         "holds its part of the hand");
    }
    Eigen::Index largest = 0;
    const double size = vector.cwiseAbs().maxCoeff(&largest);
    if (driven == 1 && size == 1.0 && control.eig_value > 0.0) {
      basis->free_joints.push_back(
          {static_cast<int>(largest), basis->mean[largest], 0.5 * control.eig_value});
      continue;
    }
    if (std::abs(vector.norm() - 1.0) > 0.01) {
      not_unit += " " + control.name;
    }
    basis->directions.push_back({control.name, vector, 0.5 * control.eig_value, 0.0});
  }
  if (!not_unit.empty()) {
    warnings.push_back(
        "not of unit length over the joints that move on their own: the vectors of "
        "controls" +
        not_unit);
  }
  std::ranges::stable_sort(basis->directions, std::ranges::greater{},
                           &sampling::PrincipalDirection::half_side);
  return basis->dimension() > 0 ? basis : nullptr;
}

KauthamRobot controlled_robot(const geometric::RobotModel& model) {
  KauthamRobot robot;
  robot.name = model.name();
  robot.file = model.description().file;
  for (int link = 0; link < model.link_count(); ++link) {
    KauthamJoint joint;
    joint.name = model.link(link).name;
    joint.parent = model.parent(link);
    joint.movable = link > 0 && model.mimic_mapping(link).variable >= 0 && !model.joint(link).mimic;
    if (joint.movable) {
      // Kautham turns a continuous joint by two turns at most.
      const bool endless = model.joint(link).is_continuous();
      const double most = 4.0 * std::numbers::pi;
      joint.lower = endless ? -0.5 * most : model.joint(link).limits.lower;
      joint.upper = endless ? 0.5 * most : model.joint(link).limits.upper;
    }
    robot.joints.push_back(std::move(joint));
  }
  robot.offset = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(robot.joints.size()), 0.5);
  return robot;
}

geometric::Configuration configuration_at(const KauthamRobot& robot,
                                          const geometric::RobotModel& model,
                                          const Eigen::VectorXd& controls, const BaseLimits& limits,
                                          const Pose& X_WH) {
  const Eigen::VectorXd p = joint_parameters(robot, controls);
  const BaseParameters base = base_parameters(robot, controls);
  const BaseLimits home = home_limits(limits, X_WH);
  const geometric::Pose X_HB(base_rotation(base));
  const std::vector<double> turns =
      geometric::values_at({"base", geometric::BaseMotion::kFloating}, X_HB);  // slides, turns
  geometric::Configuration q(model.variable_count());
  for (int v = 0; v < model.variable_count(); ++v) {
    const std::string& name = model.variable(v).name;
    if (const std::optional<int> joint = joint_of(robot, model, v)) {
      q[v] = joint_value(joint_at(robot, *joint), p[*joint]);
    } else if (const auto slide = std::ranges::find(kSlides, name); slide != kSlides.end()) {
      const auto axis = static_cast<std::size_t>(slide - kSlides.begin());
      const auto [low, high] = home[axis];
      q[v] = low + base[static_cast<Eigen::Index>(axis)] * (high - low);
    } else {
      q[v] = turns[name == "yaw" ? 3 : name == "pitch" ? 4 : 5];
    }
  }
  return q;
}

}  // namespace handway::import_kautham
