#pragma once

#include "hand_model.h"
#include "handway/planning/grasps/hold_test.h"

#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace handway::simulate_mujoco {

/// Tests by MuJoCo whether grasps hold an object.
class MujocoHoldTest : public planning::HoldTest {
 public:
  /// @throws InputError if the problem has no such object, or hand or object can't be simulated.
  MujocoHoldTest(const planning::PlanningProblem& problem, std::string_view object, int palm);

  [[nodiscard]] planning::HoldResult test(const planning::Pregrasp& grasp,
                                          const planning::HoldConditions& conditions,
                                          const std::stop_token& stop,
                                          const planning::HoldWatcher& watch) const override;
  [[nodiscard]] planning::CarryResult carry(const planning::Pregrasp& grasp,
                                            const planning::PalmMotion& motion,
                                            const planning::HoldConditions& conditions,
                                            const std::stop_token& stop,
                                            const planning::HoldWatcher& watch) const override;
  [[nodiscard]] std::vector<std::string> assumptions() const override;

 private:
  std::shared_ptr<const geometric::RobotModel> robot_;
  int palm_;
  geometric::Pose X_WB_;  ///< Pose of the robot's base in the world.
  geometric::Pose X_WO_;  ///< Pose of the object in the world.
  HandModel hand_;
};

}  // namespace handway::simulate_mujoco
