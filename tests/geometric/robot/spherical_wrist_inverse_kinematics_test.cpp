#include "handway/geometric/robot/spherical_wrist_inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway_test/robots.h"
#include "random_configurations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <set>
#include <vector>

namespace handway::geometric {
namespace {

using test::RandomConfigurations;
using ::testing::HasSubstr;

using Shoulder = ArmBranch::Shoulder;
using Bend = ArmBranch::Bend;

constexpr double kFullTurn = 2 * std::numbers::pi;

/// A solver with what is needed to check it.
struct Arm {
  Arm(const RobotDescription& description, const std::string& tip, Tx90IkOptions options = {})
      : model(std::make_shared<const RobotModel>(description)),
        ik(make_spherical_wrist_inverse_kinematics(model, tip, options)),
        X_BL(static_cast<std::size_t>(model->link_count())) {}

  const Pose& tip_pose(const Configuration& q) {
    model->forward_kinematics(q, X_BL);
    return X_BL[static_cast<std::size_t>(ik->tip_link())];
  }

  Configuration degrees(std::vector<double> joints) const {
    Configuration q = model->neutral();
    for (std::size_t k = 0; k < joints.size(); ++k) {
      q[static_cast<Eigen::Index>(k)] = radians(joints[k]);
    }
    return q;
  }

  /// Largest of the differences in position (m) and rotation (rad).
  double miss(const IkSolution& solution, const Configuration& reference, const Pose& X_BT) {
    const Pose X = tip_pose(ik->placed(solution, reference));
    const double turn = (X.linear() - X_BT.linear()).norm() / std::numbers::sqrt2;
    return std::max((X.translation() - X_BT.translation()).norm(), turn);
  }

  std::shared_ptr<const RobotModel> model;
  std::unique_ptr<SphericalWristInverseKinematics> ik;
  std::vector<Pose> X_BL;
};

double largest_difference_up_to_turns(const Configuration& a, const Configuration& b) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    largest = std::max(largest, std::abs(std::remainder(a[k] - b[k], kFullTurn)));
  }
  return largest;
}

/// Returns by how much joints may be off because the pose hardly depends on them: the rounding of
/// the pose over the smallest sine of the arm's bends.
double joint_tolerance(const Configuration& q) {
  const double reach = 0.05 + 0.425 * std::sin(q[1]) + 0.425 * std::sin(q[1] + q[2]);
  const double bend =
      std::min({std::abs(std::sin(q[4])), std::abs(std::sin(q[2])), std::abs(reach)});
  return 1e-9 + 1e-14 / std::max(bend, 1e-9);
}

void expect_round_trip(const RobotDescription& description, const std::string& tip, int count,
                       std::uint64_t seed) {
  Arm arm(description, tip);
  RandomConfigurations random(*arm.model, seed);
  for (int k = 0; k < count; ++k) {
    const Configuration q = random.next();
    const Configuration reference = random.next();
    const Pose X_BT = arm.tip_pose(q);
    const IkResult result = arm.ik->solve(X_BT, reference);
    ASSERT_FALSE(result.solutions.empty()) << result.reason << "\nq = " << q.transpose();
    ASSERT_LE(result.solutions.size(), 8u);
    const Configuration original = q(arm.ik->variables());
    const IkSolution* found = nullptr;
    for (const IkSolution& solution : result.solutions) {
      ASSERT_LT(arm.miss(solution, reference, X_BT), 1e-9) << q.transpose();
      if (largest_difference_up_to_turns(solution.q, original) < joint_tolerance(q)) {
        found = &solution;
      }
    }
    ASSERT_NE(found, nullptr) << "q = " << original.transpose();
    ASSERT_EQ(found->branch, arm.ik->branch_of(q)) << "q = " << original.transpose();
  }
}

TEST(SphericalWristInverseKinematics, FindsARandomPostureAgainForEveryTip) {
  expect_round_trip(test::tx90_urdf_style(), "link_6", 40000, 10);
  expect_round_trip(test::tx90_urdf_style(), "flange", 10000, 11);
  expect_round_trip(test::tx90_dh_style(), "Tcp", 40000, 12);
  expect_round_trip(test::tx90_sah(), "Palm", 10000, 13);
}

