#include "handway/planning/core/carried_objects.h"

#include "handway/geometric/io/plural.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using geometric::RobotModel;

constexpr double kMotion = 1e-6;       // rad or m: less is rounding
constexpr std::size_t kMostNamed = 3;  // joints in a sentence

bool moves(const RobotModel& model, int variable, int link) {
  return std::ranges::binary_search(geometric::chain_variables(model, link), variable);
}

/// A hand's joints without those of a wrist, which move all the others; and the common first
/// link.
struct Grip {
  std::vector<int> joints;
  int palm = 0;
};

Grip grip_of(const RobotModel& model, std::vector<int> hand) {
  const auto is_wrist = [&](int v) {
    return std::ranges::all_of(hand, [&](int other) {
      return other == v || (moves(model, v, model.variable_link(other)) &&
                            !moves(model, other, model.variable_link(v)));
    });
  };
  while (hand.size() > 1) {
    const auto wrist = std::ranges::find_if(hand, is_wrist);
    if (wrist == hand.end()) {
      break;
    }
    hand.erase(wrist);
  }
  std::ranges::sort(hand);
  int palm = model.parent(model.variable_link(hand.front()));
  for (const int v : hand) {
    int other = model.parent(model.variable_link(v));
    while (palm != other) {  // parents come before their children
      int& later = palm > other ? palm : other;
      later = model.parent(later);
    }
  }
  return {std::move(hand), palm};
}

bool is_below(const RobotModel& model, int link, int ancestor) {
  while (link > ancestor) {
    link = model.parent(link);
  }
  return link == ancestor;
}

bool holds(const RobotModel& model, const Grip& grip, const geometric::Attachment& attachment) {
  const std::optional<int> carrier = model.find_link(attachment.link);
  return (carrier && is_below(model, *carrier, grip.palm)) ||
         std::ranges::any_of(attachment.touching, [&](const std::string& name) {
           const std::optional<int> link = model.find_link(name);
           return link &&
                  std::ranges::any_of(grip.joints, [&](int v) { return moves(model, v, *link); });
         });
}

std::vector<Grip> grips_of(const geometric::Scene& scene) {
  const RobotModel& model = *scene.robots.front().model;
  const geometric::JointSelection joints = geometric::JointSelection::of_groups(model);
  std::vector<Grip> grips;
  if (joints.hand.empty()) {
    return grips;
  }
  for (const geometric::Limb& limb : limbs(model, joints)) {
    if (!limb.hand.empty()) {
      grips.push_back(grip_of(model, limb.hand));
    }
  }
  if (grips.empty()) {  // a hand without an arm
    grips.push_back(grip_of(model, joints.hand));
  }
  return grips;
}

}  // namespace

std::vector<CarriedObject> carried_objects(const geometric::Scene& scene) {
  std::vector<CarriedObject> carried;
  const auto is_attached = [](const geometric::SceneObject& object) {
    return object.attachment.has_value();
  };
  if (scene.robots.empty() || std::ranges::none_of(scene.objects, is_attached)) {
    return carried;
  }
  const RobotModel& model = *scene.robots.front().model;
  const std::vector<Grip> grips = grips_of(scene);
  for (const geometric::SceneObject& object : scene.objects) {
    if (!geometric::is_carried_by(object, scene.robots.front())) {
      continue;
    }
    CarriedObject found{object.name, {}};
    for (const Grip& grip : grips) {
      if (holds(model, grip, *object.attachment)) {
        std::ranges::copy(grip.joints, std::back_inserter(found.holding));
      }
    }
    if (!found.holding.empty()) {
      std::ranges::sort(found.holding);
      carried.push_back(std::move(found));
    }
  }
  return carried;
}

std::vector<std::string> holding_warnings(const geometric::Scene& scene,
                                          std::span<const geometric::Configuration> waypoints) {
  std::vector<std::string> warnings;
  if (waypoints.empty()) {
    return warnings;
  }
  for (const CarriedObject& object : carried_objects(scene)) {
    std::vector<std::string> moved;
    for (const int v : object.holding) {
      const bool stays = std::ranges::all_of(waypoints, [&](const geometric::Configuration& q) {
        return v >= q.size() || std::abs(q[v] - waypoints.front()[v]) <= kMotion;
      });
      if (!stays) {
        moved.push_back(scene.robots.front().model->variable(v).name);
      }
    }
    if (moved.empty()) {
      continue;
    }
    const std::size_t more = moved.size() > kMostNamed ? moved.size() - kMostNamed : 0;
    moved.resize(moved.size() - more);
    warnings.push_back(fmt::format(
        "{}{} move{} while the hand holds {}, whose pose in the hand is assumed to be fixed. Give "
        "start and goal the same values of these joints, or detach the object.",
        fmt::join(moved, ", "), more == 0 ? "" : " and " + geometric::plural(more, "more joint"),
        moved.size() + more == 1 ? "s" : "", object.name));
  }
  return warnings;
}

}  // namespace handway::planning
