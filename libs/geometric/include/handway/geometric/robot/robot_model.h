#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/periods.h"
#include "handway/geometric/robot/robot_description.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// Independent joints (variables) of one robot, by their indices in a Configuration.
using JointIndices = std::vector<int>;
/// Links of one robot, by their indices in its model.
using LinkIndices = std::vector<int>;

/// Data of one joint that forward kinematics needs, without names and in one piece of
/// memory: X_BL = X_BP * X_PJ * motion(value), value = multiplier * q[variable] +
/// offset.
struct ForwardKinematicsStep {
  enum class Motion : std::uint8_t {
    kFixed,
    kTurnX,  ///< About +x of the joint frame; an axis -x is folded into the value's sign.
    kTurnY,
    kTurnZ,
    kTurnAxis,  ///< About any other axis.
    kSlide,     ///< Along `axis`.
  };

  Motion motion = Motion::kFixed;
  bool turned = false;  ///< False if X_PJ is a pure translation.
  int parent = 0;       ///< Link index.
  int variable = -1;
  double multiplier = 1.0;
  double offset = 0.0;
  Eigen::Matrix3d R_PJ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_PJ = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
};

/// @param multiplier, offset the joint's value from its variable (RobotModel::MimicMapping).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT ForwardKinematicsStep forward_kinematics_step(
    const Joint& joint, int parent, int variable, double multiplier, double offset);

/// A robot as an immutable kinematic tree, shared by all threads.
///
/// Links are numbered parents first, link 0 being the root; joint i (i ≥ 1) carries link i.
/// *Variables* are the independent joints: neither fixed nor coupled. A Configuration lists them in
/// link order.
class HANDWAY_GEOMETRIC_EXPORT RobotModel {
 public:
  /// Mapping from a configuration to a joint's value: q_joint = multiplier * q[variable] + offset;
  /// variable < 0 for a fixed joint.
  struct MimicMapping {
    int variable = -1;
    double multiplier = 1.0;
    double offset = 0.0;
  };

  /// @throws InputError if names repeat or dangle, the joints form no single
  /// tree, limits are inverted, not finite (but for continuous joints) or never kept by a coupled
  /// joint, an axis is zero, or a coupling names a fixed, missing or itself coupled joint.
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
  [[nodiscard]] const MimicMapping& mimic_mapping(int link) const {
    return mimic_mappings_[static_cast<std::size_t>(link)];
  }
  [[nodiscard]] std::optional<int> find_link(std::string_view name) const;

  [[nodiscard]] int variable_count() const { return static_cast<int>(variable_links_.size()); }
  /// The link that variable `index` moves directly.
  [[nodiscard]] int variable_link(int index) const {
    return variable_links_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const Joint& variable(int index) const { return joint(variable_link(index)); }
  [[nodiscard]] std::optional<int> find_variable(std::string_view joint_name) const;
  /// Limits of all variables, within which coupled joints keep theirs. A continuous joint, which
  /// has none, gets half a turn each way: the range over which it is sampled and by which distances
  /// are normalised. Shape [variable_count].
  [[nodiscard]] const Configuration& lower() const { return lower_; }
  [[nodiscard]] const Configuration& upper() const { return upper_; }

  /// Returns whether the joint turns without end: its values count modulo 2π.
  [[nodiscard]] bool is_continuous(int variable) const { return turns_.has(variable); }
  /// Periods: 2π for each continuous joint.
  [[nodiscard]] const Periods& turns() const { return turns_; }
  /// Returns `to`, with continuous joints moved by whole turns to within half a turn of `from`;
  /// unchanged if the sizes differ.
  [[nodiscard]] Configuration nearest_equivalent(const Configuration& from,
                                                 const Configuration& to) const {
    return from.size() == to.size() ? turns_.nearest(from, to) : to;
  }
  /// Returns the waypoints, each as nearest_equivalent() to the one before, the first to `start`:
  /// the values that hardware needs, without jumps.
  [[nodiscard]] std::vector<Configuration> unwrapped(std::vector<Configuration> waypoints,
                                                     const Configuration& start) const;
  /// Returns the path with extra waypoints wherever a continuous joint turns by more than half a
  /// turn at once: so nearest_equivalent() of each to the one before is itself.
  [[nodiscard]] std::vector<Configuration> in_half_turns(
      const std::vector<Configuration>& waypoints) const;
  /// Returns `q` clamped to all limits.
  [[nodiscard]] Configuration clamped(Configuration q) const;

  /// Variables of the group's joints, in configuration order; coupled and fixed
  /// joints of the group are left out. nullopt if there is no such group.
  [[nodiscard]] std::optional<JointIndices> find_group(std::string_view name) const;

  /// The middle of every joint's range, limits that contain 0 giving 0.
  [[nodiscard]] Configuration neutral() const;

  /// Poses of all links in the robot's base frame B (the root link's frame).
  /// @param q shape [variable_count].
  /// @param[out] X_BL shape [link_count].
  void forward_kinematics(const Configuration& q, std::span<Pose> X_BL) const;

  /// Returns whether `variable` moves the two links against each other: whether it is on the chain
  /// between them, up to their closest common ancestor.
  [[nodiscard]] bool moves_between(int variable, int link_a, int link_b) const;

 private:
  void sort_parents_first();
  void index_variables();
  void tighten_limits_for_mimic_joints();
  void set_ranges();

  RobotDescription description_;
  LinkIndices parents_;
  std::vector<MimicMapping> mimic_mappings_;
  LinkIndices variable_links_;
  std::vector<ForwardKinematicsStep> steps_;  ///< One per joint, of link i at i - 1.
  Configuration lower_;
  Configuration upper_;
  Periods turns_;
};

/// The value of the joint that carries `link`: for the last joint of a coupling's chain (see
/// couple_joint()), that of the whole chain.
/// @pre the joint moves. @param q shape [variable_count].
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT double joint_value(const RobotModel& model, int link,
                                                          const Configuration& q);

/// Values of every moving joint, coupled ones included, in link order.
struct JointValue {
  std::string_view joint;
  double value;  ///< rad or m
};
/// Returns the values of all joints that are not fixed.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<JointValue> joint_values(const RobotModel& model,
                                                                            const Configuration& q);

}  // namespace handway::geometric
