#pragma once

#include "formats/urdf_elements.h"
#include "handway/geometric/robot/robot_description.h"

#include <set>
#include <string>
#include <vector>

namespace handway::geometric {

/// Returns the links of a URDF file that no joint connects, if joints form a robot of the others.
/// @throws InputError naming the line if names of links or joints repeat, or if the file has no
/// link, several roots or none, or more links than a robot may have.
[[nodiscard]] std::set<std::string> links_on_their_own(const UrdfElements& elements);

/// Reads the joints of a URDF file.
class UrdfJoints {
 public:
  /// @param elements must outlive this object.
  explicit UrdfJoints(UrdfElements& elements);

  /// Adds all joints in the order of the file to `robot`, which has the links. Chains of `mimic`
  /// are resolved to the independent joint. Limits of a <safety_controller> narrow those of its
  /// joint. Adds to the robot's warnings.
  /// @throws InputError naming the line if a joint can't be read, or if `mimic` forms a ring.
  void read_all(RobotDescription& robot);

  /// Returns the joints that turn without end, as their limits are beyond all sense.
  [[nodiscard]] const std::vector<std::string>& endless() const { return endless_; }
  /// Returns such joints that slide.
  [[nodiscard]] const std::vector<std::string>& endless_slides() const { return endless_slides_; }

 private:
  void read(const pugi::xml_node& joint, RobotDescription& robot);
  [[nodiscard]] std::string read_end(const pugi::xml_node& joint, const std::string& element,
                                     const char* end) const;
  [[nodiscard]] Eigen::Vector3d read_axis(const pugi::xml_node& joint, const std::string& element,
                                          const Eigen::Vector3d& otherwise) const;
  [[nodiscard]] JointLimits read_limits(const pugi::xml_node& joint, const std::string& element,
                                        const std::string& type);
  [[nodiscard]] std::optional<Mimic> read_mimic(const pugi::xml_node& joint,
                                                const std::string& element) const;

  UrdfElements& elements_;
  std::vector<std::string> joint_names_;
  std::vector<std::string> link_names_;
  std::set<std::string> carried_;  ///< Links that a joint has as its child.
  std::vector<std::string> endless_;
  std::vector<std::string> endless_slides_;
};

}  // namespace handway::geometric
