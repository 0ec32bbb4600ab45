#include "grasps/grasping_hand.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/grasps/given_grasps.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::YamlElement;

constexpr double kRotationTolerance = 1e-3;  // of numbers that others round
constexpr double kCouplingTolerance = 1e-2;  // rad or m, of coupled joints that are simulated

// `{xyz: […], rpy: […]}` of Handway's grasp files, m and degrees.
Pose pose_of_map(const YamlElement& element) {
  element.allow_keys({"xyz", "rpy"});
  const Vector3d p = element.need("xyz").numbers(3);
  const Vector3d rpy = element.numbers_or("rpy", Vector3d::Zero());
  return geometric::pose_from_rpy(p, geometric::radians(rpy.x()), geometric::radians(rpy.y()),
                                  geometric::radians(rpy.z()));
}

Pose pose_of_rows(const YamlElement& element) {
  Eigen::Matrix4d X;
  for (int row = 0; row < 4; ++row) {
    X.row(row) = element.items()[static_cast<std::size_t>(row)].numbers(4).transpose();
  }
  const Eigen::Matrix3d R = X.topLeftCorner<3, 3>();
  const bool is_rigid = (R.transpose() * R).isIdentity(kRotationTolerance) &&
                        R.determinant() > 0.0 &&
                        X.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kRotationTolerance);
  if (!is_rigid) {
    element.refuse("a matrix that is no rotation and translation",
                   "rows of a rigid transform, the last of them [0, 0, 0, 1]");
  }
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  pose.translation() = X.topRightCorner<3, 1>();
  return pose;
}

Pose pose_of_numbers(const YamlElement& element) {
  const Eigen::VectorXd numbers = element.numbers(7);
  const Eigen::Quaterniond rotation(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(rotation.norm() - 1.0) > kRotationTolerance) {
    element.refuse("a quaternion whose length is not 1",
                   "[x, y, z, qx, qy, qz, qw] with a unit quaternion");
  }
  return Eigen::Translation3d(numbers.head<3>()) * rotation.normalized();
}

Pose pose_of(const YamlElement& element) {
  if (element.is_map()) {
    return pose_of_map(element);
  }
  if (element.is_list() && element.items().size() == 4) {
    return pose_of_rows(element);
  }
  if (element.is_list() && element.items().size() == 7) {
    return pose_of_numbers(element);
  }
  element.refuse(element.found(),
                 "[x, y, z, qx, qy, qz, qw], four rows of a matrix, or xyz and rpy");
}

// Refuses a value that is farther beyond the limits of a joint of the hand than they are apart.
// Others are clamped when the hand closes.
void refuse_other_unit(const YamlElement& element, const PlanningProblem& problem, int variable,
                       double value) {
  const geometric::RobotModel& model = problem.model();
  const double lower = model.lower()[variable];
  const double upper = model.upper()[variable];
  constexpr double kLeastRange = 0.05;  // rad or m, for joints without a range
  const bool is_far = std::max(lower - value, value - upper) > std::max(upper - lower, kLeastRange);
  if (is_far && !model.is_continuous(variable) &&
      std::ranges::count(problem.joints.hand, variable) > 0) {
    const bool is_slide = model.variable(variable).type == geometric::JointType::kPrismatic;
    element.refuse(fmt::format("{:g} for joint {}", value, model.variable(variable).name),
                   fmt::format("{:g} to {:g} {}", lower, upper, is_slide ? "m" : "rad"),
                   fmt::format("Is this value in {}?", is_slide ? "mm" : "degrees"));
  }
}

// The link that a moving joint carries; 0: no joint of this name moves.
int moving_link(const geometric::RobotModel& model, const std::string& name) {
  for (int link = 1; link < model.link_count(); ++link) {
    if (model.joint(link).name == name && model.mimic_mapping(link).variable >= 0) {
      return link;
    }
  }
  return 0;
}

bool has_joint(const geometric::RobotModel& model, const std::string& name) {
  return std::ranges::count(model.description().joints, name, &geometric::Joint::name) > 0;
}

// Refuses the name of no joint, unless the map has all joints of the hand: other names are then
// those of another arm.
void refuse_unknown(const YamlElement& value, const std::string& name,
                    const PlanningProblem& problem, const std::vector<bool>& given) {
  const geometric::RobotModel& model = problem.model();
  if (std::ranges::all_of(problem.joints.hand,
                          [&](int v) { return given[static_cast<std::size_t>(v)]; })) {
    return;
  }
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(model.variable_count()));
  for (int v = 0; v < model.variable_count(); ++v) {
    names.push_back(model.variable(v).name);
  }
  value.refuse("joint \"" + name + "\"", "a joint of " + model.name(),
               geometric::advise_name(name, names));
}

