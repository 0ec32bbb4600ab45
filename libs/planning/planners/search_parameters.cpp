#include "handway/planning/planners/search_parameters.h"

namespace handway::planning {

Parameter max_samples_parameter(int& value) {
  return {"max_samples", "Samples", "",       "Samples drawn before the planner gives up.",
          &value,        1,         100000000};
}

Parameter smoothing_checks_parameter(int& value) {
  return {
      "smoothing_checks",
      "Checks to smooth",
      "",
      "Configurations checked to shorten the path once it is found, for every 16 waypoints that "
      "it then has. 0: it stays as it is.",
      &value,
      0,
      10000000};
}

Parameter corridor_parameter(int& value) {
  return {"corridor", "Corridor", "",
          "Around the straight motion of the arm's joints, or of its tool.",
          ChoiceValue{&value, {"joint", "cartesian"}}};
}

void append_region_parameters(std::vector<Parameter>& list, TargetRegion& region) {
  list.push_back({"near_ends", "Samples near the ends", "",
                  "Share of samples drawn around start and goal.", &region.near_ends, 0.0, 1.0});
  list.push_back({"rho_a", "Corridor half-width ρₐ", "",
                  "Half-width of the arm's corridor at the start, normalised.", &region.rho_a, 1e-5,
                  1.0});
  list.push_back({"rho_max", "Largest ρₐ", "", "The corridor does not grow beyond this.",
                  &region.rho_max, 1e-5, 1.0});
  list.push_back({"rho_growth", "Widening factor", "", "The corridor grows by this factor.",
                  &region.rho_growth, 1.0, 100.0});
  list.push_back({"samples_per_width", "Samples per width", "",
                  "Samples drawn before the corridor grows.", &region.samples_per_width, 1,
                  1000000});
}

}  // namespace handway::planning
