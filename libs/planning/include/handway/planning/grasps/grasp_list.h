#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace handway::planning {

/// Selects the grasps of an object that are listed.
struct GraspRequest {
  PregraspOptions search = {};
  /// File of grasps to list, all of them, instead of a search; empty: grasps are searched for.
  std::filesystem::path from = {};
  /// Grasps are simulated until so many hold; 0: none is simulated; nothing: as many as are listed.
  std::optional<int> holding = {};
  HoldConditions hold = {};  ///< Its friction and mass are not used: those of the search are.
};

/// Returns the conditions of the simulation, with the search's friction and mass.
[[nodiscard]] HANDWAY_PLANNING_EXPORT HoldConditions conditions_of(const GraspRequest& request);

/// Grasps of an object in the order in which to try them.
struct GraspList {
  std::vector<TestedGrasp> grasps = {};       ///< The best first, see rank_by_tests().
  std::string why_none = {};                  ///< See Pregrasps::why_none.
  std::vector<std::string> left_out = {};     ///< See MeasuredGrasps::left_out.
  int palm = -1;                              ///< See Pregrasps::palm.
  double search_time = 0.0;                   ///< s by the clock, without the simulation.
  std::shared_ptr<const HoldTest> test = {};  ///< The simulation; null if nothing is simulated.
};

/// Searches for grasps, or measures those of a file, simulates them and ranks them: first those
/// that hold. Twice as many further ones are searched for as shall hold, to take the place of those
/// that do not. Any number of threads gives the same grasps.
/// @param make_hold_test null: no grasp is simulated.
/// @param stop ends within 100 ms, with the grasps that are known until then.
/// @throws InputError as find_pregrasps() and read_given_grasps().
[[nodiscard]] HANDWAY_PLANNING_EXPORT GraspList list_grasps(const PlanningProblem& problem,
                                                            std::string_view object,
                                                            const GraspRequest& request,
                                                            MakeHoldTest make_hold_test,
                                                            const std::stop_token& stop = {});

}  // namespace handway::planning
