#include "handway/geometric/robot/jacobian.h"

#include "handway_test/robots.h"
#include "random_configurations.h"

#include <gtest/gtest.h>

#include <memory>

namespace handway::geometric {
namespace {

using test::RandomConfigurations;

/// The angular velocity behind a small rotation dR = R_after * R_before^T.
Eigen::Vector3d small_rotation(const Eigen::Matrix3d& dR) {
  return 0.5 * Eigen::Vector3d(dR(2, 1) - dR(1, 2), dR(0, 2) - dR(2, 0), dR(1, 0) - dR(0, 1));
}

Jacobian central_differences(RobotState state, int link, const Eigen::Vector3d& p_LQ) {
  constexpr double kStep = 1e-6;
  const Configuration q = state.configuration();
  Jacobian J(6, q.size());
  for (int v = 0; v < q.size(); ++v) {
    Configuration moved = q;
    moved[v] = q[v] + kStep;
    state.set_configuration(moved);
    const Pose after = state.link_pose(link);
    moved[v] = q[v] - kStep;
    state.set_configuration(moved);
    const Pose before = state.link_pose(link);
    J.col(v).head<3>() = (after * p_LQ - before * p_LQ) / (2 * kStep);
    J.col(v).tail<3>() = small_rotation(after.linear() * before.linear().transpose()) / (2 * kStep);
  }
  return J;
}

/// The Jacobian is the derivative of the point's position and of the link's
/// rotation in the world, couplings included, whatever the base pose.
TEST(Jacobian, AgreesWithCentralDifferences) {
  RobotDescription description = test::tx90_sah();
  description.joints[3].type = JointType::kPrismatic;
  for (const RobotDescription& robot : {test::tx90_sah(), test::tx90_dh_style(), description}) {
    const auto model = std::make_shared<const RobotModel>(robot);
    RobotState state(model, pose_from_rpy({1.0, -2.0, 0.5}, 0.3, 0.7, -1.1));
    RandomConfigurations random(*model, 4);
    for (int k = 0; k < 40; ++k) {
      state.set_configuration(random.next());
      const Eigen::Vector3d p_LQ(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2),
                                 random.uniform(-0.2, 0.2));
      for (int link = 0; link < model->link_count(); link += 3) {
        const Jacobian J = point_jacobian(state, link, p_LQ);
        const double error = (J - central_differences(state, link, p_LQ)).cwiseAbs().maxCoeff();
        ASSERT_LT(error, 1e-8) << "link " << model->link(link).name;
      }
    }
  }
}

TEST(Jacobian, InTheBaseFrameIsTheWorldsOneTurnedBack) {
  const auto model = std::make_shared<const RobotModel>(test::tx90_sah());
  const Pose X_WB = pose_from_rpy({1.0, -2.0, 0.5}, 0.3, 0.7, -1.1);
  const RobotState in_world(model, X_WB);
  const RobotState in_base(model);
  const int link = model->find_link("Index-Dist").value();
  const Jacobian J_W = point_jacobian(in_world, link, {0.01, 0.02, 0.03});
  const Jacobian J_B = point_jacobian(*model, in_base.link_poses(), link, {0.01, 0.02, 0.03});
  EXPECT_TRUE(J_W.topRows<3>().isApprox(X_WB.linear() * J_B.topRows<3>(), 1e-12));
  EXPECT_TRUE(J_W.bottomRows<3>().isApprox(X_WB.linear() * J_B.bottomRows<3>(), 1e-12));
}

TEST(Jacobian, OfACoupledFingertipAddsBothJointsToTheLeadersColumn) {
  const auto model = std::make_shared<const RobotModel>(test::tx90_sah());
  const RobotState state(model);
  const int medial = model->find_variable("Mid-Med").value();
  const Jacobian before = point_jacobian(state, model->find_link("Mid-Med").value());
  const Jacobian after = point_jacobian(state, model->find_link("Mid-Dist").value());
  EXPECT_NEAR(before.col(medial).tail<3>().norm(), 1.0, 1e-12);
  EXPECT_NEAR(after.col(medial).tail<3>().norm(), 2.0, 1e-12);
}

TEST(Jacobian, HasZeroColumnsForJointsThatDoNotMoveTheLink) {
  const auto model = std::make_shared<const RobotModel>(test::tx90_sah());
  const RobotState state(model);
  const Jacobian J = point_jacobian(state, model->find_link("Ring-Dist").value());
  EXPECT_TRUE(J.col(model->find_variable("Index-Prox").value()).isZero());
  EXPECT_FALSE(J.col(model->find_variable("joint_1").value()).isZero());
}

}  // namespace
}  // namespace handway::geometric
