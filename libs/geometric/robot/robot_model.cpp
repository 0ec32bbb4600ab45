#include "handway/geometric/robot/robot_model.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/sine_cosine.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kLargestValue = 1e6;  // bound of a joint's limit, multiplier or offset
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kLimitTolerance = 1e-9;  // rad or m: roundings of a file's numbers
constexpr double kUnnoticed = 0.001;      // share of a range: followers' limits have four digits

[[noreturn]] void refuse(const RobotDescription& robot, const std::string& element,
                         const std::string& found, const std::string& expected,
                         const std::string& advice = "") {
  const std::string source = robot.file.empty() ? "robot " + robot.name : robot.file.string();
  throw InputError({source, element, found, expected, advice});
}

void check_names(const RobotDescription& robot) {
  std::set<std::string> links;
  for (const Link& link : robot.links) {
    if (!links.insert(link.name).second) {
      refuse(robot, "link " + link.name, "two links of this name", "unique names");
    }
  }
  if (links.empty()) {
    refuse(robot, "", "no link", "at least one link");
  }
  std::set<std::string> joints;
  for (const Joint& joint : robot.joints) {
    if (!joints.insert(joint.name).second) {
      refuse(robot, "joint " + joint.name, "two joints of this name", "unique names");
    }
    for (const std::string& end : {joint.parent, joint.child}) {
      if (!links.contains(end)) {
        refuse(robot, "joint " + joint.name, "unknown link \"" + end + "\"", "a link of the robot");
      }
    }
  }
}

bool is_reasonable(double value) {
  return std::isfinite(value) && std::abs(value) <= kLargestValue;
}

void check_limits(const RobotDescription& robot, const Joint& joint) {
  const std::string element = "joint " + joint.name;
  const JointLimits& limits = joint.limits;
  const bool has_none = joint.is_continuous() && limits.lower < limits.upper;
  if (!has_none && (!is_reasonable(limits.lower) || !is_reasonable(limits.upper) ||
                    limits.lower > limits.upper)) {
    refuse(robot, element, fmt::format("limits {:g} to {:g}", limits.lower, limits.upper),
           "limits within ±1000000 (rad or m), lower below upper",
           "A revolute joint that turns without end has infinite limits, both");
  }
  for (const auto& [what, limit] :
       {std::pair("velocity", limits.velocity), std::pair("acceleration", limits.acceleration)}) {
    if (!(limit >= 0.0)) {
      refuse(robot, element, fmt::format("a {} limit of {:g}", what, limit), "0 or more",
             "Leave it at 0 if it is not known");
    }
  }
}

void check_mimic(const RobotDescription& robot, const Joint& joint) {
  if (!is_reasonable(joint.mimic->multiplier) || !is_reasonable(joint.mimic->offset)) {
    refuse(robot, "joint " + joint.name,
           fmt::format("a coupling with multiplier {:g} and offset {:g}", joint.mimic->multiplier,
                       joint.mimic->offset),
           "numbers within ±1000000");
  }
}

void check_joint(const RobotDescription& robot, const Joint& joint) {
  const std::string element = "joint " + joint.name;
  if (!joint.X_PJ.matrix().allFinite()) {
    refuse(robot, element, "an origin that is not a number", "finite numbers");
  }
  if (joint.type == JointType::kFixed) {
    return;
  }
  if (!joint.axis.allFinite() || std::abs(joint.axis.norm() - 1.0) > 1e-6) {
    refuse(robot, element, "an axis of length " + std::to_string(joint.axis.norm()),
           "a unit vector");
  }
  check_limits(robot, joint);
  if (joint.mimic) {
    check_mimic(robot, joint);
  }
}

/// The values of a leading joint with which a coupled one keeps its limits.
struct Range {
  double lower;
  double upper;
};

