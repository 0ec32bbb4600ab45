#include "handway/geometric/math/sine_cosine.h"
#include "handway/geometric/robot/robot_model.h"
#include "math/pose_columns.h"
#include "math/vector_units.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace handway::geometric {
namespace {

using Motion = ForwardKinematicsStep::Motion;

/// Number of joints that are treated together: their sines and cosines in one go.
constexpr std::size_t kBlock = 32;

/// Turns a frame about its own axis A, (A, u, v) being right-handed: only the columns u and v of
/// the rotation change.
inline void turn(PoseColumn& u, PoseColumn& v, double s, double c) {
  const PoseColumn before = u;
  u = c * u + s * v;
  v = c * v - s * before;
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

/// Columns of the rotation of X times the 3x3 matrix R.
inline void turn_by(PoseColumns& X, const Eigen::Matrix3d& R) {
  const PoseColumn x = X.x;
  const PoseColumn y = X.y;
  const PoseColumn z = X.z;
  X.x = x * R(0, 0) + y * R(1, 0) + z * R(2, 0);
  X.y = x * R(0, 1) + y * R(1, 1) + z * R(2, 1);
  X.z = x * R(0, 2) + y * R(1, 2) + z * R(2, 2);
}

inline void shift(PoseColumns& X, const Eigen::Vector3d& p) {
  X.p += X.x * p.x() + X.y * p.y() + X.z * p.z();
}

/// Moves the joint frame X by `value`, whose sine and cosine are s and c.
inline void move(PoseColumns& X, const ForwardKinematicsStep& step, double value, double s,
                 double c) {
  switch (step.motion) {
    case Motion::kFixed:
      break;
    case Motion::kTurnX:
      turn(X.y, X.z, s, c);
      break;
    case Motion::kTurnY:
      turn(X.z, X.x, s, c);
      break;
    case Motion::kTurnZ:
      turn(X.x, X.y, s, c);
      break;
    case Motion::kTurnAxis:
      turn_by(X, rotation_about(step.axis, s, c));
      break;
    case Motion::kSlide:
      shift(X, value * step.axis);
      break;
  }
}

HANDWAY_VECTOR_UNITS void move_along_chain(std::span<const ForwardKinematicsStep> steps,
                                           const double* q, Pose* X_BL) {
  std::array<double, kBlock> values;
  std::array<double, kBlock> sines;
  std::array<double, kBlock> cosines;
  for (std::size_t begin = 0; begin < steps.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, steps.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const ForwardKinematicsStep& step = steps[begin + i];
      values[i] = step.variable < 0 ? 0.0 : step.multiplier * q[step.variable] + step.offset;
    }
    sine_cosine(values.data(), count, sines.data(), cosines.data());
    for (std::size_t i = 0; i < count; ++i) {
      const ForwardKinematicsStep& step = steps[begin + i];
      PoseColumns X(X_BL[step.parent]);
      shift(X, step.p_PJ);
      if (step.turned) {
        turn_by(X, step.R_PJ);
      }
      move(X, step, values[i], sines[i], cosines[i]);
      X.store(X_BL[begin + i + 1]);
    }
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
  move_along_chain(steps_, q.data(), X_BL.data());
}

}  // namespace handway::geometric
