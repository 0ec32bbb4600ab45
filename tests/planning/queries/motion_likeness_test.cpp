#include "handway/planning/queries/motion_likeness.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/queries/dynamic_time_warping.h"

#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

using test::planar_configuration;

/// The planar arm with two fingers, and a recording of its hand that opens and closes.
class MotionLikenessOfTheFlatArm : public testing::Test {
 protected:
  [[nodiscard]] Trajectory timed(const std::vector<Configuration>& waypoints) const {
    const auto trajectory = likeness_trajectory(problem_, {waypoints});
    EXPECT_TRUE(std::holds_alternative<Trajectory>(trajectory))
        << std::get<std::string>(trajectory);
    return std::get<Trajectory>(trajectory);
  }
  [[nodiscard]] MotionLikeness measured(const std::vector<Configuration>& waypoints) const {
    return motion_likeness(problem_, timed(waypoints), recorded_.get());
  }

  // The hand goes from one posture to the other as the arm from start to goal, and back, twenty
  // times with other sizes.
  void record(const Configuration& from, const Configuration& to) {
    constexpr Eigen::Index kRows = 100;
    const Eigen::VectorXd p = geometric::normalised(problem_.model(), from)(problem_.joints.hand);
    const Eigen::VectorXd q = geometric::normalised(problem_.model(), to)(problem_.joints.hand);
    sampling::PostureTable table{basis_.hand, "made up", basis_.joints, {}, {}};
    table.postures.resize(20 * kRows, p.size());
    table.times = 0.01 * Eigen::VectorXd::LinSpaced(table.postures.rows(), 0.0,
                                                    static_cast<double>(table.postures.rows() - 1));
    for (Eigen::Index row = 0; row < table.postures.rows(); ++row) {
      const double wave = 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(row) / kRows);
      table.postures.row(row) = ((1.0 - wave) * p + wave * q).transpose();
    }
    recorded_ = std::make_shared<const sampling::RecordedPostures>(basis_, table, "made up");
  }

  PlanningProblem problem_ = test::open_problem();
  sampling::PmdBasis basis_ = *problem_.basis;
  std::shared_ptr<const sampling::RecordedPostures> recorded_;
  Configuration rest_ = planar_configuration(0.0, 0.5);
  Configuration turned_ = planar_configuration(1.0, 0.5);
  Configuration open_ = planar_configuration(1.0, 0.5, 0.0, 0.4, 0.4);
};

TEST_F(MotionLikenessOfTheFlatArm, IsSmoothestOnAStraightPath) {
  const MotionLikeness straight = measured({rest_, open_});
  const MotionLikeness there_and_back = measured({rest_, open_, rest_, open_});
  ASSERT_TRUE(straight.palm && straight.hand && there_and_back.palm && there_and_back.hand);
  EXPECT_LT(straight.palm->spectral_arc_length, -1.4) << "a minimum-jerk movement's";
  EXPECT_GT(straight.palm->spectral_arc_length, -2.0) << "it cruises at its highest speed";
  EXPECT_LT(straight.palm->log_dimensionless_jerk, -5.322);
  EXPECT_GT(straight.palm->log_dimensionless_jerk, -8.0);
  EXPECT_LT(there_and_back.palm->spectral_arc_length, straight.palm->spectral_arc_length - 0.5);
  EXPECT_LT(there_and_back.hand->log_dimensionless_jerk, straight.hand->log_dimensionless_jerk);
}

TEST_F(MotionLikenessOfTheFlatArm, DeviatesNowhereFromAStraightPath) {
  const MotionLikeness straight = measured({rest_, turned_});
  ASSERT_TRUE(straight.deviation);
  EXPECT_NEAR(straight.deviation->arm, 0.0, 1e-9);
  EXPECT_NEAR(straight.deviation->palm, 0.0, 1e-4) << "straight pieces stand for an arc";
}

TEST_F(MotionLikenessOfTheFlatArm, DeviatesByTheDetourOfTheArm) {
  // The shoulder goes 0.3 rad too far; at its limits of ±π that is 0.3 / 2π.
  const Configuration beyond = planar_configuration(1.3, 0.5);
  const MotionLikeness detour = measured({rest_, beyond, turned_});
  ASSERT_TRUE(detour.deviation);
  const Configuration range = problem_.model().upper() - problem_.model().lower();
  EXPECT_NEAR(detour.deviation->arm, 0.3 / range[0], 1e-3);
  const auto palm_at = [&](const Configuration& q) {
    std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(problem_.model().link_count()));
    problem_.model().forward_kinematics(q, X_BL);
    return Eigen::Vector3d(X_BL[static_cast<std::size_t>(problem_.hand.palm)].translation());
  };
  EXPECT_NEAR(detour.deviation->palm, (palm_at(beyond) - palm_at(turned_)).norm(), 1e-3);
}

