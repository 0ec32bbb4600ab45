#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/forward_kinematics_step.h"
#include "handway/geometric/robot/robot_description.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// A robot as an immutable kinematic tree, shared by all threads.
///
/// Links are numbered parents first, link 0 being the root; joint i (i ≥ 1)
/// carries link i. *Variables* are the joints that move on their own: neither
/// fixed nor coupled. A Configuration lists them in link order.
class HANDWAY_GEOMETRIC_EXPORT RobotModel {
 public:
  /// How a joint's value follows from a configuration:
  /// q_joint = multiplier * q[variable] + offset; variable < 0 for a fixed joint.
  struct Drive {
    int variable = -1;
    double multiplier = 1.0;
    double offset = 0.0;
  };

  /// @throws InputError if names repeat or dangle, the joints form no single
  /// tree, limits are inverted, not finite or never kept by a coupled joint, an axis
  /// is zero, or a coupling names a fixed, missing or itself coupled joint.
  explicit RobotModel(RobotDescription description);

  [[nodiscard]] const std::string& name() const { return description_.name; }
  [[nodiscard]] const RobotDescription& description() const { return description_; }

  [[nodiscard]] int link_count() const { return static_cast<int>(description_.links.size()); }
  [[nodiscard]] const Link& link(int index) const {
    return description_.links[static_cast<std::size_t>(index)];
  }
  /// Index of the parent link; -1 for the root.
  [[nodiscard]] int parent(int link) const { return parents_[static_cast<std::size_t>(link)]; }
  /// The joint that carries `link`. @pre link ≥ 1.
  [[nodiscard]] const Joint& joint(int link) const {
    return description_.joints[static_cast<std::size_t>(link - 1)];
  }
  [[nodiscard]] const Drive& drive(int link) const {
    return drives_[static_cast<std::size_t>(link)];
  }
  [[nodiscard]] std::optional<int> find_link(std::string_view name) const;

  [[nodiscard]] int variable_count() const { return static_cast<int>(variable_links_.size()); }
  /// The link that variable `index` moves directly.
  [[nodiscard]] int variable_link(int index) const {
    return variable_links_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const Joint& variable(int index) const { return joint(variable_link(index)); }
  [[nodiscard]] std::optional<int> find_variable(std::string_view joint_name) const;
  /// Limits of all variables, within which coupled joints keep theirs; shape [variable_count].
  [[nodiscard]] const Configuration& lower() const { return lower_; }
  [[nodiscard]] const Configuration& upper() const { return upper_; }

  /// Variables of the group's joints, in configuration order; coupled and fixed
  /// joints of the group are left out. nullopt if there is no such group.
  [[nodiscard]] std::optional<std::vector<int>> find_group(std::string_view name) const;

  /// The middle of every joint's range, limits that contain 0 giving 0.
  [[nodiscard]] Configuration neutral() const;

  /// Poses of all links in the robot's base frame B (the root link's frame).
  /// @param q shape [variable_count].
  /// @param[out] X_BL shape [link_count].
  void forward_kinematics(const Configuration& q, std::span<Pose> X_BL) const;

  /// True if the joints between the two links' closest common ancestor and the
  /// links include `variable`, that is, if it moves one against the other.
  [[nodiscard]] bool moves_between(int variable, int link_a, int link_b) const;

 private:
  void sort_parents_first();
  void index_variables();

  RobotDescription description_;
  std::vector<int> parents_;
  std::vector<Drive> drives_;
  std::vector<int> variable_links_;
  std::vector<ForwardKinematicsStep> steps_;  ///< One per joint, of link i at i - 1.
  Configuration lower_;
  Configuration upper_;
};

/// Values of every moving joint, coupled ones included, in link order.
struct JointValue {
  std::string_view joint;
  double value;  ///< rad or m
};
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<JointValue> joint_values(const RobotModel& model,
                                                                            const Configuration& q);

}  // namespace handway::geometric
