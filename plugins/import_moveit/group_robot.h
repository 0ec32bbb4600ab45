#pragma once

#include "handway/geometric/io/yaml_element.h"
#include "handway/geometric/robot/robot_model.h"

#include <map>
#include <memory>
#include <set>
#include <string>

namespace handway::import_moveit {

/// The joints' values that `values` gives, in the order of the configuration; the others as in
/// `rest`. Fixed and coupled joints are passed over.
/// @param[in,out] unknown gets the joints that the robot has not, each once.
[[nodiscard]] geometric::Configuration with_values(const geometric::RobotModel& model,
                                                   const std::map<std::string, double>& values,
                                                   const geometric::Configuration& rest,
                                                   std::set<std::string>& unknown);

/// The robot of which only the joints of a planning group move: the others are fixed where
/// `start` has them. Of its groups "hand" is kept.
/// @throws InputError if the robot has no such group, or none of its joints moves.
[[nodiscard]] std::shared_ptr<const geometric::RobotModel> group_robot(
    const geometric::RobotModel& model, const geometric::YamlElement& group,
    const geometric::Configuration& start);

}  // namespace handway::import_moveit
