#include "handway/planning/grasps/grasp_list.h"

#include "handway/planning/grasps/given_grasps.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

namespace handway::planning {
namespace {

Pregrasps measured_from_file(const PlanningProblem& problem, std::string_view object,
                             const GraspRequest& request, const std::stop_token& stop,
                             std::vector<std::string>& left_out) {
  MeasuredGrasps measured =
      measure_grasps_of_file(request.from, problem, object, request.search, stop);
  std::ranges::stable_sort(measured.grasps.found, std::greater(), &Pregrasp::score);
  if (measured.grasps.found.empty()) {
    measured.grasps.why_none =
        fmt::format("None of the {} given is possible.", measured.left_out.size());
  }
  left_out = std::move(measured.left_out);
  return std::move(measured.grasps);
}

}  // namespace

HoldConditions conditions_of(const GraspRequest& request) {
  HoldConditions conditions = request.hold;
  conditions.contact = request.search.contact;
  conditions.mass = request.search.payload;
  return conditions;
}

GraspList list_grasps(const PlanningProblem& problem, std::string_view object,
                      const GraspRequest& request, MakeHoldTest make_hold_test,
                      const std::stop_token& stop) {
  const bool is_search = request.from.empty();
  const bool can_test = make_hold_test != nullptr;
  const auto most = static_cast<std::size_t>(request.search.most);
  GraspList list;
  PregraspOptions search = request.search;
  search.spares = can_test ? 2 * std::min(request.holding.value_or(search.most), search.most) : 0;
  const auto begin = std::chrono::steady_clock::now();
  Pregrasps found = is_search ? find_pregrasps(problem, object, search, stop)
                              : measured_from_file(problem, object, request, stop, list.left_out);
  list.search_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  list.why_none = found.why_none;
  list.palm = found.palm;
  const std::size_t listed = is_search ? most : found.found.size();
  const std::size_t holding =
      can_test ? request.holding ? static_cast<std::size_t>(*request.holding) : listed : 0;
  if (holding > 0 && !found.found.empty()) {
    list.test = make_hold_test(problem, object, found.palm);
    list.grasps = rank_by_tests(*list.test, std::move(found.found), holding, conditions_of(request),
                                search.threads, stop);
  } else {
    std::ranges::transform(found.found, std::back_inserter(list.grasps),
                           [](const Pregrasp& grasp) { return TestedGrasp{grasp}; });
  }
  list.grasps.resize(std::min(list.grasps.size(), listed));
  return list;
}

}  // namespace handway::planning