TEST_F(MotionLikenessOfTheFlatArm, HasNoSmoothnessOfWhatDoesNotMove) {
  const MotionLikeness arm_only = measured({rest_, turned_});
  EXPECT_TRUE(arm_only.palm);
  EXPECT_FALSE(arm_only.hand);
  for (const auto& path : {std::vector{rest_}, {rest_, rest_}}) {
    const MotionLikeness still = measured(path);
    EXPECT_FALSE(still.palm);
    EXPECT_FALSE(still.hand);
    EXPECT_EQ(still.deviation->arm, 0.0);
    EXPECT_EQ(still.deviation->palm, 0.0);
  }
  EXPECT_FALSE(motion_likeness(problem_, {}, nullptr).deviation) << "no motion at all";
}

TEST_F(MotionLikenessOfTheFlatArm, IsRepresentedByRecordingsOfTheSameMotion) {
  record(rest_, open_);
  const MotionLikeness like_recorded = measured({rest_, open_});
  ASSERT_TRUE(like_recorded.components) << like_recorded.no_components;
  EXPECT_EQ(like_recorded.components->motions, 20U);
  EXPECT_LT(like_recorded.components->error, 0.03)
      << "rad, of 0.4; only the course in time differs";
  EXPECT_LT(like_recorded.components->recorded_median, 0.01);
  EXPECT_LE(like_recorded.components->recorded_median, like_recorded.components->recorded_95);
  const MotionLikeness other =
      measured({rest_, planar_configuration(1.0, 0.5, 0.0, 0.4, 0.0)});  // one finger alone
  EXPECT_GT(other.components->error, 5.0 * like_recorded.components->error);
}

TEST_F(MotionLikenessOfTheFlatArm, SaysWhyThereAreNoComponents) {
  EXPECT_EQ(measured({rest_, open_}).no_components, "There are no recorded postures of the hand.");
  record(rest_, rest_);
  EXPECT_NE(measured({rest_, open_}).no_components.find("too few"), std::string::npos);
  record(rest_, open_);
  const MotionLikeness still = measured({rest_, turned_});
  EXPECT_FALSE(still.components);
  EXPECT_EQ(still.no_components, "The hand does not move.");
}

TEST_F(MotionLikenessOfTheFlatArm, LeavesOutTheHandOfAnArmWithoutOne) {
  problem_.joints.hand.clear();
  problem_.basis = nullptr;
  const MotionLikeness likeness = measured({rest_, open_});
  EXPECT_FALSE(likeness.hand);
  EXPECT_FALSE(likeness.components);
  EXPECT_TRUE(likeness.palm);
}

TEST_F(MotionLikenessOfTheFlatArm, LeavesOutTheArmOfAHandAlone) {
  problem_.joints.arm.clear();
  const MotionLikeness likeness = measured({rest_, open_});
  EXPECT_TRUE(likeness.hand);
  EXPECT_FALSE(likeness.palm);
  EXPECT_FALSE(likeness.deviation);
}

TEST_F(MotionLikenessOfTheFlatArm, DependsOnTheTimingOnlyInItsDuration) {
  const Trajectory fast = timed({rest_, open_});
  Trajectory slow = fast;
  for (TrajectoryPoint& point : slow.points) {
    point.time *= 3.0;
    point.velocity /= 3.0;
    point.acceleration /= 9.0;
  }
  const MotionLikeness a = motion_likeness(problem_, fast, nullptr);
  const MotionLikeness b = motion_likeness(problem_, slow, nullptr);
  EXPECT_NEAR(b.duration, 3.0 * a.duration, 1e-9);
  EXPECT_NEAR(b.palm->log_dimensionless_jerk, a.palm->log_dimensionless_jerk, 1e-3);
  EXPECT_NEAR(b.hand->spectral_arc_length, a.hand->spectral_arc_length, 1e-3);
}

TEST_F(MotionLikenessOfTheFlatArm, ComparesMotionsOfTwoPaths) {
  const Eigen::MatrixXd straight = comparable_motion(problem_, timed({rest_, turned_}));
  EXPECT_EQ(straight.rows(), sampling::kMotionPoints);
  EXPECT_EQ(straight.cols(), std::ssize(problem_.planned_joints()));
  const Configuration middle = planar_configuration(0.5, 0.5);
  const Eigen::MatrixXd same = comparable_motion(problem_, timed({rest_, middle, turned_}));
  const Eigen::MatrixXd bent =
      comparable_motion(problem_, timed({rest_, planar_configuration(0.5, 1.5), turned_}));
  EXPECT_LT(warped_distance(straight, same), 0.002);
  EXPECT_GT(warped_distance(straight, bent), 0.03);
}

}  // namespace
}  // namespace handway::planning
