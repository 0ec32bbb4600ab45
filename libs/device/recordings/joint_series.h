#pragma once

#include "handway/geometric/formats/joint_table.h"
#include "recordings/array_file.h"

#include <string>
#include <vector>

namespace handway::device {

/// A robot's joints that are looked for in arrays.
struct WantedJoints {
  const geometric::JointLookup& lookup;
  int count = 0;      ///< Number of joints that `lookup` knows.
  std::string robot;  ///< Its name, for messages.
};

/// Returns the variables that have values of the joints: those with the most columns named as
/// joints; if there are none, those with one column for each joint. Of several, measured
/// states come before trajectories, and positions before velocities, efforts and actions.
[[nodiscard]] std::vector<RecordingVariable> joint_variables(const ArrayFile& arrays,
                                                             const WantedJoints& joints);

/// Values of the joints in one variable. Columns without names are in the order of the joints: a
/// warning says so.
/// @param variable its name; empty: the only one of joint_variables().
/// @throws InputError naming all variables with their sizes if none or several fit.
[[nodiscard]] geometric::JointTable read_joint_series(const ArrayFile& arrays,
                                                      const std::string& variable,
                                                      const WantedJoints& joints,
                                                      std::vector<std::string>& warnings);

/// The name of the only table of numbers in a file; of several, positions and measured states come
/// before others.
/// @throws InputError naming all variables with their sizes if none or several fit.
[[nodiscard]] std::string only_table(const ArrayFile& arrays);

}  // namespace handway::device
