#include "kautham_model.h"

#include "handway/geometric/io/existing_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

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

// The turn about, or the slide along, z by q: commutes with Rz(theta) Tz(d).
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

// Do the controls always give the joint the value of the one above it? Warns of
// one that differs in some controls while others move both alike.
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

// For each joint the one that leads it; itself if it is not coupled.
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

void add_groups(const KauthamRobot& robot, geometric::RobotDescription& description) {
  const std::vector<bool> in_arm = arm_joints(robot);
  geometric::JointGroup arm{"arm", {}};
  geometric::JointGroup hand{"hand", {}};
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

int index_of(const KauthamRobot& robot, const std::string& joint) {
  return static_cast<int>(std::ranges::find(robot.joints, joint, &KauthamJoint::name) -
                          robot.joints.begin());
}

}  // namespace

Pose root_pose(const KauthamRobot& robot) { return zero_pose(robot.joints.front()); }

std::shared_ptr<const geometric::RobotModel> make_robot_model(const KauthamRobot& robot,
                                                              double scale,
                                                              InventorMeshes& meshes) {
  geometric::RobotDescription description;
  description.name = robot.name;
  description.file = robot.file;
  description.warnings = robot.warnings;
  const std::vector<int> leaders = find_leaders(robot, description.warnings);
  std::vector<std::string> in_other_letters;
  for (int i = 0; i < static_cast<int>(robot.joints.size()); ++i) {
    const KauthamJoint& from = joint_at(robot, i);
    const std::filesystem::path file = geometric::existing_file(from.mesh);
    if (geometric::differs_in_case(from.mesh, file)) {
      in_other_letters.push_back(from.mesh.filename().string());
    }
    const InventorMesh& mesh = meshes.load(file, scale);
    const geometric::Mesh shape{std::filesystem::absolute(file).lexically_normal(),
                                Eigen::Vector3d::Constant(scale), mesh.triangles};
    const geometric::LinkGeometry geometry{shape, Pose::Identity(), mesh.color};
    description.links.push_back({from.name, {geometry}, {geometry}});
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
    joints.push_back(index_of(robot, basis->joints.back()));
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

geometric::Configuration configuration_at(const KauthamRobot& robot,
                                          const geometric::RobotModel& model,
                                          const Eigen::VectorXd& controls) {
  const Eigen::VectorXd p = joint_parameters(robot, controls);
  geometric::Configuration q(model.variable_count());
  for (int v = 0; v < model.variable_count(); ++v) {
    const int joint = index_of(robot, model.variable(v).name);
    q[v] = joint_value(joint_at(robot, joint), p[joint]);
  }
  return q;
}

}  // namespace handway::import_kautham
