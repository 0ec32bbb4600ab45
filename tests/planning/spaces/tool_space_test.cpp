#include "handway/geometric/math/pose.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/sampling/sequences/random_stream.h"
#include "handway_test/known_problems.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace handway::planning {
namespace {

/// The shipped arm with a hand in front of a table.
class ToolSpace : public testing::Test {
 protected:
  static PlanningProblem problem() {
    const SceneState loaded = test::load(test::known_problems()[1]);
    return make_problem(loaded.scene, loaded.basis);
  }
  [[nodiscard]] Eigen::VectorXd on_motion(double step) const {
    return space_->corridor_point(step, 0.0, Eigen::VectorXd::Constant(6, 0.5));
  }
  static Eigen::Matrix3d turn(const Eigen::VectorXd& x) {
    return geometric::turn_from_rotation_vector(3.0 * x.tail<3>()).toRotationMatrix();
  }

  PlanningProblem problem_ = problem();
  std::unique_ptr<CorridorSpace> space_ = make_corridor_space(problem_, CorridorForm::kCartesian);
  Eigen::VectorXd start_ = space_->coordinates(problem_.start).head<6>();
  Eigen::VectorXd goal_ = space_->coordinates(problem_.goal).head<6>();
};

TEST_F(ToolSpace, MovesStraightAndTurnsEvenly) {
  for (const double step : {0.0, 0.25, 0.5, 1.0}) {
    EXPECT_TRUE(on_motion(step).isApprox(start_ + step * (goal_ - start_), 1e-9)) << step;
  }
}

TEST_F(ToolSpace, KeepsSamplesInCubesAroundTheMotion) {
  constexpr double kRho = 0.2;
  sampling::RandomStream stream(1);
  for (int i = 0; i < 500; ++i) {
    const double step = stream.uniform();
    const Eigen::VectorXd centre = on_motion(step);
    const Eigen::VectorXd x = space_->corridor_point(step, kRho, stream.uniform(6));
    EXPECT_LE((x - centre).head<3>().lpNorm<Eigen::Infinity>(), kRho + 1e-12);
    const Eigen::AngleAxisd between(turn(centre).transpose() * turn(x));
    EXPECT_LE((between.angle() * between.axis()).lpNorm<Eigen::Infinity>(), 3.0 * kRho + 1e-9);
  }
}

TEST_F(ToolSpace, SpacesItsStepsByPositionOrOrientation) {
  const double length =
      std::max((goal_ - start_).head<3>().norm(),
               Eigen::AngleAxisd(turn(start_).transpose() * turn(goal_)).angle() / 3.0);
  EXPECT_EQ(space_->steps(1.01 * length), 1);
  EXPECT_EQ(space_->steps(0.3 * length), 4);
}

TEST_F(ToolSpace, FindsTheArmAtAPoseOfTheTool) {
  const Eigen::VectorXd x = space_->coordinates(problem_.goal);
  const auto q = space_->configuration(x, problem_.goal);
  ASSERT_TRUE(q);
  EXPECT_TRUE(q->isApprox(problem_.goal, 1e-6));
}

}  // namespace
}  // namespace handway::planning
