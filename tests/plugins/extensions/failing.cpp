#include "handway/planning/extensions/plugin.h"

#include <stdexcept>

HANDWAY_PLUGIN({.name = "failing",
                .register_planners = [](handway::planning::PlannerRegistry& registry) {
                  registry.add("half-done", [] { return nullptr; });
                  throw std::runtime_error("no licence for half-done");
                }});
