#pragma once

#include "handway/planning/campaigns/run_workers.h"

#include <span>
#include <string>
#include <vector>

namespace handway::tools {

/// Problems of a folder that a campaign leaves out for the same reason.
struct LeftOut {
  std::string problems;  ///< Name of the first, and the number of others.
  std::string reason;    ///< Reason of the first.
};

/// Groups problems by their folder and by what is wrong with them, in the order of the first ones.
[[nodiscard]] std::vector<LeftOut> grouped(std::span<const planning::LeftOutProblem> problems);

}  // namespace handway::tools
