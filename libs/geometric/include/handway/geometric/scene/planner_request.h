#pragma once

#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {

/// Which planner a scene asks for, as its file says it; the planning layer gives the words a
/// meaning.
struct PlannerRequest {
  std::string name;                                           ///< Empty: the default planner.
  std::vector<std::pair<std::string, std::string>> settings;  ///< Key and value as written.
};

}  // namespace handway::geometric
