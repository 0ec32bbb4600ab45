#pragma once

#include "handway/planning/export.h"
#include "handway/planning/planners/planner.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace handway::planning {

using PlannerFactory = std::function<std::unique_ptr<Planner>()>;

/// The planners that a program knows, by name. Built-in ones are there from the
/// start; plugins add theirs.
class HANDWAY_PLANNING_EXPORT PlannerRegistry {
 public:
  PlannerRegistry();

  /// @throws std::invalid_argument if the name is taken.
  void add(std::string name, PlannerFactory factory);

  /// @param name or another name that a planner had before.
  /// @throws InputError naming the planners there are.
  [[nodiscard]] std::unique_ptr<Planner> create(std::string_view name) const;

  /// `name`, or of a name that a planner had before the one it has now.
  [[nodiscard]] static std::string_view current_name(std::string_view name);

  /// In order of registration; the first is the default.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::vector<std::pair<std::string, PlannerFactory>> factories_;
};

}  // namespace handway::planning
