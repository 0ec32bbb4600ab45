#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "io/xml_document.h"

#include <urdf_model/model.h>

namespace handway::geometric {

/// All joints in the order of the file; chains of `mimic` are resolved to the
/// joint that moves on its own. Adds to the robot's warnings.
/// @throws InputError if `mimic` forms a ring.
void add_joints(const XmlDocument& document, const urdf::ModelInterface& model,
                RobotDescription& robot);

}  // namespace handway::geometric
