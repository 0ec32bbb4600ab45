#include "handway/geometric/io/parameter.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>

namespace handway::geometric {
namespace {

[[noreturn]] void refuse(const Parameter& parameter, std::string_view text,
                         const std::string& expected) {
  throw InputError({"parameter", parameter.key, fmt::format("\"{}\"", text), expected, ""});
}

template <typename Number>
void set_number(const Parameter& parameter, std::string_view text, Number& value) {
  Number parsed{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  const bool in_range = static_cast<double>(parsed) >= parameter.lower &&
                        static_cast<double>(parsed) <= parameter.upper;
  const bool is_present = parsed == value;
  if (error != std::errc() || end != text.data() + text.size() || (!in_range && !is_present)) {
    refuse(parameter, text,
           fmt::format("{} from {:g} to {:g}",
                       std::is_integral_v<Number> ? "a whole number" : "a number", parameter.lower,
                       parameter.upper));
  }
  value = parsed;
}

void set_bool(const Parameter& parameter, std::string_view text, bool& value) {
  if (text != "true" && text != "false") {
    refuse(parameter, text, "true or false");
  }
  value = text == "true";
}

void set_choice(const Parameter& parameter, std::string_view text, Choice& choice) {
  const auto found = std::ranges::find(choice.options, text);
  if (found == choice.options.end()) {
    refuse(parameter, text, fmt::format("one of {}", fmt::join(choice.options, ", ")));
  }
  choice.index = static_cast<int>(found - choice.options.begin());
}

// A member's value in the unit of display, without digits that only the division adds.
double shown(double value, double scale) {
  constexpr double kDigits = 1e12;  // of a whole unit
  return scale == 1.0 ? value : std::round(value / scale * kDigits) / kDigits;
}

// The parameter called `key`. @throws InputError naming the valid keys.
template <typename Value>
const BasicParameter<Value>& parameter_in(const std::vector<BasicParameter<Value>>& parameters,
                                          std::string_view key) {
  const auto one = std::ranges::find(parameters, key, &BasicParameter<Value>::key);
  if (one == parameters.end()) {
    std::vector<std::string> keys;
    std::ranges::transform(parameters, std::back_inserter(keys), &BasicParameter<Value>::key);
    throw InputError({"parameter", std::string(key), "an unknown parameter",
                      fmt::format("one of {}", fmt::join(keys, ", ")), ""});
  }
  return *one;
}

}  // namespace

Parameter value_of(const BoundParameter& parameter) {
  Parameter result{parameter.key, parameter.label, parameter.unit,  parameter.help,
                   false,         parameter.lower, parameter.upper, parameter.as_printed};
  std::visit(
      [&](const auto& member) {
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, BoundChoice>) {
          result.value = Choice{*member.index, member.options};
        } else {
          result.value = *member;
        }
      },
      parameter.value);
  if (auto* number = std::get_if<double>(&result.value)) {
    *number = shown(*number, parameter.scale);
  }
  return result;
}

std::vector<Parameter> values_of(const std::vector<BoundParameter>& parameters) {
  std::vector<Parameter> values(parameters.size());
  std::ranges::transform(parameters, values.begin(), value_of);
  return values;
}

BoundParameter in_thousandths(BoundParameter parameter) {
  parameter.scale = 1e-3;
  return parameter;
}

BoundParameter in_si_units(BoundParameter parameter) {
  if (parameter.scale == 1.0) {
    return parameter;
  }
  const std::string suffix = "_" + parameter.unit;
  if (parameter.key.ends_with(suffix)) {
    parameter.key.erase(parameter.key.size() - suffix.size());
  }
  parameter.unit.erase(0, 1);  // the m of mm and of ms
  parameter.lower = shown(parameter.lower, 1.0 / parameter.scale);
  parameter.upper = shown(parameter.upper, 1.0 / parameter.scale);
  parameter.scale = 1.0;
  return parameter;
}

std::vector<BoundParameter> in_si_units(std::vector<BoundParameter> parameters) {
  for (BoundParameter& parameter : parameters) {
    parameter = in_si_units(std::move(parameter));
  }
  return parameters;
}

std::string option_name(std::string_view key) {
  std::string name = "--" + std::string(key);
  std::ranges::replace(name, '_', '-');
  return name;
}

void assign(const BoundParameter& member, const Parameter& parameter) {
  std::visit(
      [&](const auto& target) {
        using Target = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<Target, BoundChoice>) {
          *target.index = std::get<Choice>(parameter.value).index;
        } else {
          *target = std::get<std::remove_pointer_t<Target>>(parameter.value);
        }
      },
      member.value);
  if (auto* const* number = std::get_if<double*>(&member.value)) {
    **number *= member.scale;
  }
}

void set_from_text(const BoundParameter& member, std::string_view text) {
  Parameter parameter = value_of(member);
  set_from_text(parameter, text);
  assign(member, parameter);
}

void set_from_text(Parameter& parameter, std::string_view text) {
  std::visit(
      [&](auto& value) {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, bool>) {
          set_bool(parameter, text, value);
        } else if constexpr (std::is_same_v<Value, Choice>) {
          set_choice(parameter, text, value);
        } else {
          set_number(parameter, text, value);
        }
      },
      parameter.value);
}

std::string to_text(const Parameter& parameter) {
  return std::visit(
      [](const auto& value) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Choice>) {
          return value.options[static_cast<std::size_t>(value.index)];
        } else {
          return fmt::format("{}", value);
        }
      },
      parameter.value);
}

std::vector<Parameter> departures(const std::vector<Parameter>& parameters) {
  std::vector<Parameter> departing;
  std::ranges::copy_if(parameters, std::back_inserter(departing), [](const Parameter& parameter) {
    return !parameter.as_printed.empty() && to_text(parameter) != parameter.as_printed;
  });
  return departing;
}

const Parameter* parameter_called(const std::vector<Parameter>& parameters, std::string_view key) {
  const auto found = std::ranges::find(parameters, key, &Parameter::key);
  return found == parameters.end() ? nullptr : &*found;
}

const Parameter& find_parameter(const std::vector<Parameter>& parameters, std::string_view key) {
  return parameter_in(parameters, key);
}

Parameter& find_parameter(std::vector<Parameter>& parameters, std::string_view key) {
  const Parameter& one = parameter_in(parameters, key);
  return parameters[static_cast<std::size_t>(&one - parameters.data())];
}

BoundParameter find_parameter(const std::vector<BoundParameter>& parameters, std::string_view key) {
  return parameter_in(parameters, key);
}

}  // namespace handway::geometric
