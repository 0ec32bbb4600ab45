/// Numeric inverse kinematics of arms of several makers: how many poses it reaches, and what it
/// makes of redundancy, tolerances, whole turns and configurations that won't do.
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/arm_inverse_kinematics.h"
#include "handway/geometric/robot/jacobian.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway_test/paths.h"
#include "handway_test/robots.h"
#include "random_configurations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>

namespace handway::geometric {
namespace {

using test::RandomConfigurations;
using ::testing::HasSubstr;

std::shared_ptr<const RobotModel> model_of(const RobotDescription& robot) {
  return std::make_shared<const RobotModel>(robot);
}

Pose pose_of_tip(const InverseKinematics& ik, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(ik.model().link_count()));
  ik.model().forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(ik.tip_link())];
}

double angle_between(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.linear().transpose() * b.linear())).angle();
}

bool keeps_limits(const RobotModel& model, const Configuration& q) {
  return (q - model.lower()).minCoeff() >= 0.0 && (model.upper() - q).minCoeff() >= 0.0;
}

/// Returns how many of 10 000 poses of uniformly random configurations are reached from the neutral
/// one.
int reached_of_10000(const std::shared_ptr<const RobotModel>& model, const std::string& tip) {
  constexpr int kPoses = 10000;
  const NumericInverseKinematics ik(model, tip);
  RandomConfigurations random(*model, 31);
  int count = 0;
  for (int k = 0; k < kPoses; ++k) {
    const Pose X_BT = pose_of_tip(ik, random.next());
    const NumericIkResult result = ik.find(X_BT, model->neutral());
    const Pose X = pose_of_tip(ik, result.q);
    const bool is_there = (X.translation() - X_BT.translation()).norm() < 2e-6 &&
                          angle_between(X, X_BT) < 2e-6 && keeps_limits(*model, result.q);
    EXPECT_EQ(result.converged, is_there);
    count += is_there ? 1 : 0;
  }
  return count;
}

TEST(InverseKinematicsOfArms, ReachesPosesOfAnOffsetWrist) {
  EXPECT_GE(reached_of_10000(model_of(test::ur5e()), "link_6"), 9950);
}

TEST(InverseKinematicsOfArms, ReachesPosesOfSevenJointsWithOffsets) {
  EXPECT_GE(reached_of_10000(model_of(test::panda_arm()), "link_7"), 9950);
}

TEST(InverseKinematicsOfArms, ReachesPosesOfSevenJointsInLine) {
  EXPECT_GE(reached_of_10000(model_of(test::iiwa14()), "link_7"), 9950);
}

TEST(InverseKinematicsOfArms, ReachesPosesOfPublishedFiles) {
  HANDWAY_NEED_REFERENCE(reference);
  EXPECT_GE(reached_of_10000(load_robot(reference / "robots/iiwa14/iiwa14.urdf"), "ee_link"), 9950);
  EXPECT_GE(reached_of_10000(load_robot(reference / "moveit/panda/panda.urdf"), "panda_hand"),
            9950);
}

TEST(InverseKinematicsOfArms, AgreesWithThePublishedFilesOnWhereTheFlangeIs) {
  HANDWAY_NEED_REFERENCE(reference);
  const auto published = load_robot(reference / "moveit/panda/panda.urdf");
  const auto own = model_of(test::panda_arm());
  const NumericInverseKinematics of_published(published, "panda_link8");
  const NumericInverseKinematics of_own(own, "link_7");
  RandomConfigurations random(*own, 32);
  for (int k = 0; k < 100; ++k) {
    const Configuration q = random.next();
    Configuration whole = published->neutral();
    whole(of_published.variables()) = q;
    EXPECT_LT((pose_of_tip(of_own, q).matrix() - pose_of_tip(of_published, whole).matrix())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6);
  }
}

TEST(InverseKinematicsOfArms, GoesOnUntilAConfigurationIsAccepted) {
  const auto model = model_of(test::ur5e());
  const NumericInverseKinematics ik(model, "link_6");
  Configuration q(6);
  q << 0.3, -1.2, 1.4, -0.5, 0.9, 0.2;
  const Pose X_BT = pose_of_tip(ik, q);
  const auto elbow_down = [](const Configuration& at) { return at[2] < 0.0; };
  ASSERT_GT(ik.find(X_BT, q).q[2], 0.0);
  const NumericIkResult result = ik.find(X_BT, q, elbow_down);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.q[2], 0.0);
  EXPECT_GE(result.refused, 1);
  const NumericIkResult none = ik.find(X_BT, q, [](const Configuration&) { return false; });
  EXPECT_FALSE(none.converged);
  EXPECT_LT(none.position_residual, 1e-6) << "it is there, and refused";
  EXPECT_THAT(none.reason, HasSubstr("none of them is accepted"));
}

