#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <compare>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::geometric {

/// The branch of an anthropomorphic six-axis arm's inverse kinematics, as
/// Staeubli controllers name it in their configuration flags. A posture on the
/// border between two branches counts as the first named.
struct ArmBranch {
  enum class Shoulder { kLefty, kRighty };
  enum class Bend { kPositive, kNegative };

  /// Lefty if the wrist centre is on the positive side of the shoulder plane:
  /// for the TX90, 0.425 sin q2 + 0.425 sin(q2 + q3) + 0.05 ≥ 0.
  Shoulder shoulder = Shoulder::kLefty;
  /// Sign of the elbow's bend from the stretched arm: for the TX90, of q3.
  Bend elbow = Bend::kPositive;
  /// Sign of the wrist's bend from axes 4 and 6 in line: for the TX90, of q5.
  Bend wrist = Bend::kPositive;

  // clang-tidy 14 takes the comparison with 0 inside for a null pointer.
  auto operator<=>(const ArmBranch&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// One configuration that reaches a pose.
struct IkSolution {
  Configuration q;                  ///< Shape [variables().size()], in that order; rad or m.
  std::optional<ArmBranch> branch;  ///< Branch, of solvers that know branches.
};

/// Result of inverse kinematics.
struct IkResult {
  std::vector<IkSolution> solutions;  ///< Nearest to the reference first; may be empty.
  std::string reason;                 ///< Reason of a failure; empty on success.
};

/// Finds configurations of a chain's variables that bring a tip link to a pose.
/// Const and without hidden state: one object may serve several threads.
class HANDWAY_GEOMETRIC_EXPORT InverseKinematics {
 public:
  virtual ~InverseKinematics() = default;
  InverseKinematics(const InverseKinematics&) = delete;
  InverseKinematics& operator=(const InverseKinematics&) = delete;

  [[nodiscard]] const RobotModel& model() const { return *model_; }
  [[nodiscard]] int tip_link() const { return tip_link_; }
  /// Indices of the variables solved for, in ascending order.
  [[nodiscard]] const JointIndices& variables() const { return variables_; }

  /// @param X_BT pose of the tip link's frame in the robot's base frame.
  /// @param reference shape [model().variable_count()]: configuration to stay near to, with the
  /// values of the variables that are not solved for.
  /// @throws InputError if sizes differ, a number is not finite or X_BT is no
  /// rigid transform. A pose out of reach is no error: see IkResult::reason.
  [[nodiscard]] IkResult solve(const Pose& X_BT, const Configuration& reference) const;

  /// The reference with the solution's values in the places of variables().
  [[nodiscard]] Configuration placed(const IkSolution& solution,
                                     const Configuration& reference) const;

 protected:
  /// @throws InputError if tip_link or a variable is not the model's, or there
  /// is no variable. @pre model is not null.
  InverseKinematics(std::shared_ptr<const RobotModel> model, int tip_link, JointIndices variables);

  /// The derived class's solver; arguments are checked. The result needs no order.
  [[nodiscard]] virtual IkResult do_solve(const Pose& X_BT,
                                          const Configuration& reference) const = 0;

  /// @throws InputError as solve().
  void check(const Pose& X_BT, const Configuration& reference) const;

 private:
  std::shared_ptr<const RobotModel> model_;
  int tip_link_;
  JointIndices variables_;
};

/// Variables of the joints on the chain from the root to `link`, ascending.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT JointIndices chain_variables(const RobotModel& model,
                                                                    int link);

}  // namespace handway::geometric
