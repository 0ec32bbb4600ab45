#include "handway/planning/core/request_parameters.h"

#include <fmt/format.h>

namespace handway::planning {

geometric::BoundParameter threads_parameter(int& threads, std::string_view result) {
  return {
      "threads", "Threads", "",  fmt::format("Number of threads; {} does not depend on it", result),
      &threads,  1,         1024};
}

std::vector<geometric::BoundParameter> parameters_of(PlanRequest& request) {
  constexpr double kDay = 86400.0;  // s
  return {
      threads_parameter(request.threads, "the path"),
      {"time_limit", "Time limit", "s", "Time before planning gives up", &request.time_limit_s,
       1e-6, kDay},
      geometric::in_thousandths(
          {"margin", "Margin", "mm",
           "Clearance from all other bodies along the path; less near a start or goal with less "
           "clearance",
           &request.margin, 0.0, 1000.0}),
      geometric::in_thousandths({"resolution_mm", "Resolution", "mm",
                                 "Clearance below which a motion is rejected", &request.resolution,
                                 1e-4, 1000.0}),
      {"optimize", "Optimise", "s", "Time to optimise the path after it was found",
       &request.optimize_s, 0.0, kDay}};
}

const std::vector<geometric::Parameter>& request_parameters() {
  static const std::vector<geometric::Parameter> kAll = [] {
    PlanRequest request;
    return geometric::values_of(parameters_of(request));
  }();
  return kAll;
}

}  // namespace handway::planning