TEST(InverseKinematicsOfArms, FindsTheEightPosturesOfAnOffsetWrist) {
  const auto model = model_of(test::ur5e());
  const NumericInverseKinematics ik(model, "link_6");
  Configuration q(6);
  q << 0.3, -1.2, 1.4, -0.5, 0.9, 0.2;
  const std::vector<Configuration> postures = ik.find_several(pose_of_tip(ik, q), q, 100);
  EXPECT_EQ(postures.size(), 8U);
  for (std::size_t i = 0; i < postures.size(); ++i) {
    EXPECT_LT(angle_between(pose_of_tip(ik, postures[i]), pose_of_tip(ik, q)), 1e-5);
    EXPECT_GE((postures[i] - q).norm(), i == 0 ? 0.0 : (postures[i - 1] - q).norm());
  }
  EXPECT_TRUE(postures.front().isApprox(q, 1e-5));
  EXPECT_EQ(ik.find_several(pose_of_tip(ik, q), q, 3).size(), 3U);
}

TEST(InverseKinematicsOfArms, TakesTheTurnNearestToTheReference) {
  const NumericInverseKinematics ik(model_of(test::ur5e()), "link_6");
  Configuration q(6);
  q << 0.3, -1.2, 1.4, -0.5, 0.9, 0.2;
  Configuration reference = q;
  reference[0] += 2.0 * std::numbers::pi - 0.3;
  reference[5] -= 2.0 * std::numbers::pi - 0.3;
  for (const Configuration& posture : ik.find_several(pose_of_tip(ik, q), reference, 100)) {
    EXPECT_TRUE(keeps_limits(ik.model(), posture));
    for (const int v : {0, 5}) {
      const double turn = posture[v] > reference[v] ? -2.0 : 2.0;
      const double other = posture[v] + turn * std::numbers::pi;
      const bool is_allowed = std::abs(other) <= 2.0 * std::numbers::pi;
      EXPECT_TRUE(!is_allowed ||
                  std::abs(posture[v] - reference[v]) <= std::abs(other - reference[v]));
    }
  }
}

TEST(InverseKinematicsOfArms, StaysNearTheReferenceInTheNullSpace) {
  const auto model = model_of(test::iiwa14());
  NumericIkOptions options;
  const NumericInverseKinematics any(model, "link_7", {}, options);
  options.stay_near = true;
  const NumericInverseKinematics near(model, "link_7", {}, options);
  RandomConfigurations random(*model, 33);
  int nearer = 0;
  for (int k = 0; k < 200; ++k) {
    const Pose X_BT = pose_of_tip(any, random.next());
    const Configuration reference = random.next();
    const NumericIkResult result = near.find(X_BT, reference);
    ASSERT_TRUE(result.converged);
    EXPECT_LT(angle_between(pose_of_tip(near, result.q), X_BT), 2e-6);
    EXPECT_TRUE(keeps_limits(*model, result.q));
    const double distance = (result.q - reference).norm();
    const double without = (any.find(X_BT, reference).q - reference).norm();
    EXPECT_LE(distance, without);
    nearer += distance < 0.99 * without ? 1 : 0;
  }
  EXPECT_GE(nearer, 100);
}

TEST(InverseKinematicsOfArms, UsesTheSlackWhereThePoseItselfIsOutOfReach) {
  const auto model = model_of(test::iiwa14());
  NumericIkOptions options;
  const NumericInverseKinematics exact(model, "link_7", {}, options);
  Pose X_BT = Pose::Identity();  // straight up, the arm ends at 1.306 m
  X_BT.translation() = Eigen::Vector3d(0.0, 0.0, 1.32);
  EXPECT_FALSE(exact.find(X_BT, model->neutral()).converged);
  options.position_slack = Eigen::Vector3d(0.0, 0.0, 0.02);
  const NumericInverseKinematics along_z(model, "link_7", {}, options);
  const NumericIkResult result = along_z.find(X_BT, model->neutral());
  ASSERT_TRUE(result.converged) << result.reason;
  const Eigen::Vector3d p_T = pose_of_tip(along_z, result.q).translation();
  EXPECT_NEAR(p_T.x(), 0.0, 1e-5);
  EXPECT_NEAR(p_T.z(), 1.31, 0.0101);
}

TEST(InverseKinematicsOfArms, LeavesAFreeAxisFree) {
  const auto model = model_of(test::ur5e());
  NumericIkOptions options;
  options.rotation_slack = Eigen::Vector3d(0.0, 0.0, std::numbers::pi);
  const NumericInverseKinematics ik(model, "link_6", {}, options);
  RandomConfigurations random(*model, 34);
  int count = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose X_BT = pose_of_tip(ik, random.next());
    const NumericIkResult result = ik.find(X_BT, random.next());
    const Pose X = pose_of_tip(ik, result.q);
    const double tilt = std::acos(std::min(1.0, X.linear().col(2).dot(X_BT.linear().col(2))));
    if (result.converged) {
      ++count;
      EXPECT_LT(tilt, 1e-5);
      EXPECT_LT((X.translation() - X_BT.translation()).norm(), 2e-6);
    }
  }
  EXPECT_GE(count, 299);
}

