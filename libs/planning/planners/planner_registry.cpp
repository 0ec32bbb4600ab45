#include "handway/planning/planners/planner_registry.h"

#include "handway/geometric/io/input_error.h"
#include "planners/built_in.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace handway::planning {

// The default one first.
PlannerRegistry::PlannerRegistry() {
  add(kAutoPlanner, make_auto_planner);
  add("pmd-prm", [] { return make_pmd_prm(HandSpace::kPrincipalDirections); });
  add("full-prm", [] { return make_pmd_prm(HandSpace::kAllJoints); });
  add("pmd-rrt-connect", [] { return make_rrt_connect(HandSpace::kPrincipalDirections); });
  add("pmd-lazy", make_pmd_lazy);
  add("rrt-connect", [] { return make_rrt_connect(HandSpace::kAllJoints); });
}

void PlannerRegistry::add(std::string name, PlannerFactory factory) {
  if (std::ranges::count(names(), name) > 0) {
    throw std::invalid_argument("there already is a planner called " + name);
  }
  factories_.emplace_back(std::move(name), std::move(factory));
}

std::unique_ptr<Planner> PlannerRegistry::create(std::string_view name) const {
  for (const auto& [known, factory] : factories_) {
    if (known == current_name(name)) {
      return factory();
    }
  }
  throw geometric::InputError({"planner", std::string(name), "no planner of this name",
                               fmt::format("one of {}", fmt::join(names(), ", ")), ""});
}

std::string_view PlannerRegistry::current_name(std::string_view name) {
  return name == "pmd-auto" ? kAutoPlanner : name;
}

std::vector<std::string> PlannerRegistry::names() const {
  std::vector<std::string> names;
  names.reserve(factories_.size());
  for (const auto& [name, factory] : factories_) {
    names.push_back(name);
  }
  return names;
}

}  // namespace handway::planning
