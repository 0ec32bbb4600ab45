#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

/// Place in the file where a coupling is written.
struct Place {
  const std::string& source;
  const std::string& element;

  [[noreturn]] void refuse(const std::string& found, const std::string& expected,
                           const std::string& advice = "") const {
    throw InputError({source, element, found, expected, advice});
  }
};

Joint& moving_joint(RobotDescription& robot, const std::string& name, const Place& place) {
  const auto joint = std::ranges::find(robot.joints, name, &Joint::name);
  if (joint == robot.joints.end() || joint->type == JointType::kFixed) {
    std::vector<std::string> names;
    for (const Joint& other : robot.joints) {
      if (other.type != JointType::kFixed) {
        names.push_back(other.name);
      }
    }
    place.refuse(fmt::format("the joint \"{}\", which {}", name,
                             joint == robot.joints.end() ? "the robot has not" : "is fixed"),
                 "a joint that moves", advise_name(name, names));
  }
  return *joint;
}

double neutral_value(const JointLimits& limits) {
  if (std::isinf(limits.lower)) {
    return 0.0;
  }
  return limits.lower <= 0.0 && limits.upper >= 0.0 ? 0.0 : 0.5 * (limits.lower + limits.upper);
}

// Largest change of the sum by the terms from their neutral values: down and up.
std::pair<double, double> most_added(const RobotDescription& robot, const JointCoupling& coupling) {
  std::pair<double, double> most(0.0, 0.0);
  for (const auto& [name, multiplier] : coupling.terms) {
    const JointLimits& limits = std::ranges::find(robot.joints, name, &Joint::name)->limits;
    const double neutral = neutral_value(limits);
    const double a = multiplier * (limits.lower - neutral);
    const double b = multiplier * (limits.upper - neutral);
    most.first += std::min(a, b);
    most.second += std::max(a, b);
  }
  return most;
}

// Narrows the leading joints so that the sum keeps the limits of the joint.
void narrow_leaders(RobotDescription& robot, const JointCoupling& coupling,
                    const JointLimits& limits, const Place& place) {
  double neutral = coupling.offset;
  for (const auto& [name, multiplier] : coupling.terms) {
    neutral +=
        multiplier * neutral_value(std::ranges::find(robot.joints, name, &Joint::name)->limits);
  }
  if (neutral < limits.lower || neutral > limits.upper) {
    place.refuse(fmt::format("the value {:g} of {} where the joints that it follows are neutral",
                             neutral, coupling.joint),
                 fmt::format("a value within its limits, {:g} to {:g}", limits.lower, limits.upper),
                 "Correct the offset or the limits");
  }
  const auto [down, up] = most_added(robot, coupling);
  const double share_down = down < 0.0 ? std::min(1.0, (limits.lower - neutral) / down) : 1.0;
  const double share_up = up > 0.0 ? std::min(1.0, (limits.upper - neutral) / up) : 1.0;
  if (share_down == 1.0 && share_up == 1.0) {
    return;
  }
  std::string names;
  for (const auto& [name, multiplier] : coupling.terms) {
    JointLimits& narrowed = std::ranges::find(robot.joints, name, &Joint::name)->limits;
    const double middle = neutral_value(narrowed);
    const double below = multiplier > 0.0 ? share_down : share_up;
    const double above = multiplier > 0.0 ? share_up : share_down;
    narrowed.lower = middle + below * (narrowed.lower - middle);
    narrowed.upper = middle + above * (narrowed.upper - middle);
    names += (names.empty() ? "" : ", ") + name;
  }
  robot.warnings.push_back(
      fmt::format("joints {} are limited to {:.0f} % of their ranges below and {:.0f} % above: "
                  "beyond, {}, which "
                  "follows them, would leave its own limits",
                  names, 100.0 * share_down, 100.0 * share_up, coupling.joint));
}

void check(RobotDescription& robot, const JointCoupling& coupling, const Place& place) {
  const Joint& joint = moving_joint(robot, coupling.joint, place);
  if (coupling.terms.empty()) {
    place.refuse("no joint to follow", "at least one");
  }
  if (joint.mimic) {
    place.refuse(
        "the joint \"" + joint.name + "\", which follows " + joint.mimic->joint + " already",
        "one coupling of a joint");
  }
  for (const auto& [name, multiplier] : coupling.terms) {
    const Joint& leader = moving_joint(robot, name, place);
    if (leader.name == joint.name || leader.mimic) {
      place.refuse("the joint \"" + name + "\", which follows others itself",
                   "joints that move on their own",
                   "Name those that it follows, with the product of the multipliers");
    }
    if (leader.is_continuous() && !joint.is_continuous()) {
      place.refuse("the continuous joint \"" + name + "\"", "joints with limits",
                   "A joint with limits can't follow one without");
    }
    const bool is_finite = std::isfinite(multiplier) && std::isfinite(coupling.offset);
    if (!is_finite || multiplier == 0.0) {
      place.refuse(fmt::format("the multiplier {:g}", multiplier), "a number other than 0");
    }
  }
  for (const Joint& other : robot.joints) {
    if (other.mimic && other.mimic->joint == joint.name) {
      place.refuse("the joint \"" + joint.name + "\", which " + other.name + " follows",
                   "a joint that none follows", "Couple " + other.name + " as well");
    }
  }
}

}  // namespace

void couple_joint(RobotDescription& robot, const JointCoupling& coupling, const std::string& source,
                  const std::string& element) {
  const Place place{source, element};
  check(robot, coupling, place);
  const auto at = std::ranges::find(robot.joints, coupling.joint, &Joint::name);
  const Joint whole = *at;
  if (!whole.is_continuous()) {
    narrow_leaders(robot, coupling, whole.limits, place);
  }
  std::vector<Joint> chain;
  for (std::size_t i = 0; i < coupling.terms.size(); ++i) {
    const auto& [leader, multiplier] = coupling.terms[i];
    Joint& part = chain.emplace_back(whole);
    part.mimic = Mimic{leader, multiplier, i == 0 ? coupling.offset : 0.0};
    if (!whole.is_continuous()) {
      const JointLimits& range = moving_joint(robot, leader, place).limits;
      std::tie(part.limits.lower, part.limits.upper) =
          std::minmax({multiplier * range.lower + part.mimic->offset,
                       multiplier * range.upper + part.mimic->offset});
    }
    if (i > 0) {
      part.parent = chain[i - 1].child;
      part.X_PJ = Pose::Identity();
    }
    if (i + 1 < coupling.terms.size()) {
      part.name = part.child = fmt::format("{}/{}", whole.name, i + 1);
      robot.links.push_back({part.child, {}, {}});
    }
  }
  const auto rest = robot.joints.erase(at);
  robot.joints.insert(rest, std::make_move_iterator(chain.begin()),
                      std::make_move_iterator(chain.end()));
  robot.couplings.push_back(coupling);
}

}  // namespace handway::geometric
