#include "handway/geometric/robot/jacobian.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>

namespace handway::geometric {

Jacobian point_jacobian(const RobotModel& model, std::span<const Pose> X_BL, int link,
                        const Eigen::Vector3d& p_LQ) {
  Jacobian J = Jacobian::Zero(6, model.variable_count());
  const Eigen::Vector3d p_BQ = X_BL[static_cast<std::size_t>(link)] * p_LQ;
  for (int i = link; i > 0; i = model.parent(i)) {
    const RobotModel::MimicMapping& drive = model.mimic_mapping(i);
    if (drive.variable < 0) {
      continue;
    }
    // The joint's own motion does not move its axis, and so the axis is fixed in the child.
    const Pose& X_BC = X_BL[static_cast<std::size_t>(i)];
    const Joint& joint = model.joint(i);
    const Eigen::Vector3d axis_B = drive.multiplier * (X_BC.linear() * joint.axis);
    if (joint.type == JointType::kRevolute) {
      J.col(drive.variable).head<3>() += axis_B.cross(p_BQ - X_BC.translation());
      J.col(drive.variable).tail<3>() += axis_B;
    } else {
      J.col(drive.variable).head<3>() += axis_B;
    }
  }
  return J;
}

Jacobian point_jacobian(const RobotState& state, int link, const Eigen::Vector3d& p_LQ) {
  // The algorithm is independent of the base's pose.
  return point_jacobian(state.model(), state.link_poses(), link, p_LQ);
}

double manipulability(const Eigen::MatrixXd& J) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues().prod();
}

Eigen::VectorXd null_space_motion(const Eigen::MatrixXd& J, const Eigen::VectorXd& wanted,
                                  double damping) {
  Eigen::MatrixXd task = J * J.transpose();
  task.diagonal().array() += damping;
  return wanted - J.transpose() * task.ldlt().solve(J * wanted);
}

}  // namespace handway::geometric