TEST(SphericalWristInverseKinematics, ServesATipTurnedAndShiftedAgainstTheFlange) {
  RobotDescription robot = test::tx90_urdf_style();
  robot.joints.back().X_PJ = pose_from_rpy({0.02, -0.13, 0.21}, 0.4, -0.9, 2.0);
  expect_round_trip(robot, "flange", 10000, 14);
}

/// The arm is on a tilted pedestal, with lengths of its own, an elbow that is bent at zero, axis 3
/// the other way round and a wrist that is bent at zero.
TEST(SphericalWristInverseKinematics, ReadsTheLengthsAndZerosFromTheModel) {
  RobotDescription robot = test::tx90_urdf_style();
  robot.joints[0].X_PJ = pose_from_rpy({0.3, -0.2, 0.4}, 0.2, -0.3, 1.0);
  robot.joints[1].X_PJ.translation() = Eigen::Vector3d(0.07, 0.0, 0.02);
  robot.joints[2].X_PJ = pose_from_rpy({0.1, 0.03, 0.5}, 0.0, 0.3, 0.0);
  robot.joints[2].axis = -Eigen::Vector3d::UnitY();
  robot.joints[3].X_PJ.translation() = Eigen::Vector3d(0.04, 0.01, 0.1);
  robot.joints[4].X_PJ = pose_from_rpy({0.0, 0.0, 0.3}, 0.0, 0.0, 0.2);
  robot.joints[5].X_PJ = pose_from_rpy({0.03, 0.0, 0.1}, 0.0, 0.0, 0.0);
  robot.joints[5].axis = Eigen::Vector3d(0.3, 0.0, 1.0).normalized();
  Arm arm(robot, "flange", {.respect_limits = true, .full_turn_alternates = false});
  RandomConfigurations random(*arm.model, 15);
  for (int k = 0; k < 10000; ++k) {
    const Configuration q = random.next();
    const Pose X_BT = arm.tip_pose(q);
    double nearest = kFullTurn;
    for (const IkSolution& solution : arm.ik->solve(X_BT, q).solutions) {
      ASSERT_LT(arm.miss(solution, q, X_BT), 1e-9);
      nearest = std::min(nearest, largest_difference_up_to_turns(solution.q, q));
      ASSERT_EQ(*solution.branch, arm.ik->branch_of(solution.q));
    }
    ASSERT_LT(nearest, 1e-6) << q.transpose();
  }
}

TEST(SphericalWristInverseKinematics, FindsEightBranchesInTheMiddleOfTheWorkspace) {
  Arm arm(test::tx90_urdf_style(), "flange", {.respect_limits = false});
  const Configuration q = arm.degrees({20, 20, 70, 30, 40, 50});
  const IkResult result = arm.ik->solve(arm.tip_pose(q), q);
  ASSERT_EQ(result.solutions.size(), 8u);
  std::set<ArmBranch> branches;
  for (const IkSolution& solution : result.solutions) {
    branches.insert(*solution.branch);
    EXPECT_EQ(*solution.branch, arm.ik->branch_of(solution.q));
  }
  EXPECT_EQ(branches.size(), 8u);
  EXPECT_LT((result.solutions.front().q - q).norm(), 1e-9);
}

TEST(SphericalWristInverseKinematics, NamesTheBranchAsTheController) {
  Arm arm(test::tx90_urdf_style(), "flange");
  EXPECT_EQ(arm.ik->branch_of(arm.degrees({0, 40, 30, 0, 20, 0})),
            (ArmBranch{Shoulder::kLefty, Bend::kPositive, Bend::kPositive}));
  EXPECT_EQ(arm.ik->branch_of(arm.degrees({0, -60, -30, 0, -20, 0})),
            (ArmBranch{Shoulder::kRighty, Bend::kNegative, Bend::kNegative}));
}

