#pragma once

#include "app/options.h"
#include "handway/geometric/scene/scene.h"

namespace handway::gui {

class PlanPanel;

/// Sets the planner up as the scene wishes, then as the command line does.
/// @throws InputError if either names an unknown planner, key or value.
void apply_plan_options(const Options& options, const geometric::PlannerChoice& choice,
                        PlanPanel& panel);

}  // namespace handway::gui
