#include "handway/planning/core/plan_result.h"

#include <array>

namespace handway::planning {

const char* to_string(PlanStatus status) {
  static constexpr std::array<const char*, 6> kWords = {
      "solved", "start invalid", "goal invalid", "samples spent", "time limit", "cancelled"};
  return kWords[static_cast<std::size_t>(status)];
}

}  // namespace handway::planning
