#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "io/xml_document.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// The `group` elements of an SRDF file, resolved to joint names of `robot`.
/// @throws InputError naming the line, for unknown names and groups in a ring.
[[nodiscard]] std::vector<JointGroup> srdf_groups(const XmlDocument& document,
                                                  const RobotDescription& robot);

/// Throws the InputError for a name that `robot` does not have.
/// @param kind "link", "joint", …
[[noreturn]] void refuse_unknown(const XmlDocument& document, const pugi::xml_node& node,
                                 const std::string& kind, const std::string& name,
                                 const std::vector<std::string>& known);

}  // namespace handway::geometric
