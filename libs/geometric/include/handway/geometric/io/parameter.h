#pragma once

#include "handway/geometric/export.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace handway::geometric {

/// A choice among words. `Index` is the index of the chosen one, or a pointer to it.
template <typename Index>
struct BasicChoice {
  Index index{};
  std::vector<std::string> options;
};
/// A setting that is one of several words.
using Choice = BasicChoice<int>;
/// A choice whose index is a member of the settings.
using BoundChoice = BasicChoice<int*>;

/// A setting of a planner or of any other work. Command line, scene files, forms, Python's
/// arguments and the manual's tables are made from this description.
template <typename Value>
struct BasicParameter {
  std::string key;    ///< In files and on the command line, for example "rho_a".
  std::string label;  ///< On screen.
  std::string unit;   ///< Empty: a bare number.
  std::string help;   ///< One or two sentences.
  Value value;
  double lower = 0.0;  ///< Least number, inclusive.
  double upper = 0.0;  ///< Largest number, inclusive.
  /// Value of the published algorithm as printed, if other values depart from it; else empty.
  std::string as_printed = {};
  /// Of a bound number: the member's unit is SI, and this many of them are one `unit`: 0.001 m are
  /// one mm.
  double scale = 1.0;
};

/// A setting with its value.
using Parameter = BasicParameter<std::variant<bool, int, double, Choice>>;
/// A setting with a pointer to the member that has its value.
using BoundParameter = BasicParameter<std::variant<bool*, int*, double*, BoundChoice>>;

/// The setting with the present value of its member.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Parameter value_of(const BoundParameter& parameter);
/// The settings with the present values of their members.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<Parameter> values_of(
    const std::vector<BoundParameter>& parameters);
/// The number in thousandths of the member's unit: mm of m, ms of s.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT BoundParameter in_thousandths(BoundParameter parameter);
/// Undoes in_thousandths(), for interfaces in SI units: "period_ms" in ms becomes "period" in s.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT BoundParameter in_si_units(BoundParameter parameter);
/// The settings in SI units.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<BoundParameter> in_si_units(
    std::vector<BoundParameter> parameters);

/// Returns the name of a setting's option on the command line: "--period-ms" for "period_ms".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string option_name(std::string_view key);

/// Sets the member to the value of `parameter`, which is of the same kind.
HANDWAY_GEOMETRIC_EXPORT void assign(const BoundParameter& member, const Parameter& parameter);

/// Sets the value from text ("0.01", "true", "joint"). The present value of a number is accepted
/// even out of its range: a time limit of "inf", which is none.
/// @throws InputError naming the key, the text and the allowed values; the value is unchanged.
HANDWAY_GEOMETRIC_EXPORT void set_from_text(Parameter& parameter, std::string_view text);

/// Sets the member from text. @throws InputError as above; the member is unchanged.
HANDWAY_GEOMETRIC_EXPORT void set_from_text(const BoundParameter& member, std::string_view text);

/// The value as text that set_from_text accepts.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string to_text(const Parameter& parameter);

/// Returns the parameters whose value departs from the algorithm as printed.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<Parameter> departures(
    const std::vector<Parameter>& parameters);

/// The parameter called `key`; null if it does not exist.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const Parameter* parameter_called(
    const std::vector<Parameter>& parameters, std::string_view key);

/// Returns the parameter called `key`. @pre it exists.
/// @throws InputError naming the valid keys.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const Parameter& find_parameter(
    const std::vector<Parameter>& parameters, std::string_view key);
/// Returns the parameter called `key`, to be changed. @throws InputError naming the valid keys.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Parameter& find_parameter(std::vector<Parameter>& parameters,
                                                                 std::string_view key);
/// Returns the setting called `key`. @throws InputError naming the valid keys.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT BoundParameter
find_parameter(const std::vector<BoundParameter>& parameters, std::string_view key);

}  // namespace handway::geometric
