#include "model/document/joint_groups.h"

#include "handway/planning/queries/palm_ik.h"

#include <algorithm>
#include <optional>
#include <string>

namespace handway::gui {
namespace {

bool contains(const std::vector<int>& variables, int variable) {
  return std::ranges::find(variables, variable) != variables.end();
}

}  // namespace

JointGroups joint_groups(const geometric::RobotModel& model, const sampling::PmdBasis* basis) {
  JointGroups groups;
  if (basis) {
    for (const std::string& joint : basis->joints) {
      if (const std::optional<int> variable = model.find_variable(joint)) {
        groups.hand.push_back(*variable);
      }
    }
  } else {
    groups.hand = model.find_group("hand").value_or(std::vector<int>{});
  }
  const std::optional<std::vector<int>> arm = model.find_group("arm");
  for (int v = 0; v < model.variable_count(); ++v) {
    if (contains(groups.hand, v)) {
      continue;
    }
    (arm && !contains(*arm, v) ? groups.other : groups.arm).push_back(v);
  }
  return groups;
}

int palm_link(const geometric::RobotModel& model, const JointGroups& groups) {
  return planning::palm_link(model, groups.arm, groups.hand);
}

std::vector<std::vector<int>> moving_parts(const geometric::RobotModel& model,
                                           const JointGroups& groups) {
  std::vector<std::vector<int>> parts;
  if (!groups.arm.empty()) {
    parts.push_back(groups.arm);
  }
  const auto carries = [&model](int variable, int other) {
    int link = model.variable_link(other);
    while (link >= 0 && link != model.variable_link(variable)) {
      link = model.parent(link);
    }
    return link >= 0;
  };
  std::vector<std::vector<int>> fingers;
  for (const int variable : groups.hand) {
    const auto finger = std::ranges::find_if(fingers, [&](const std::vector<int>& part) {
      return std::ranges::any_of(
          part, [&](int other) { return carries(variable, other) || carries(other, variable); });
    });
    if (finger == fingers.end()) {
      fingers.push_back({variable});
    } else {
      finger->push_back(variable);
    }
  }
  parts.insert(parts.end(), fingers.begin(), fingers.end());
  return parts;
}

}  // namespace handway::gui
