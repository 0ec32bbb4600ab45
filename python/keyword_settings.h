#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/geometric/robot/robot_description.h"

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace handway::python {

/// Writes a value as the command line does: true, 3, 0.01, joint.
[[nodiscard]] std::string setting_text(const pybind11::handle& value);

/// Reads the arguments of a xacro file from a dict; none from None.
[[nodiscard]] geometric::XacroArguments xacro_arguments_from(const pybind11::object& arguments);

/// Sets described settings from keyword arguments, by their keys.
/// @throws TypeError for a keyword that is no setting, InputError for a value out of its range.
void set_from_keywords(const std::vector<geometric::BoundParameter>& parameters,
                       const pybind11::kwargs& keywords);

/// Describes the keyword arguments that set_from_keywords() accepts, for a docstring: each with its
/// range and its default.
[[nodiscard]] std::string keywords_text(const std::vector<geometric::BoundParameter>& parameters);

}  // namespace handway::python