TEST(InverseKinematicsOfArms, RefusesSlackBelowZero) {
  NumericIkOptions options;
  options.rotation_slack.y() = -0.1;
  EXPECT_THROW(NumericInverseKinematics(model_of(test::ur5e()), "link_6", {}, options), InputError);
}

Jacobian jacobian_at(const RobotModel& model, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return point_jacobian(model, X_BL, model.link_count() - 1);
}

TEST(ArmInverseKinematics, IsInClosedFormWhereTheArmIsBuiltForIt) {
  const auto tx90 = model_of(test::tx90_sah());
  const std::vector<int> arm = {0, 1, 2, 3, 4, 5};
  const int palm = tx90->find_link("Palm").value();
  EXPECT_TRUE(closed_form_inverse_kinematics(tx90, palm, arm));
  EXPECT_FALSE(closed_form_inverse_kinematics(tx90, palm, {0, 1, 2}));
  const auto ur5e = model_of(test::ur5e());
  EXPECT_FALSE(closed_form_inverse_kinematics(ur5e, 6, arm)) << "its wrist is offset";
  const auto ik = make_arm_inverse_kinematics(ur5e, 6, arm, {});
  EXPECT_EQ(ik->variables(), arm);
  EXPECT_EQ(make_arm_inverse_kinematics(tx90, palm, {0, 1, 2}, {})->variables().size(), 3U);
  EXPECT_THROW(make_arm_inverse_kinematics(tx90, palm, {7}, {}), InputError);
}

TEST(ReachBall, HoldsEveryPlaceOfTheLinkAndLittleMore) {
  RobotDescription sliding = test::ur5e();
  sliding.joints[2].type = JointType::kPrismatic;
  sliding.joints[2].limits.lower = -0.3;
  sliding.joints[2].limits.upper = 0.2;
  for (const RobotDescription& robot : {test::ur5e(), test::panda_arm(), test::iiwa14(), sliding}) {
    const RobotModel model(robot);
    const int tip = model.link_count() - 1;
    const std::vector<int> arm = chain_variables(model, tip);
    const ReachBall ball = reach_ball(model, tip, arm, model.neutral());
    RandomConfigurations random(model, 36);
    std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
    double farthest = 0.0;
    for (int k = 0; k < 3000; ++k) {
      model.forward_kinematics(random.next(), X_BL);
      EXPECT_TRUE(ball.contains(X_BL.back().translation()));
      farthest = std::max(farthest, (X_BL.back().translation() - ball.centre).norm());
    }
    EXPECT_LT(ball.radius, 1.5 * farthest) << robot.name;
  }
  const auto tx90 = model_of(test::tx90_sah());
  EXPECT_THROW(
      static_cast<void>(reach_ball(*tx90, tx90->find_link("Palm").value(), {7}, tx90->neutral())),
      InputError);
}

TEST(Manipulability, VanishesWhereTheArmIsStretched) {
  const RobotModel model(test::ur5e());
  Configuration q(6);
  q << 0.3, -1.2, 1.4, -0.5, 0.9, 0.2;
  const Jacobian bent = jacobian_at(model, q);
  EXPECT_GT(manipulability(bent), 0.01);
  EXPECT_NEAR(manipulability(bent), std::abs(Eigen::MatrixXd(bent).determinant()), 1e-12);
  q[2] = 0.0;
  EXPECT_NEAR(manipulability(jacobian_at(model, q)), 0.0, 1e-12);
}

TEST(Manipulability, IsTheVolumeOfTheEllipsoidOfFewerJoints) {
  Eigen::MatrixXd J(3, 2);
  J << 2, 0, 0, 3, 0, 0;
  EXPECT_NEAR(manipulability(J), 6.0, 1e-12);
}

TEST(NullSpaceMotion, MovesTheElbowAndLeavesTheTool) {
  const RobotModel model(test::panda_arm());
  RandomConfigurations random(model, 35);
  for (int k = 0; k < 50; ++k) {
    const Jacobian J = jacobian_at(model, random.next());
    const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(7, -1.0, 1.0);
    const Eigen::VectorXd motion = null_space_motion(J, wanted);
    EXPECT_GT(motion.norm(), 1e-3);
    EXPECT_LT((J * motion).norm(), 1e-3 * wanted.norm());
  }
}

TEST(NullSpaceMotion, IsNothingWithoutRedundancy) {
  const RobotModel model(test::ur5e());
  Configuration q(6);
  q << 0.3, -1.2, 1.4, -0.5, 0.9, 0.2;
  const Eigen::VectorXd motion = null_space_motion(jacobian_at(model, q), Eigen::VectorXd::Ones(6));
  EXPECT_LT(motion.norm(), 1e-4);
}

}  // namespace
}  // namespace handway::geometric
