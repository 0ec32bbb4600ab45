#include "handway/planning/core/limbs.h"

#include "handway/geometric/robot/inverse_kinematics.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace handway::planning {

std::vector<Limb> limbs(const geometric::RobotModel& model, const std::vector<int>& arm,
                        const std::vector<int>& hand) {
  const auto moves = [&](int variable, int other) {
    const std::vector<int> chain = geometric::chain_variables(model, model.variable_link(other));
    return std::ranges::binary_search(chain, variable);
  };
  std::vector<int> ends = arm;
  std::erase_if(ends, [&](int v) {
    return std::ranges::any_of(arm, [&](int other) { return other != v && moves(v, other); });
  });
  std::ranges::sort(ends);
  std::vector<Limb> found;
  for (const int end : ends) {
    Limb limb;
    std::ranges::copy_if(arm, std::back_inserter(limb.arm), [&](int v) {
      return moves(v, end) &&
             std::ranges::count_if(ends, [&](int other) { return moves(v, other); }) == 1;
    });
    std::ranges::sort(limb.arm);
    std::ranges::copy_if(hand, std::back_inserter(limb.hand), [&](int h) {
      return std::ranges::any_of(limb.arm, [&](int v) { return moves(v, h); });
    });
    found.push_back(std::move(limb));
  }
  return found;
}

}  // namespace handway::planning
