#include "keyword_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace py = pybind11;

namespace handway::python {
namespace {

/// A value as set_from_text() takes it.
std::string text_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) {
    return value.cast<bool>() ? "true" : "false";
  }
  return py::str(value).cast<std::string>();
}

}  // namespace

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
    set_from_text(*found, text_of(value));
  }
}

}  // namespace handway::python