Range allowed_by(const Joint& coupled, const RobotModel::MimicMapping& drive) {
  if (drive.multiplier == 0.0) {  // it stays where it is, whatever its leader does
    const bool is_within = drive.offset >= coupled.limits.lower - kLimitTolerance &&
                           drive.offset <= coupled.limits.upper + kLimitTolerance;
    constexpr double kAny = std::numeric_limits<double>::infinity();
    return is_within ? Range{-kAny, kAny} : Range{kLargestValue, -kLargestValue};
  }
  const double a = (coupled.limits.lower - drive.offset) / drive.multiplier;
  const double b = (coupled.limits.upper - drive.offset) / drive.multiplier;
  return {std::min(a, b), std::max(a, b)};
}

std::string shown(const Joint& joint, const JointLimits& limits) {
  return joint.type == JointType::kRevolute
             ? fmt::format("{:.2f} to {:.2f} degrees", degrees(limits.lower), degrees(limits.upper))
             : fmt::format("{:.2f} to {:.2f} mm", millimetres(limits.lower),
                           millimetres(limits.upper));
}

// A coupled joint keeps its own limits: they bound its leader.
void narrow_leader(RobotDescription& robot, int leading_link, int coupled_link,
                   const RobotModel::MimicMapping& drive) {
  Joint& leader = robot.joints[static_cast<std::size_t>(leading_link - 1)];
  Joint& coupled = robot.joints[static_cast<std::size_t>(coupled_link - 1)];
  const Range allowed = allowed_by(coupled, drive);
  const double tolerance = kLimitTolerance / std::max(1.0, std::abs(drive.multiplier));
  JointLimits narrowed = leader.limits;
  // Differences by rounding are ignored: the limits of a file stay as they are.
  if (allowed.lower > narrowed.lower + tolerance) {
    narrowed.lower = allowed.lower;
  }
  if (allowed.upper < narrowed.upper - tolerance) {
    narrowed.upper = allowed.upper;
  }
  if (narrowed.lower > narrowed.upper + tolerance) {
    refuse(robot, "joint " + coupled.name,
           fmt::format("limits of {}, which it never keeps while {} is within {}",
                       shown(coupled, coupled.limits), leader.name, shown(leader, leader.limits)),
           "limits that agree with those of the joint that it follows",
           "Correct the limits, or the multiplier and offset of the coupling");
  }
  if (narrowed.range() <= tolerance && leader.limits.range() > tolerance) {  // of the wrong sign
    robot.warnings.push_back(fmt::format(
        "the limits of joint {} ({}) are passed over: joint {}, which it follows, could not move",
        coupled.name, shown(coupled, coupled.limits), leader.name));
    std::tie(coupled.limits.lower, coupled.limits.upper) =
        std::minmax({drive.multiplier * leader.limits.lower + drive.offset,
                     drive.multiplier * leader.limits.upper + drive.offset});
    return;
  }
  narrowed.upper = std::max(narrowed.lower, narrowed.upper);
  if (narrowed.lower != leader.limits.lower || narrowed.upper != leader.limits.upper) {
    if (narrowed.range() < (1.0 - kUnnoticed) * leader.limits.range()) {
      robot.warnings.push_back(fmt::format(
          "joint {} is limited to {}: beyond, {}, which follows it, would leave its own limits",
          leader.name, shown(leader, narrowed), coupled.name));
    }
    leader.limits = narrowed;
  }
}

}  // namespace

RobotModel::RobotModel(RobotDescription description) : description_(std::move(description)) {
  check_names(description_);
  for (const Joint& joint : description_.joints) {
    check_joint(description_, joint);
  }
  sort_parents_first();
  index_variables();
}

