#include "handway/geometric/robot/numeric_inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/robots.h"
#include "random_configurations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace handway::geometric {
namespace {

using test::RandomConfigurations;
using ::testing::HasSubstr;

std::shared_ptr<const RobotModel> shared(const RobotDescription& robot) {
  return std::make_shared<const RobotModel>(robot);
}

Pose tip_pose(const NumericInverseKinematics& ik, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(ik.model().link_count()));
  ik.model().forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(ik.tip_link())] * ik.options().X_LT;
}

bool within_limits(const RobotModel& model, const Configuration& q) {
  return (q - model.lower()).minCoeff() >= 0.0 && (model.upper() - q).minCoeff() >= 0.0;
}

/// Checks a solver's results for a pose with forward kinematics.
void expect_honest(const NumericInverseKinematics& ik, const Pose& X_BT,
                   const NumericIkResult& result) {
  const Pose X = tip_pose(ik, result.q);
  EXPECT_TRUE(within_limits(ik.model(), result.q));
  EXPECT_NEAR(result.position_residual, (X.translation() - X_BT.translation()).norm(), 1e-12);
  if (!ik.options().position_only) {
    const double turn =
        Eigen::AngleAxisd(Eigen::Matrix3d(X.linear().transpose() * X_BT.linear())).angle();
    EXPECT_NEAR(result.orientation_residual, turn, 1e-9);
  }
  EXPECT_EQ(result.converged, result.reason.empty());
}

/// Reaches poses of random configurations, starting from other random ones.
/// @return how many of `count` were reached.
int reached(const NumericInverseKinematics& ik, int count, std::uint64_t seed) {
  RandomConfigurations random(ik.model(), seed);
  int successes = 0;
  for (int k = 0; k < count; ++k) {
    const Configuration reference = random.next();
    Configuration q = reference;
    const Configuration other = random.next();
    for (const int v : ik.variables()) {
      q[v] = other[v];
    }
    const Pose X_BT = tip_pose(ik, q);
    const NumericIkResult result = ik.find(X_BT, reference);
    expect_honest(ik, X_BT, result);
    successes += result.converged ? 1 : 0;
  }
  return successes;
}

TEST(NumericInverseKinematics, ReachesNearlyEveryPoseOfTheArm) {
  const NumericInverseKinematics ik(shared(test::tx90_urdf_style()), "flange");
  EXPECT_GE(reached(ik, 1000, 20), 995);
}

TEST(NumericInverseKinematics, ReachesNearlyEveryFingertipPosition) {
  NumericIkOptions options;
  options.X_LT.translation() = Eigen::Vector3d(0.0295, 0, 0);
  options.position_only = true;
  const NumericInverseKinematics ik(shared(test::tx90_sah()), "Index-Dist",
                                    {"Index-Base", "Index-Prox", "Index-Med"}, options);
  ASSERT_EQ(ik.variables().size(), 3u);
  EXPECT_GE(reached(ik, 1000, 21), 995);
}

TEST(NumericInverseKinematics, MovesOnlyTheVariablesItIsGiven) {
  const auto model = shared(test::tx90_sah());
  NumericIkOptions options;
  options.position_only = true;
  const NumericInverseKinematics ik(model, "Palm", {"joint_1", "joint_2", "joint_3"}, options);
  RandomConfigurations random(*model, 22);
  const Configuration reference = random.next();
  Configuration q = reference;
  q.head(3) << 0.3, 0.4, 0.9;
  const NumericIkResult result = ik.find(tip_pose(ik, q), reference);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_EQ(result.q.tail(16), reference.tail(16));
}

TEST(NumericInverseKinematics, SolvesArmAndFingerTogether) {
  const NumericInverseKinematics ik(shared(test::tx90_sah()), "Mid-Dist");
  EXPECT_EQ(ik.variables().size(), 9u);
  EXPECT_GE(reached(ik, 200, 23), 198);
}

