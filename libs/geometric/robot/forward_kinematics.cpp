#include "handway/geometric/math/sine_cosine.h"
#include "handway/geometric/robot/forward_kinematics_step.h"
#include "handway/geometric/robot/robot_model.h"

#include <algorithm>
#include <array>

namespace handway::geometric {
namespace {

using Motion = ForwardKinematicsStep::Motion;

/// How many joints are treated together: their sines and cosines in one go.
constexpr std::size_t kBlock = 32;

/// Turns the frame X about its own axis A, (A, U, V) being right-handed: only
/// the columns U and V of the rotation change.
template <int U, int V>
void turn(Eigen::Matrix4d& X, double s, double c) {
  const Eigen::Vector4d u = X.col(U);
  const Eigen::Vector4d v = X.col(V);
  X.col(U) = c * u + s * v;
  X.col(V) = c * v - s * u;
}

/// Rodrigues' formula, written out.
Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double s, double c) {
  const Eigen::Vector3d a = (1.0 - c) * axis;
  const Eigen::Vector3d b = s * axis;
  Eigen::Matrix3d R;
  R << a.x() * axis.x() + c, a.x() * axis.y() - b.z(), a.x() * axis.z() + b.y(),
      a.x() * axis.y() + b.z(), a.y() * axis.y() + c, a.y() * axis.z() - b.x(),
      a.x() * axis.z() - b.y(), a.y() * axis.z() + b.x(), a.z() * axis.z() + c;
  return R;
}

/// Columns of the rotation of X times the 3x3 matrix R, the last row staying 0.
void turn_by(Eigen::Matrix4d& X, const Eigen::Matrix3d& R) {
  const Eigen::Vector4d x = X.col(0);
  const Eigen::Vector4d y = X.col(1);
  const Eigen::Vector4d z = X.col(2);
  for (int k = 0; k < 3; ++k) {
    X.col(k) = x * R(0, k) + y * R(1, k) + z * R(2, k);
  }
}

void shift(Eigen::Matrix4d& X, const Eigen::Vector3d& p) {
  X.col(3) += X.col(0) * p.x() + X.col(1) * p.y() + X.col(2) * p.z();
}

/// Moves the joint frame X by `value`, whose sine and cosine are s and c.
void move(Eigen::Matrix4d& X, const ForwardKinematicsStep& step, double value, double s, double c) {
  switch (step.motion) {
    case Motion::kFixed:
      break;
    case Motion::kTurnX:
      turn<1, 2>(X, s, c);
      break;
    case Motion::kTurnY:
      turn<2, 0>(X, s, c);
      break;
    case Motion::kTurnZ:
      turn<0, 1>(X, s, c);
      break;
    case Motion::kTurnAxis:
      turn_by(X, rotation_about(step.axis, s, c));
      break;
    case Motion::kSlide:
      shift(X, value * step.axis);
      break;
  }
}

}  // namespace

ForwardKinematicsStep forward_kinematics_step(const Joint& joint, int parent, int variable,
                                              double multiplier, double offset) {
  ForwardKinematicsStep step;
  step.parent = parent;
  step.variable = variable;
  step.multiplier = multiplier;
  step.offset = offset;
  step.R_PJ = joint.X_PJ.linear();
  step.p_PJ = joint.X_PJ.translation();
  step.turned = step.R_PJ != Eigen::Matrix3d::Identity();
  step.axis = joint.axis;
  if (joint.type == JointType::kPrismatic) {
    step.motion = Motion::kSlide;
  } else if (joint.type == JointType::kRevolute) {
    step.motion = Motion::kTurnAxis;
    constexpr Motion kPrincipal[] = {Motion::kTurnX, Motion::kTurnY, Motion::kTurnZ};
    for (int k = 0; k < 3; ++k) {
      if (joint.axis == Eigen::Vector3d::Unit(k) || joint.axis == -Eigen::Vector3d::Unit(k)) {
        step.motion = kPrincipal[k];
        step.multiplier *= joint.axis[k];
        step.offset *= joint.axis[k];
      }
    }
  }
  return step;
}

void RobotModel::forward_kinematics(const Configuration& q, std::span<Pose> X_BL) const {
  X_BL[0] = Pose::Identity();
  std::array<double, kBlock> values;
  std::array<double, kBlock> sines;
  std::array<double, kBlock> cosines;
  for (std::size_t begin = 0; begin < steps_.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, steps_.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const ForwardKinematicsStep& step = steps_[begin + i];
      values[i] = step.variable < 0 ? 0.0 : step.multiplier * q[step.variable] + step.offset;
    }
    sine_cosine(values.data(), count, sines.data(), cosines.data());
    for (std::size_t i = 0; i < count; ++i) {
      const ForwardKinematicsStep& step = steps_[begin + i];
      Eigen::Matrix4d& X = X_BL[begin + i + 1].matrix();
      X = X_BL[static_cast<std::size_t>(step.parent)].matrix();
      shift(X, step.p_PJ);
      if (step.turned) {
        turn_by(X, step.R_PJ);
      }
      move(X, step, values[i], sines[i], cosines[i]);
    }
  }
}

}  // namespace handway::geometric
