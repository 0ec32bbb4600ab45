#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "io/xml_document.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// Lines of an SRDF file about links, joints or groups that are not there: those of another
/// variant of the robot, mostly. They are passed over, and reported in one warning.
class UnknownNames {
 public:
  void add(const XmlDocument& document, const pugi::xml_node& node, const std::string& kind,
           const std::string& name, const std::vector<std::string>& known);
  /// Whether `name` is known; adds it if it is not.
  bool check(const XmlDocument& document, const pugi::xml_node& node, const std::string& kind,
             const std::string& name, const std::vector<std::string>& known);

  /// "2 lines of the SRDF about …: FILE:LINE: link "x" ("y"?); …"; empty if there is none.
  [[nodiscard]] std::string summary() const;

 private:
  std::vector<std::string> lines_;
};

/// The groups of an SRDF document with all their joints, in the order of the file.
/// @throws InputError naming the line of a chain or ring that makes no group.
[[nodiscard]] std::vector<JointGroup> srdf_groups(const XmlDocument& document,
                                                  const RobotDescription& robot,
                                                  UnknownNames& unknown);

}  // namespace handway::geometric
