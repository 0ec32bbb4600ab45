#include "campaigns/parameter_values.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace handway::planning {
namespace {

using geometric::InputError;
using geometric::YamlElement;

constexpr double kMostSteps = 1000.0;

std::string accepted(const YamlElement& element, const Parameter& parameter,
                     const std::string& text) {
  try {
    set_from_text(parameter, text);
  } catch (const InputError& error) {
    element.refuse(error.problem().found, error.problem().expected);
  }
  return to_text(parameter);
}

bool is_logarithmic(const YamlElement& range) {
  const auto scale = range.find("scale");
  if (!scale) {
    return false;
  }
  if (scale->text() != "linear" && scale->text() != "log") {
    scale->refuse(scale->found(), "linear or log");
  }
  return scale->text() == "log";
}

std::vector<double> range_values(const YamlElement& range) {
  constexpr double kMost = 1e12;
  range.allow_keys({"from", "to", "steps", "scale"});
  const double from = bounded_number(range.need("from"), -kMost, kMost, false);
  const double to = bounded_number(range.need("to"), -kMost, kMost, false);
  const int steps = static_cast<int>(bounded_number(range.need("steps"), 2, kMostSteps, true));
  const bool logarithmic = is_logarithmic(range);
  if (logarithmic && (from <= 0.0 || to <= 0.0)) {
    range.refuse(fmt::format("a range from {:g} to {:g}", from, to),
                 "ends above 0 on a logarithmic scale");
  }
  std::vector<double> values;
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / (steps - 1);
    if (i == 0 || i == steps - 1) {  // the ends exactly
      values.push_back(i == 0 ? from : to);
    } else {
      values.push_back(logarithmic ? from * std::pow(to / from, t) : from + (to - from) * t);
    }
  }
  return values;
}

// Rounded to six digits: what a person would write.
std::string range_text(const Parameter& parameter, double value) {
  if (std::holds_alternative<int*>(parameter.value)) {
    return fmt::format("{:.0f}", std::round(value));
  }
  return fmt::format("{:.6g}", value);
}

}  // namespace

double bounded_number(const YamlElement& element, double lower, double upper, bool whole) {
  const std::string text = element.text();
  double value = std::numeric_limits<double>::quiet_NaN();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = error == std::errc() && end == text.data() + text.size() && value >= lower &&
                    value <= upper && (!whole || value == std::floor(value));
  if (!good) {
    element.refuse(element.found(), fmt::format("a {}number from {:.12g} to {:.12g}",
                                                whole ? "whole " : "", lower, upper));
  }
  return value;
}

std::vector<std::string> parameter_values(const YamlElement& element, const Parameter& parameter) {
  std::vector<std::string> values;
  if (element.is_list()) {
    for (const YamlElement& item : element.items()) {
      values.push_back(accepted(item, parameter, item.text()));
    }
    if (values.empty()) {
      element.refuse("an empty list", "at least one value");
    }
  } else if (element.is_map()) {
    for (const double value : range_values(element)) {
      values.push_back(accepted(element, parameter, range_text(parameter, value)));
    }
  } else {
    values.push_back(accepted(element, parameter, element.text()));
  }
  std::vector<std::string> once;
  for (const std::string& value : values) {
    if (std::ranges::count(once, value) == 0) {
      once.push_back(value);
    }
  }
  return once;
}

}  // namespace handway::planning