void RobotModel::sort_parents_first() {
  std::unordered_map<std::string, const Joint*> carrier;
  std::unordered_map<std::string, std::vector<const Joint*>> children;
  for (const Joint& joint : description_.joints) {
    if (!carrier.emplace(joint.child, &joint).second) {
      refuse(description_, "link " + joint.child, "two parent joints", "a tree: one parent each");
    }
    children[joint.parent].push_back(&joint);
  }
  std::vector<const Link*> roots;
  std::unordered_map<std::string, const Link*> by_name;
  for (const Link& link : description_.links) {
    by_name[link.name] = &link;
    if (!carrier.contains(link.name)) {
      roots.push_back(&link);
    }
  }
  if (roots.size() != 1) {
    refuse(description_, "", std::to_string(roots.size()) + " root links", "one root link",
           "Join the parts with fixed joints");
  }
  std::vector<Link> links;
  std::vector<Joint> joints;
  // Depth first, children in file order, so that a finger's joints stay together.
  const std::function<void(const Link&, int)> visit = [&](const Link& link, int parent) {
    const int index = static_cast<int>(links.size());
    links.push_back(link);
    parents_.push_back(parent);
    for (const Joint* joint : children[link.name]) {
      joints.push_back(*joint);
      visit(*by_name.at(joint->child), index);
    }
  };
  visit(*roots.front(), -1);
  if (links.size() != description_.links.size()) {
    refuse(description_, "", "joints that form a loop", "a tree");
  }
  description_.links = std::move(links);
  description_.joints = std::move(joints);
}

void RobotModel::index_variables() {
  mimic_mappings_.resize(description_.links.size());
  for (int i = 1; i < link_count(); ++i) {
    if (joint(i).type != JointType::kFixed && !joint(i).mimic) {
      mimic_mappings_[static_cast<std::size_t>(i)].variable = variable_count();
      variable_links_.push_back(i);
    }
  }
  for (int i = 1; i < link_count(); ++i) {
    if (joint(i).type == JointType::kFixed || !joint(i).mimic) {
      continue;
    }
    const Mimic& mimic = *joint(i).mimic;
    const std::optional<int> leader = find_variable(mimic.joint);
    if (!leader) {
      refuse(description_, "joint " + joint(i).name, "coupling to \"" + mimic.joint + "\"",
             "a joint that moves on its own");
    }
    mimic_mappings_[static_cast<std::size_t>(i)] = {*leader, mimic.multiplier, mimic.offset};
  }
  for (int i = 1; i < link_count(); ++i) {
    if (mimic_mapping(i).variable >= 0 && joint(i).mimic) {
      narrow_leader(description_, variable_link(mimic_mapping(i).variable), i, mimic_mapping(i));
    }
  }
  for (int i = 1; i < link_count(); ++i) {
    const auto& [variable, multiplier, offset] = mimic_mapping(i);
    steps_.push_back(forward_kinematics_step(joint(i), parent(i), variable, multiplier, offset));
  }
  set_ranges();
}

void RobotModel::set_ranges() {
  tighten_limits_for_mimic_joints();
  lower_.resize(variable_count());
  upper_.resize(variable_count());
  Eigen::VectorXd turns = Eigen::VectorXd::Zero(variable_count());
  for (int v = 0; v < variable_count(); ++v) {
    const bool endless = variable(v).is_continuous();
    lower_[v] = endless ? -std::numbers::pi : variable(v).limits.lower;
    upper_[v] = endless ? std::numbers::pi : variable(v).limits.upper;
    turns[v] = endless ? kTurn : 0.0;
  }
  turns_ = Periods(std::move(turns));
}

// After a turn of a continuous joint, its followers return to their place only if they turn by
// whole turns, too. Otherwise the joint has a distinct place for each turn, and so needs limits.
void RobotModel::tighten_limits_for_mimic_joints() {
  for (int i = 1; i < link_count(); ++i) {
    if (mimic_mapping(i).variable < 0 || !joint(i).mimic) {
      continue;
    }
    Joint& leader =
        description_.joints[static_cast<std::size_t>(variable_link(mimic_mapping(i).variable) - 1)];
    const bool comes_round = joint(i).type == JointType::kRevolute &&
                             mimic_mapping(i).multiplier == std::round(mimic_mapping(i).multiplier);
    if (leader.is_continuous() && !comes_round) {
      leader.limits.lower = -kTurn;
      leader.limits.upper = kTurn;
      description_.warnings.push_back(fmt::format(
          "joint {} is limited to one turn each way: {}, which follows it, is elsewhere after a "
          "turn",
          leader.name, joint(i).name));
    }
  }
}