TEST(NumericInverseKinematics, GivesTheNearestPostureOfAnUnreachablePoint) {
  NumericIkOptions options;
  options.position_only = true;
  const auto model = shared(test::tx90_urdf_style());
  const NumericInverseKinematics ik(model, "flange", {}, options);
  // Straight above the stretched arm: its top is 1.428 m high.
  const Pose X_BT = pose_from_rpy({0.05, 0.05, 3.0}, 0, 0, 0);
  Configuration reference(6);
  reference << 1.0, 0.5, 0.5, 0.3, 0.3, 0.3;
  const NumericIkResult result = ik.find(X_BT, reference);
  expect_honest(ik, X_BT, result);
  EXPECT_FALSE(result.converged);
  EXPECT_NEAR(result.position_residual, 3.0 - 1.428, 1e-4);
  EXPECT_THAT(result.reason, HasSubstr("101 starts"));
  const IkResult solved = ik.solve(X_BT, reference);
  EXPECT_TRUE(solved.solutions.empty());
  EXPECT_THAT(solved.reason, HasSubstr("mm"));
}

TEST(NumericInverseKinematics, IsHonestAboutPosesThatLimitsForbid) {
  RobotDescription stiff = test::tx90_urdf_style();
  stiff.joints[4].limits.lower = -0.1;
  stiff.joints[4].limits.upper = 0.1;
  const NumericInverseKinematics free_arm(shared(test::tx90_urdf_style()), "flange");
  const NumericInverseKinematics ik(shared(stiff), "flange");
  Configuration q(6);
  q << 0.3, 0.4, 1.2, 0.5, 1.3, 0.9;
  const Pose X_BT = tip_pose(free_arm, q);
  const NumericIkResult result = ik.find(X_BT, Configuration::Zero(6));
  expect_honest(ik, X_BT, result);
  EXPECT_FALSE(result.converged);
}

TEST(NumericInverseKinematics, GivesTheSameBitsForTheSameSeed) {
  const auto model = shared(test::tx90_urdf_style());
  const NumericInverseKinematics first(model, "flange");
  const NumericInverseKinematics second(model, "flange");
  RandomConfigurations random(*model, 24);
  for (int k = 0; k < 50; ++k) {
    const Pose X_BT = tip_pose(first, random.next());
    const Configuration reference = random.next();
    EXPECT_EQ(first.find(X_BT, reference).q, second.find(X_BT, reference).q);
  }
}

TEST(NumericInverseKinematics, StopsAtItsTimeLimit) {
  NumericIkOptions options;
  options.time_limit_s = 1e-3;
  options.max_restarts = 1'000'000;
  const NumericInverseKinematics ik(shared(test::tx90_urdf_style()), "flange", {}, options);
  const NumericIkResult result = ik.find(pose_from_rpy({5, 0, 0}, 0, 0, 0), Configuration::Zero(6));
  EXPECT_FALSE(result.converged);
  EXPECT_THAT(result.reason, HasSubstr("time limit"));
  EXPECT_LT(result.restarts, 1'000'000);
}

TEST(NumericInverseKinematics, RefusesJointsThatDoNotMoveTheTip) {
  const auto model = shared(test::tx90_sah());
  EXPECT_THROW(NumericInverseKinematics(model, "Index-Dist", {"Mid-Prox"}), InputError);
  EXPECT_THROW(NumericInverseKinematics(model, "Index-Dist", {"Index-Dist"}), InputError);
  EXPECT_THROW(NumericInverseKinematics(model, "nowhere"), InputError);
  EXPECT_THROW(NumericInverseKinematics(model, "base_link"), InputError);
}

TEST(NumericInverseKinematics, RefusesOptionsOutOfRange) {
  const auto model = shared(test::tx90_urdf_style());
  const auto with = [&](auto change) {
    NumericIkOptions options;
    change(options);
    return NumericInverseKinematics(model, "flange", {}, options).variables().size();
  };
  EXPECT_THROW(with([](NumericIkOptions& o) { o.position_tolerance = 0.0; }), InputError);
  EXPECT_THROW(with([](NumericIkOptions& o) { o.orientation_weight = -1.0; }), InputError);
  EXPECT_THROW(with([](NumericIkOptions& o) { o.max_iterations = 0; }), InputError);
  EXPECT_THROW(with([](NumericIkOptions& o) { o.time_limit_s = 0.0; }), InputError);
}

}  // namespace
}  // namespace handway::geometric
