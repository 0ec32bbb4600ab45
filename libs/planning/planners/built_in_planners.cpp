#include "planners/built_in_planners.h"

#include "handway/planning/planners/auto_planner.h"
#include "handway/planning/planners/pmd_lazy.h"
#include "handway/planning/planners/pmd_prm.h"
#include "handway/planning/planners/rrt_connect.h"

#include <memory>

namespace handway::planning {

void register_built_in_planners(PlannerRegistry& registry) {
  registry.add("auto", [] { return std::make_unique<AutoPlanner>(); });
  registry.add("pmd-prm", [] { return std::make_unique<PmdPrm>(HandSpace::kPrincipalDirections); });
  registry.add("full-prm", [] { return std::make_unique<PmdPrm>(HandSpace::kAllJoints); });
  registry.add("pmd-rrt-connect",
               [] { return std::make_unique<RrtConnect>(HandSpace::kPrincipalDirections); });
  registry.add("pmd-lazy", [] { return std::make_unique<PmdLazy>(); });
  registry.add("rrt-connect", [] { return std::make_unique<RrtConnect>(HandSpace::kAllJoints); });
}

}  // namespace handway::planning
