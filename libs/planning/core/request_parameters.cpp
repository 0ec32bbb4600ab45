#include "handway/planning/core/request_parameters.h"

namespace handway::planning {

std::vector<geometric::BoundParameter> parameters_of(PlanRequest& request) {
  constexpr double kDay = 86400.0;  // s
  return {
      {"threads", "Threads", "", "Number of threads; the path does not depend on it",
       &request.threads, 1, 1024},
      {"time_limit", "Time limit", "s", "Time before planning gives up", &request.time_limit_s,
       1e-6, kDay},
      geometric::in_thousandths(
          {"margin", "Margin", "mm",
           "Clearance from all other bodies along the path; less near a start or goal with less "
           "clearance",
           &request.margin, 0.0, 1000.0}),
      {"optimize", "Optimise", "s", "Time to optimise the path after it was found",
       &request.optimize_s, 0.0, kDay}};
}

}  // namespace handway::planning
