#pragma once

#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <memory>
#include <vector>

namespace handway::planning {

/// Where an arm got to when its palm was sent somewhere.
struct PalmMove {
  Configuration q;       ///< Of the whole robot, within limits.
  bool reached = false;  ///< Up to 0.1 mm and 0.01°; of an arm of few joints the place alone.
};

/// Moves an arm so that the palm goes to a pose, the fingers staying as they are: in closed form
/// where the arm has one, by iteration otherwise. Const and for any number of threads.
class HANDWAY_PLANNING_EXPORT PalmIk {
 public:
  /// @param palm a link that the arm moves. @param arm its variables, at least one.
  /// @throws InputError if none of them moves the palm.
  PalmIk(std::shared_ptr<const geometric::RobotModel> model, int palm, const std::vector<int>& arm);
  ~PalmIk();
  PalmIk(PalmIk&&) noexcept;

  [[nodiscard]] int palm() const { return palm_; }
  /// X_BP of the palm in the robot's base.
  [[nodiscard]] geometric::Pose pose(const Configuration& q) const;

  /// The arm posture nearest to `q` that brings the palm to X_BP. Out of reach: one whose palm is
  /// as near as iterations from `q` get it.
  /// @throws InputError if X_BP is no rigid transform or `q` no configuration.
  [[nodiscard]] PalmMove moved(const Configuration& q, const geometric::Pose& X_BP) const;

  /// Arm postures that reach X_BP, nearest to `q` first: one for each branch, or of an arm without
  /// closed form up to four that iterations from several starts find. Same arguments, same bits.
  [[nodiscard]] std::vector<Configuration> all(const Configuration& q,
                                               const geometric::Pose& X_BP) const;

 private:
  std::shared_ptr<const geometric::RobotModel> model_;
  int palm_;
  std::vector<int> arm_;
  std::unique_ptr<geometric::InverseKinematics> closed_form_;       ///< Null: there is none.
  std::unique_ptr<geometric::NumericInverseKinematics> iterative_;  ///< From where the arm is.
  std::unique_ptr<geometric::NumericInverseKinematics> searching_;  ///< From other starts, too.
};

/// The link that stands for a hand as a whole: the closest that carries all of its fingers;
/// without fingers the last that the arm moves.
[[nodiscard]] HANDWAY_PLANNING_EXPORT int palm_link(const geometric::RobotModel& model,
                                                    const std::vector<int>& arm,
                                                    const std::vector<int>& hand);

}  // namespace handway::planning