// The posture `q` with the joints of a map. A coupled joint determines the joint that it follows,
// if that one is not in the map.
// @param problem of the hand that grasps.
Configuration with_joints(const YamlElement& element, const PlanningProblem& problem,
                          Configuration q) {
  const geometric::RobotModel& model = problem.model();
  const auto joints = element.entries();
  std::vector<bool> given(static_cast<std::size_t>(model.variable_count()), false);
  const auto take = [&](const YamlElement& value, int variable, double q_v) {
    refuse_other_unit(value, problem, variable, q_v);
    q[variable] = q_v;
    given[static_cast<std::size_t>(variable)] = true;
  };
  for (const auto& [name, value] : joints) {
    if (const std::optional<int> variable = model.find_variable(name)) {
      take(value, *variable, value.number());
    }
  }
  for (const auto& [name, value] : joints) {
    const int link = moving_link(model, name);
    const auto& [variable, multiplier, offset] = model.mimic_mapping(link);
    if (link == 0 || model.variable_link(variable) == link || multiplier == 0.0) {
      continue;
    }
    if (!given[static_cast<std::size_t>(variable)]) {
      take(value, variable, (value.number() - offset) / multiplier);
    }
    const double coupled = geometric::joint_value(model, link, q);
    if (std::abs(value.number() - coupled) > kCouplingTolerance) {
      value.refuse(value.found(), fmt::format("{:.6g}, as coupled to joint {}", coupled,
                                              model.variable(variable).name));
    }
  }
  for (const auto& [name, value] : joints) {
    if (!has_joint(model, name)) {
      refuse_unknown(value, name, problem, given);
    }
  }
  return q;
}

YamlElement need_one_of(const YamlElement& element, const char* name, const char* other) {
  const std::optional<YamlElement> found = element.find(name);
  return found ? *found : element.need(other);
}

// Pose of the palm in that of a link.
Pose palm_in_link(const geometric::RobotModel& model, int palm, int link, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(link)].inverse() * X_BL[static_cast<std::size_t>(palm)];
}

int link_of(const std::optional<YamlElement>& element, const geometric::RobotModel& model,
            int palm) {
  if (!element) {
    return palm;
  }
  const std::optional<int> link = model.find_link(element->text());
  if (!link) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(model.link_count()));
    for (int i = 0; i < model.link_count(); ++i) {
      names.push_back(model.link(i).name);
    }
    element->refuse("link \"" + element->text() + "\"", "a link of " + model.name(),
                    geometric::advise_name(element->text(), names));
  }
  return *link;
}

}  // namespace

std::vector<GivenGrasp> read_given_grasps(const std::filesystem::path& file,
                                          const PlanningProblem& problem, std::string_view object) {
  const geometric::RobotModel& model = problem.model();
  const PlanningProblem of_hand = with_nearest_hand(problem, graspable_object(problem, object));
  const YamlElement top = YamlElement::read(file, "a file of grasps");
  if (top.is_map()) {
    top.refuse_slips({"grasps", "link"});
    if (const std::optional<YamlElement> version = top.find("handway_grasps");
        version && version->text() != "1") {
      version->refuse(version->found(), "version 1",
                      "Files of a newer version need a newer Handway");
    }
  }
  const std::vector<YamlElement> items = top.is_list() ? top.items() : top.need("grasps").items();
  const int palm = of_hand.hand.palm;
  const std::optional<YamlElement> own_palm = top.is_map() ? top.find("palm") : std::nullopt;
  const std::optional<YamlElement> named = top.is_map() ? top.find("link") : std::nullopt;
  const int link = link_of(named ? named : own_palm, model, palm);
  std::vector<GivenGrasp> grasps;
  for (const YamlElement& item : items) {
    item.refuse_slips({"pose", "palm_in_object", "joints", "grasp", "pregrasp"});
    GivenGrasp grasp{item.where(), pose_of(need_one_of(item, "pose", "palm_in_object")),
                     with_joints(need_one_of(item, "joints", "grasp"), of_hand, problem.start)};
    if (const std::optional<YamlElement> open = item.find("pregrasp")) {
      grasp.open = with_joints(*open, of_hand, grasp.q);
    }
    grasp.X_OP = grasp.X_OP * palm_in_link(model, palm, link, grasp.q);
    grasps.push_back(std::move(grasp));
  }
  if (grasps.empty()) {
    top.refuse("no grasps", "one or more");
  }
  return grasps;
}

}  // namespace handway::planning
