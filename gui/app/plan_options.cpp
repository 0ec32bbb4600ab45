#include "app/plan_options.h"

#include "features/planning/plan_panel.h"

namespace handway::gui {

void apply_plan_options(const Options& options, const geometric::PlannerChoice& choice,
                        PlanPanel& panel) {
  panel.apply(choice);
  if (!options.planner.empty()) {
    panel.choose_planner(options.planner);
  }
  if (options.seed) {
    panel.set_seed(*options.seed);
    panel.set_seeds(1);
  }
  for (const auto& [key, value] : options.settings) {
    panel.set_parameter(key, value);
  }
}

}  // namespace handway::gui
