#pragma once

#include "handway/planning/export.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace handway::planning {

/// A choice among words, bound to an integer that holds the index.
struct ChoiceValue {
  int* index = nullptr;
  std::vector<std::string> options;
};

/// A planner's setting: what it is called and means, and where its value lives.
/// Command line, scene files, forms and docs are made from this one description.
struct Parameter {
  std::string key;    ///< In files and on the command line, for example "rho_a".
  std::string label;  ///< On screen.
  std::string unit;   ///< Empty: a bare number.
  std::string help;   ///< One or two sentences.
  std::variant<bool*, int*, double*, ChoiceValue> value;
  double lower = 0.0;  ///< Of numbers, inclusive.
  double upper = 0.0;  ///< Of numbers, inclusive.
  /// The value that follows the published algorithm as printed, where others depart from it.
  std::string as_printed = {};
};

/// Sets `parameter` from text ("0.01", "true", "joint").
/// @throws InputError naming the key, the text and what is allowed.
HANDWAY_PLANNING_EXPORT void set_from_text(const Parameter& parameter, std::string_view text);

/// The current value as text that set_from_text accepts.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_text(const Parameter& parameter);

/// Those whose value departs from the algorithm as printed.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<Parameter> departures(
    const std::vector<Parameter>& parameters);

/// The parameter called `key`; null if there is none.
[[nodiscard]] HANDWAY_PLANNING_EXPORT const Parameter* parameter_called(
    const std::vector<Parameter>& parameters, std::string_view key);

/// The same of one that is there.
/// @throws InputError naming the keys there are.
[[nodiscard]] HANDWAY_PLANNING_EXPORT const Parameter& find_parameter(
    const std::vector<Parameter>& parameters, std::string_view key);

}  // namespace handway::planning
