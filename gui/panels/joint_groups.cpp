#include "panels/joint_groups.h"

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
  if (!groups.hand.empty()) {
    // The fingers' closest common ancestor.
    const auto ancestors = [&model](int link) {
      std::vector<int> chain;
      for (link = model.parent(link); link >= 0; link = model.parent(link)) {
        chain.push_back(link);
      }
      return chain;
    };
    std::vector<int> common = ancestors(model.variable_link(groups.hand.front()));
    for (const int variable : groups.hand) {
      const std::vector<int> chain = ancestors(model.variable_link(variable));
      std::erase_if(common, [&](int link) { return !contains(chain, link); });
    }
    if (!common.empty()) {
      return common.front();
    }
  }
  return groups.arm.empty() ? model.link_count() - 1 : model.variable_link(groups.arm.back());
}

}  // namespace handway::gui
