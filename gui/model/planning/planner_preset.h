#pragma once

#include "handway/planning/core/planner.h"

#include <QString>

#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

/// A named set of a planner's parameters.
struct PlannerPreset {
  QString name;
  /// What it is for, one sentence; empty for a person's own.
  QString purpose;
  /// Keys and values that differ from the planner's own, in any order.
  std::vector<std::pair<std::string, std::string>> settings;
  bool is_built_in = false;
};

/// The presets that come with the program for a planner: first the planner's own values. Values of
/// the paper's planners are those of its Table 3; what the others change is worth its time on the
/// scenes that ship (docs/planning.md).
[[nodiscard]] std::vector<PlannerPreset> built_in_presets(const std::string& planner);

/// Gives `planner` the preset's values, and every other parameter that of `fresh`, a planner of the
/// same kind with its own values.
/// @throws InputError naming a key or value that the planner does not know; nothing is changed
/// then.
void apply_preset(const PlannerPreset& preset, planning::Planner& fresh,
                  planning::Planner& planner);

/// Has `planner` the values that apply_preset() would give it? False for one that can't be applied.
[[nodiscard]] bool has_values_of(const PlannerPreset& preset, planning::Planner& fresh,
                                 planning::Planner& planner);

}  // namespace handway::gui