std::vector<Configuration> RobotModel::unwrapped(std::vector<Configuration> waypoints,
                                                 const Configuration& start) const {
  const Configuration* before = &start;
  for (Configuration& q : waypoints) {
    q = nearest_equivalent(*before, q);
    before = &q;
  }
  return waypoints;
}

std::vector<Configuration> RobotModel::in_half_turns(
    const std::vector<Configuration>& waypoints) const {
  std::vector<Configuration> path;
  for (const Configuration& q : waypoints) {
    double half_turns = 1.0;
    for (int v = 0; v < variable_count() && !path.empty(); ++v) {
      const double turn = is_continuous(v) ? std::abs(q[v] - path.back()[v]) : 0.0;
      half_turns = std::max(half_turns, std::ceil(turn / std::numbers::pi - kLimitTolerance));
    }
    for (double i = 1.0; i < half_turns; ++i) {
      path.emplace_back(path.back() + (q - path.back()) / (half_turns - i + 1.0));
    }
    path.push_back(q);
  }
  return path;
}

Configuration RobotModel::clamped(Configuration q) const {
  for (int v = 0; v < variable_count(); ++v) {
    q[v] = is_continuous(v) ? q[v] : std::min(std::max(q[v], lower_[v]), upper_[v]);
  }
  return q;
}

std::optional<int> RobotModel::find_link(std::string_view name) const {
  const auto& links = description_.links;
  const auto found = std::ranges::find(links, name, &Link::name);
  return found == links.end() ? std::nullopt
                              : std::optional(static_cast<int>(found - links.begin()));
}

std::optional<int> RobotModel::find_variable(std::string_view joint_name) const {
  for (int v = 0; v < variable_count(); ++v) {
    if (variable(v).name == joint_name) {
      return v;
    }
  }
  return std::nullopt;
}

std::optional<JointIndices> RobotModel::find_group(std::string_view name) const {
  const auto group = std::ranges::find(description_.groups, name, &JointGroup::name);
  if (group == description_.groups.end()) {
    return std::nullopt;
  }
  JointIndices variables;
  for (const std::string& joint : group->joints) {
    if (const std::optional<int> variable = find_variable(joint)) {
      variables.push_back(*variable);
    }
  }
  std::ranges::sort(variables);
  return variables;
}

Configuration RobotModel::neutral() const {
  const Configuration middle = 0.5 * (lower_ + upper_);
  return (lower_.array() <= 0.0 && upper_.array() >= 0.0)
      .select(Configuration::Zero(variable_count()), middle);
}

bool RobotModel::moves_between(int variable, int link_a, int link_b) const {
  // A joint moves one link against the other if it is above exactly one of them.
  const auto is_above = [&](int moved, int link) {
    while (link > moved) {
      link = parent(link);
    }
    return link == moved;
  };
  for (int i = 1; i < link_count(); ++i) {
    if (mimic_mapping(i).variable == variable && is_above(i, link_a) != is_above(i, link_b)) {
      return true;
    }
  }
  return false;
}

double joint_value(const RobotModel& model, int link, const Configuration& q) {
  const auto part = [&](int of) {
    const RobotModel::MimicMapping& drive = model.mimic_mapping(of);
    return drive.multiplier * q[drive.variable] + drive.offset;
  };
  double value = part(link);
  const auto coupling = std::ranges::find(model.description().couplings, model.joint(link).name,
                                          &JointCoupling::joint);
  if (coupling != model.description().couplings.end()) {
    for (std::size_t i = 1; i < coupling->terms.size(); ++i) {
      link = model.parent(link);
      value += part(link);
    }
  }
  return value;
}

std::vector<JointValue> joint_values(const RobotModel& model, const Configuration& q) {
  std::vector<JointValue> values;
  for (int i = 1; i < model.link_count(); ++i) {
    if (model.mimic_mapping(i).variable >= 0) {
      values.push_back({model.joint(i).name, joint_value(model, i, q)});
    }
  }
  return values;
}

}  // namespace handway::geometric