TEST(SphericalWristInverseKinematics, ListsFullTurnsWithinTheLimits) {
  Arm arm(test::tx90_urdf_style(), "flange", {.full_turn_alternates = true});
  const Configuration q = arm.degrees({20, 20, 70, -150, 40, 200});
  const Pose X_BT = arm.tip_pose(q);
  const IkResult result = arm.ik->solve(X_BT, q);
  int same_branch = 0;
  for (const IkSolution& solution : result.solutions) {
    EXPECT_LT(arm.miss(solution, q, X_BT), 1e-9);
    EXPECT_TRUE((solution.q - arm.model->lower()).minCoeff() >= 0.0);
    EXPECT_TRUE((arm.model->upper() - solution.q).minCoeff() >= 0.0);
    same_branch += *solution.branch == arm.ik->branch_of(q) ? 1 : 0;
  }
  EXPECT_EQ(same_branch, 4);  // -150 or 210 for joint 4, -160 or 200 for joint 6
  EXPECT_LT((result.solutions.front().q - q).norm(), 1e-9);
}

TEST(SphericalWristInverseKinematics, TakesTheTurnNearestToTheReference) {
  Arm arm(test::tx90_urdf_style(), "flange");
  const Configuration q = arm.degrees({20, 20, 70, -150, 40, 200});
  const IkResult result = arm.ik->solve(arm.tip_pose(q), arm.degrees({20, 20, 70, 190, 40, 190}));
  EXPECT_NEAR(result.solutions.front().q[3], radians(210), 1e-9);
  EXPECT_NEAR(result.solutions.front().q[5], radians(200), 1e-9);
}

TEST(SphericalWristInverseKinematics, KeepsJointFourWhereTheWristIsStraight) {
  Arm arm(test::tx90_urdf_style(), "flange");
  for (const double bend : {0.0, 1e-14, 1e-12}) {
    Configuration q = arm.degrees({20, 20, 70, 33, 0, 44});
    q[4] = bend;
    const Pose X_BT = arm.tip_pose(q);
    const IkResult result = arm.ik->solve(X_BT, q);
    ASSERT_FALSE(result.solutions.empty());
    EXPECT_LT((result.solutions.front().q - q).norm(), 1e-9);

    const Configuration other = arm.degrees({20, 20, 70, -100, 5, 0});
    const IkResult moved = arm.ik->solve(X_BT, other);
    EXPECT_NEAR(moved.solutions.front().q[3], radians(-100), 1e-12);
    EXPECT_LT(arm.miss(moved.solutions.front(), other, X_BT), 1e-9);
  }
}

/// Near a singularity the pose fixes some joints badly, but the posture found
/// must still reach it.
TEST(SphericalWristInverseKinematics, ReachesPosesCloseToEverySingularity) {
  Arm arm(test::tx90_urdf_style(), "flange");
  RandomConfigurations random(*arm.model, 16);
  for (int k = 0; k < 20000; ++k) {
    Configuration q = random.next();
    const double tiny = std::pow(10.0, random.uniform(-16.0, -3.0));
    q[4] = k % 2 == 0 ? tiny : q[4];
    q[2] = k % 3 == 0 ? tiny : q[2];
    if (k % 5 == 0) {
      q[1] = tiny;  // Wrist centre right above the border of lefty and righty …
      q[2] = -2.0 * std::asin(0.05 / 0.85) + tiny;
    }
    const Pose X_BT = arm.tip_pose(q);
    const IkResult result = arm.ik->solve(X_BT, q);
    ASSERT_FALSE(result.solutions.empty()) << result.reason << "\nq = " << q.transpose();
    double nearest = kFullTurn;
    for (const IkSolution& solution : result.solutions) {
      ASSERT_LT(arm.miss(solution, q, X_BT), 1e-9) << q.transpose();
      nearest = std::min(nearest, (solution.q - q).head(3).norm());
    }
    ASSERT_LT(nearest, 1e-2) << q.transpose();
  }
}

