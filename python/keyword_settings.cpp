#include "keyword_settings.h"

#include "handway/geometric/formats/xacro_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <variant>

namespace py = pybind11;

namespace handway::python {
namespace {

/// The values that a setting may have.
std::string range_of(const geometric::Parameter& parameter) {
  if (std::holds_alternative<bool>(parameter.value)) {
    return "True or False";
  }
  if (const auto* choice = std::get_if<geometric::Choice>(&parameter.value)) {
    return fmt::format("{}", fmt::join(choice->options, ", "));
  }
  return fmt::format("{:g} to {:g}{}{}", parameter.lower, parameter.upper,
                     parameter.unit.empty() ? "" : " ", parameter.unit);
}

/// The default as Python writes it.
std::string default_of(const geometric::Parameter& parameter) {
  const bool* on = std::get_if<bool>(&parameter.value);
  return on == nullptr ? to_text(parameter) : *on ? "True" : "False";
}

/// Breaks a paragraph into the lines of a docstring.
std::string broken(const std::string& paragraph) {
  constexpr std::size_t kWidth = 88;
  std::istringstream words(paragraph);
  std::string text;
  std::size_t length = 0;
  for (std::string word; words >> word;) {
    const bool fits = length == 0 || length + 1 + word.size() <= kWidth;
    text += length == 0 ? "" : fits ? " " : "\n";
    length = length == 0 || !fits ? word.size() : length + 1 + word.size();
    text += word;
  }
  return text + "\n";
}

}  // namespace

std::string setting_text(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) {
    return value.cast<bool>() ? "true" : "false";
  }
  return py::str(value).cast<std::string>();
}

geometric::XacroArguments xacro_arguments_from(const py::object& arguments) {
  geometric::XacroArguments result;
  if (!arguments.is_none()) {
    for (const auto& [name, value] : py::cast<py::dict>(arguments)) {
      result.insert(geometric::xacro_argument_of(
          py::str(name).cast<std::string>() + ":=" + setting_text(value), "xacro"));
    }
  }
  return result;
}

std::string keywords_text(const std::vector<geometric::BoundParameter>& parameters) {
  std::string text;
  for (const geometric::Parameter& parameter : geometric::values_of(parameters)) {
    text += broken(fmt::format("{}: {} ({}; default {}).", parameter.key, parameter.help,
                               range_of(parameter), default_of(parameter)));
  }
  return text;
}

void set_from_keywords(const std::vector<geometric::BoundParameter>& parameters,
                       const py::kwargs& keywords) {
  for (const auto& [keyword, value] : keywords) {
    const auto key = keyword.cast<std::string>();
    const auto found = std::ranges::find(parameters, key, &geometric::BoundParameter::key);
    if (found == parameters.end()) {
      std::vector<std::string> keys;
      std::ranges::transform(parameters, std::back_inserter(keys), &geometric::BoundParameter::key);
      throw py::type_error(fmt::format("\"{}\" is no keyword argument; settings are {}", key,
                                       fmt::join(keys, ", ")));
    }
    set_from_text(*found, setting_text(value));
  }
}

}  // namespace handway::python
