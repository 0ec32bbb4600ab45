#pragma once

#include "handway/device/glove/recording.h"
#include "recordings/array_file.h"

#include <string>
#include <vector>

namespace handway::device {

/// Returns the variables that may be recordings of a glove or of a hand's landmarks: several rows
/// of 18, 22 or 23 columns, of columns of which half are named as sensors, or of 21 landmarks; if
/// there are none, those with postures of MANO.
[[nodiscard]] std::vector<RecordingVariable> recordable_variables(const ArrayFile& arrays);

/// Makes a recording of one variable of a file, as tables of text are read.
/// @param variable its name; empty: the only one of recordable_variables().
/// @throws InputError naming all variables with their sizes if none or several fit.
[[nodiscard]] Recording read_array_recording(const ArrayFile& arrays, const std::string& variable);

/// Returns whether half of the names of columns are those of sensors, at least.
[[nodiscard]] bool are_sensors(const std::vector<std::string>& names);

/// Advice to choose a variable, with an example.
[[nodiscard]] std::string choose_advice(const std::string& variable);

}  // namespace handway::device
