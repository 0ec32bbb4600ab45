#include "robot/tx90_geometry.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace handway::geometric {
namespace {

/// How far (m or rad) an axis may miss its place. Wide enough for the rounding
/// of figures in files, narrow enough that the solution error stays below it.
constexpr double kStructureTolerance = 1e-6;

/// A joint axis with all joints at 0, in the base frame.
struct AxisLine {
  Eigen::Vector3d point;
  Eigen::Vector3d direction;
};

class Structure {
 public:
  Structure(const RobotModel& model, const Tx90Chain& chain) : model_(model), chain_(chain) {}

  [[noreturn]] void refuse(int joint, const std::string& found, const std::string& expected) const {
    const std::string& name = model_.joint(chain_.links[static_cast<std::size_t>(joint)]).name;
    throw InputError({"analytic inverse kinematics of " + model_.name(), "joint " + name, found,
                      expected, "Use the numeric inverse kinematics for this arm"});
  }

  void need_square(const std::array<AxisLine, 6>& axes, int joint, int other) const {
    const double cosine = direction(axes, joint).dot(direction(axes, other));
    if (std::abs(cosine) > kStructureTolerance) {
      refuse(joint,
             fmt::format("an axis {:.6g} degrees off the square to axis {}",
                         std::asin(std::clamp(cosine, -1.0, 1.0)) * 180.0 / M_PI, other + 1),
             "a right angle");
    }
  }

  void need_parallel(const std::array<AxisLine, 6>& axes, int joint, int other) const {
    const double sine = direction(axes, joint).cross(direction(axes, other)).norm();
    if (sine > kStructureTolerance) {
      refuse(joint, fmt::format("an axis at an angle to axis {} (sine {:.6g})", other + 1, sine),
             "parallel axes");
    }
  }

  void need_through(const AxisLine& axis, int joint, const Eigen::Vector3d& p_BW) const {
    const double distance = axis.direction.cross(p_BW - axis.point).norm();
    if (distance > kStructureTolerance) {
      refuse(joint, fmt::format("an axis {:.6g} mm off the wrist centre", distance * 1e3),
             "axes 4, 5 and 6 that meet in one point");
    }
  }

  void need_length(double length, int joint) const {
    if (length < kStructureTolerance) {
      refuse(joint, "a link without length", "an upper arm and a forearm");
    }
  }

 private:
  static const Eigen::Vector3d& direction(const std::array<AxisLine, 6>& axes, int joint) {
    return axes[static_cast<std::size_t>(joint)].direction;
  }

  const RobotModel& model_;
  const Tx90Chain& chain_;
};

/// The point of line a that is nearest to line b. @pre They are not parallel.
Eigen::Vector3d nearest_point(const AxisLine& a, const AxisLine& b) {
  const Eigen::Vector3d normal = a.direction.cross(b.direction);
  const double along = (b.point - a.point).cross(b.direction).dot(normal) / normal.squaredNorm();
  return a.point + along * a.direction;
}

/// Angle about y from z to the vector's projection in the plane y = 0.
double angle_about_y(const Eigen::Vector3d& v) { return std::atan2(v.x(), v.z()); }

}  // namespace

Tx90Chain tx90_chain(const RobotModel& model, int tip_link) {
  const auto refuse = [&](const std::string& element, const std::string& found,
                          const std::string& expected) {
    throw InputError({"analytic inverse kinematics of " + model.name(), element, found, expected,
                      "Use the numeric inverse kinematics for this chain"});
  };
  std::vector<int> links;
  for (int i = tip_link; i > 0; i = model.parent(i)) {
    const Joint& joint = model.joint(i);
    if (joint.type == JointType::kFixed) {
      continue;
    }
    if (joint.type != JointType::kRevolute) {
      refuse("joint " + joint.name, "a sliding joint", "six revolute joints");
    }
    if (joint.mimic) {
      refuse("joint " + joint.name, "a coupled joint", "joints that move on their own");
    }
    links.push_back(i);
  }
  if (links.size() != 6) {
    refuse("link " + model.link(tip_link).name, fmt::format("{} moving joints", links.size()),
           "six between the root and the tip link");
  }
  Tx90Chain chain;
  for (std::size_t k = 0; k < 6; ++k) {
    chain.links[k] = links[5 - k];
    chain.variables[k] = model.drive(links[5 - k]).variable;
  }
  return chain;
}

Tx90Geometry tx90_geometry(const RobotModel& model, const Tx90Chain& chain, int tip_link) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(Configuration::Zero(model.variable_count()), X_BL);
  std::array<AxisLine, 6> axes;
  for (std::size_t k = 0; k < 6; ++k) {
    const Pose& X = X_BL[static_cast<std::size_t>(chain.links[k])];
    axes[k] = {X.translation(), X.linear() * model.joint(chain.links[k]).axis};
  }
  const Structure structure(model, chain);
  structure.need_square(axes, 1, 0);
  structure.need_parallel(axes, 2, 1);
  structure.need_square(axes, 4, 3);
  structure.need_square(axes, 5, 4);
  const Eigen::Vector3d p_BW = nearest_point(axes[3], axes[4]);
  structure.need_through(axes[4], 4, p_BW);
  structure.need_through(axes[5], 5, p_BW);

  Tx90Geometry geometry;
  Eigen::Matrix3d R_BC;
  R_BC.col(2) = axes[0].direction;
  R_BC.col(1) = (axes[1].direction - axes[1].direction.dot(R_BC.col(2)) * R_BC.col(2)).normalized();
  R_BC.col(0) = R_BC.col(1).cross(R_BC.col(2));
  geometry.X_BC.linear() = R_BC;
  geometry.X_BC.translation() =
      axes[0].point + axes[0].direction.dot(axes[1].point - axes[0].point) * axes[0].direction;

  const Pose X_CB = geometry.X_BC.inverse();
  const Eigen::Vector3d p_CS = X_CB * axes[1].point;
  const Eigen::Vector3d p_CE = X_CB * axes[2].point;
  const Eigen::Vector3d p_CW = X_CB * p_BW;
  geometry.shoulder_offset = p_CS.x();
  geometry.lateral_offset = p_CW.y();
  geometry.upper_arm = std::hypot(p_CE.x() - p_CS.x(), p_CE.z() - p_CS.z());
  geometry.forearm = std::hypot(p_CW.x() - p_CE.x(), p_CW.z() - p_CE.z());
  structure.need_length(geometry.upper_arm, 2);
  structure.need_length(geometry.forearm, 3);
  geometry.upper_arm_angle = angle_about_y(p_CE - p_CS);
  geometry.bend = angle_about_y(p_CW - p_CE) - geometry.upper_arm_angle;
  geometry.elbow_sign = axes[2].direction.dot(axes[1].direction) > 0.0 ? 1.0 : -1.0;

  geometry.R_CF.col(2) = R_BC.transpose() * axes[3].direction;
  geometry.R_CF.col(1) = R_BC.transpose() * axes[4].direction;
  geometry.R_CF.col(0) = geometry.R_CF.col(1).cross(geometry.R_CF.col(2));
  geometry.wrist_bend =
      angle_about_y(geometry.R_CF.transpose() * (R_BC.transpose() * axes[5].direction));
  const Pose& X_BT = X_BL[static_cast<std::size_t>(tip_link)];
  geometry.R_CT = R_BC.transpose() * X_BT.linear();
  geometry.p_TW = X_BT.inverse() * p_BW;
  return geometry;
}

}  // namespace handway::geometric
