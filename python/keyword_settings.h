#pragma once

#include "handway/geometric/io/parameter.h"

#include <pybind11/pybind11.h>

#include <vector>

namespace handway::python {

/// Sets described settings from keyword arguments, by their keys.
/// @throws TypeError for a keyword that is no setting, InputError for a value out of its range.
void set_from_keywords(const std::vector<geometric::BoundParameter>& parameters,
                       const pybind11::kwargs& keywords);

}  // namespace handway::python