TEST(SphericalWristInverseKinematics, KeepsJointOneWhereTheWristIsOnTheShoulderAxis) {
  RobotDescription robot = test::tx90_urdf_style();
  robot.joints[2].X_PJ.translation().y() = 0.0;  // No lateral offset.
  Arm arm(robot, "flange");
  Configuration q = arm.degrees({75, 0, 0, 10, 20, 30});
  q[1] = radians(-30);
  q[2] = std::asin((-0.05 - 0.425 * std::sin(q[1])) / 0.425) - q[1];
  const Pose X_BT = arm.tip_pose(q);
  const IkResult result = arm.ik->solve(X_BT, q);
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_LT((result.solutions.front().q - q).norm(), 1e-7);
  for (const IkSolution& solution : result.solutions) {
    EXPECT_NEAR(solution.q[0], q[0], 1e-12);
    EXPECT_LT(arm.miss(solution, q, X_BT), 1e-9);
  }
}

TEST(SphericalWristInverseKinematics, SaysWhyAPoseIsOutOfReach) {
  Arm arm(test::tx90_urdf_style(), "flange");
  const Configuration q = arm.model->neutral();
  Pose X_BT = pose_from_rpy({2.0, 0.0, 1.0}, 0, 0, 0);
  const IkResult far = arm.ik->solve(X_BT, q);
  EXPECT_TRUE(far.solutions.empty());
  EXPECT_THAT(far.reason, HasSubstr("reaches 0.0 to 850.0 mm"));

  X_BT.translation() = Eigen::Vector3d(0.01, 0.0, 1.0);
  EXPECT_THAT(arm.ik->solve(X_BT, q).reason, HasSubstr("50.0 mm"));

  // The flange against the forearm: joint 5 would have to fold back.
  RobotDescription stiff = test::tx90_urdf_style();
  stiff.joints[4].limits.lower = -0.1;
  stiff.joints[4].limits.upper = 0.1;
  Arm limited(stiff, "flange");
  const IkResult result = limited.ik->solve(arm.tip_pose(arm.degrees({20, 20, 70, 30, 40, 50})), q);
  EXPECT_TRUE(result.solutions.empty());
  EXPECT_THAT(result.reason, HasSubstr("joint joint_5"));
}

TEST(SphericalWristInverseKinematics, RefusesArmsOfAnotherBuildAndSaysWhere) {
  const auto refusal = [](const RobotDescription& robot, const std::string& tip) -> std::string {
    try {
      (void)make_spherical_wrist_inverse_kinematics(std::make_shared<const RobotModel>(robot), tip);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  RobotDescription robot = test::tx90_urdf_style();
  robot.joints[1].axis = Eigen::Vector3d(0, 0.8, 0.6);
  EXPECT_THAT(refusal(robot, "flange"), HasSubstr("joint_2"));

  robot = test::tx90_urdf_style();
  robot.joints[2].axis = Eigen::Vector3d(0.6, 0.8, 0);
  EXPECT_THAT(refusal(robot, "flange"), HasSubstr("parallel"));

  robot = test::tx90_urdf_style();
  robot.joints[5].X_PJ.translation().x() = 0.01;
  EXPECT_THAT(refusal(robot, "flange"), HasSubstr("joint joint_6: found an axis 10 mm off"));

  EXPECT_THAT(refusal(test::tx90_sah(), "Index-Dist"),
              HasSubstr("joint Index-Dist: found a coupled joint"));
  EXPECT_THAT(refusal(test::tx90_sah(), "link_5"), HasSubstr("found 5 moving joints"));
  EXPECT_THAT(refusal(test::tx90_sah(), "hook"), HasSubstr("no link of this name"));
}

TEST(SphericalWristInverseKinematics, RefusesWhatIsNoPoseOrReference) {
  Arm arm(test::tx90_urdf_style(), "flange");
  const Configuration q = arm.model->neutral();
  EXPECT_THROW((void)arm.ik->solve(Pose::Identity(), Configuration::Zero(5)), InputError);
  Pose X = Pose::Identity();
  X.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)arm.ik->solve(X, q), InputError);
  X = Pose::Identity();
  X.linear() *= 1.1;
  EXPECT_THROW((void)arm.ik->solve(X, q), InputError);
}

}  // namespace
}  // namespace handway::geometric
