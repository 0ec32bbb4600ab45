#include "handway/geometric/robot/spherical_wrist_inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

/// The lengths and directions of an arm built like the TX90, from its joint axes with all joints
/// at 0, independent of the file's link frames: axis 2 perpendicular to axis 1, axis 3 parallel
/// to axis 2, axes 4, 5 and 6 meeting in the wrist centre W, axis 5 perpendicular to axes 4 and
/// 6.
///
/// Frame C has its origin on axis 1 at the height of axis 2, z along axis 1 and
/// y along axis 2. In it the arm moves in a plane y = const, turned about z.
struct Tx90Geometry {
  Pose X_BC = Pose::Identity();
  double shoulder_offset = 0.0;  ///< x of axis 2 in C, m (TX90: 0.05).
  double lateral_offset = 0.0;   ///< y of the wrist centre in C, m (TX90: 0.05).
  double upper_arm = 0.0;        ///< From axis 2 to axis 3, m (TX90: 0.425).
  double forearm = 0.0;          ///< From axis 3 to the wrist centre, m (TX90: 0.425).
  double upper_arm_angle = 0.0;  ///< Angle about y from z to the upper arm at zero, rad.
  double bend = 0.0;             ///< Angle about y from the upper arm to the forearm at zero.
  double elbow_sign = 1.0;       ///< -1 if axis 3 points against axis 2.
  /// Wrist frame at zero: z along axis 4, y along axis 5.
  Eigen::Matrix3d R_CF = Eigen::Matrix3d::Identity();
  double wrist_bend = 0.0;  ///< Angle about axis 5 from axis 4 to axis 6 at zero, rad.
  Eigen::Matrix3d R_CT = Eigen::Matrix3d::Identity();  ///< The tip's rotation at zero.
  Eigen::Vector3d p_TW = Eigen::Vector3d::Zero();      ///< The wrist centre in the tip's frame.
};

/// The six joints between root and tip, from the base on.
struct Tx90Chain {
  std::array<int, 6> links;      ///< The link that each joint carries.
  std::array<int, 6> variables;  ///< The model's variable of each joint.
};

/// Tolerance (m or rad) of an axis's place. Wide enough for the rounding of figures in files,
/// narrow enough that the solution error stays below it.
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
             fmt::format("an axis {:.6g} degrees from perpendicular to axis {}",
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

/// @throws InputError unless exactly six revolute joints, all independent, are on the chain from
/// the root to `tip_link`.
Tx90Chain tx90_chain(const RobotModel& model, int tip_link) {
  const auto refuse = [&](const std::string& element, const std::string& found,
                          const std::string& expected) {
    throw InputError({"analytic inverse kinematics of " + model.name(), element, found, expected,
                      "Use the numeric inverse kinematics for this chain"});
  };
  LinkIndices links;
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
    chain.variables[k] = model.mimic_mapping(links[5 - k]).variable;
  }
  return chain;
}

/// @throws InputError naming the joint that does not fit the structure above.
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

/// Values of the arm's six joints from the base on, rad.
using Tx90Joints = std::array<double, 6>;

/// One posture that reaches a pose. Joints are up to full turns, regardless of
/// limits.
struct Tx90Posture {
  Tx90Joints q;
  ArmBranch branch;
};

struct Tx90Postures {
  std::array<Tx90Posture, 8> list;  ///< The first `count` are filled.
  int count = 0;
  std::string reason;  ///< Reason of a failure.
};

using Shoulder = ArmBranch::Shoulder;
using Bend = ArmBranch::Bend;

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
/// Rounding, in metres, that may put a pose at the border of reach outside it.
constexpr double kReachTolerance = 1e-11;
/// Sine of the wrist's bend below which axes 4 and 6 count as in line.
constexpr double kWristSingularity = 1e-10;
/// Lengths (m) below which a direction counts as undefined.
constexpr double kNoDirection = 1e-9;
/// Branches nearer than this (rad) in every joint are merged.
constexpr double kSameJoint = 1e-9;

bool same_posture(const Tx90Joints& a, const Tx90Joints& b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::abs(std::remainder(a[k] - b[k], kWholeTurn)) > kSameJoint) {
      return false;
    }
  }
  return true;
}

/// Target of the wrist centre in the arm's plane, relative to axis 2.
struct PlanarTarget {
  double q1;
  double x, z;  ///< m
  Shoulder shoulder;
};

class Search {
 public:
  Search(const Tx90Geometry& geometry, const Pose& X_BT, const Tx90Joints& reference)
      : g_(geometry), reference_(reference) {
    p_CW_ = g_.X_BC.inverse() * (X_BT * g_.p_TW);
    // Rotation of the tip from its pose at zero, in C.
    R_turn_ = g_.X_BC.linear().transpose() * X_BT.linear() * g_.R_CT.transpose();
  }

  Tx90Postures solve() {
    try_shoulders();
    return std::move(found_);
  }

 private:
  void try_shoulders() {
    const double r = std::hypot(p_CW_.x(), p_CW_.y());
    const double d = g_.lateral_offset;
    if (r < std::abs(d) - kReachTolerance) {
      found_.reason = fmt::format(
          "the wrist centre is {:.1f} mm from axis 1, nearer than the {:.1f} mm that the arm "
          "stands beside it",
          r * 1e3, std::abs(d) * 1e3);
      return;
    }
    const double reach = std::sqrt(std::max(0.0, (r - d) * (r + d)));
    for (const Shoulder shoulder : {Shoulder::kLefty, Shoulder::kRighty}) {
      const double x = shoulder == Shoulder::kLefty ? reach : -reach;
      const double q1 =
          r < kNoDirection ? reference_[0] : std::atan2(p_CW_.y(), p_CW_.x()) - std::atan2(d, x);
      try_elbows({q1, x - g_.shoulder_offset, p_CW_.z(), shoulder});
    }
  }

  void try_elbows(const PlanarTarget& target) {
    const double distance = std::hypot(target.x, target.z);
    const double longest = g_.upper_arm + g_.forearm;
    const double shortest = std::abs(g_.upper_arm - g_.forearm);
    if (distance > longest + kReachTolerance || distance < shortest - kReachTolerance) {
      // The message of the lefty shoulder, in front, is the more useful one.
      if (found_.reason.empty()) {
        found_.reason = fmt::format(
            "the wrist centre is {:.1f} mm from axis 2; the arm reaches {:.1f} to {:.1f} mm",
            distance * 1e3, shortest * 1e3, longest * 1e3);
      }
      return;
    }
    // Half-angle form of the law of cosines: exact near the stretched arm too.
    const double far = std::max(0.0, (longest - distance) * (longest + distance));
    const double near = std::max(0.0, (distance - shortest) * (distance + shortest));
    const double bend = 2.0 * std::atan2(std::sqrt(far), std::sqrt(near));
    for (const Bend elbow : {Bend::kPositive, Bend::kNegative}) {
      const double signed_bend = elbow == Bend::kPositive ? bend : -bend;
      const double q3 = g_.elbow_sign * (signed_bend - g_.bend);
      const double x = g_.forearm * std::sin(signed_bend);
      const double z = g_.upper_arm + g_.forearm * std::cos(signed_bend);
      const double q2 = distance < kNoDirection ? reference_[1]
                                                : std::atan2(target.x, target.z) -
                                                      std::atan2(x, z) - g_.upper_arm_angle;
      try_wrists({target.q1, q2, q3, 0, 0, 0}, {target.shoulder, elbow, Bend::kPositive});
    }
  }

  void try_wrists(Tx90Joints q, ArmBranch branch) {
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
    const Eigen::Matrix3d R_C123 =
        (Eigen::AngleAxisd(q[0], z) * Eigen::AngleAxisd(q[1] + g_.elbow_sign * q[2], y))
            .toRotationMatrix();
    // Rz(q4) Ry(q5 + wrist_bend) Rz(q6), in the wrist frame at zero.
    const Eigen::Matrix3d M = g_.R_CF.transpose() * R_C123.transpose() * R_turn_ * g_.R_CF *
                              Eigen::AngleAxisd(g_.wrist_bend, y).toRotationMatrix();
    const bool in_line = std::hypot(M(0, 2), M(1, 2)) < kWristSingularity;
    const double q4 = in_line ? reference_[3] : std::atan2(M(1, 2), M(0, 2));
    for (const Bend wrist : {Bend::kPositive, Bend::kNegative}) {
      q[3] = wrist == Bend::kPositive ? q4 : q4 + std::numbers::pi;
      const Eigen::Matrix3d N = Eigen::AngleAxisd(-q[3], z).toRotationMatrix() * M;
      q[4] = std::atan2(N(0, 2), N(2, 2)) - g_.wrist_bend;
      q[5] = std::atan2(N(1, 0), N(1, 1));
      branch.wrist = wrist;
      add(q, branch);
      if (in_line) {
        return;
      }
    }
  }

  void add(const Tx90Joints& q, const ArmBranch& branch) {
    for (int i = 0; i < found_.count; ++i) {
      if (same_posture(found_.list[static_cast<std::size_t>(i)].q, q)) {
        return;
      }
    }
    found_.list[static_cast<std::size_t>(found_.count++)] = {q, branch};
  }

  const Tx90Geometry& g_;
  const Tx90Joints& reference_;
  Eigen::Vector3d p_CW_;
  Eigen::Matrix3d R_turn_;
  Tx90Postures found_;
};

/// All postures that bring the tip to X_BT (in the base frame).
/// @param reference values of joints that the pose leaves free.
Tx90Postures tx90_postures(const Tx90Geometry& geometry, const Pose& X_BT,
                           const Tx90Joints& reference) {
  return Search(geometry, X_BT, reference).solve();
}

ArmBranch tx90_branch(const Tx90Geometry& geometry, const Tx90Joints& q) {
  const double bend = geometry.bend + geometry.elbow_sign * q[2];
  const double upper = geometry.upper_arm_angle + q[1];
  const double x = geometry.shoulder_offset + geometry.upper_arm * std::sin(upper) +
                   geometry.forearm * std::sin(upper + bend);
  const auto sign = [](double angle) {
    return std::remainder(angle, kWholeTurn) >= 0.0 ? Bend::kPositive : Bend::kNegative;
  };
  return {x >= 0.0 ? Shoulder::kLefty : Shoulder::kRighty, sign(bend),
          sign(q[4] + geometry.wrist_bend)};
}

constexpr double kFullTurn = 2.0 * std::numbers::pi;
/// Rounding, in rad, that may put a joint beyond its limit.
constexpr double kLimitTolerance = 1e-10;

/// The values angle + k * 2 pi, first ≤ k ≤ last, of one joint.
struct Turns {
  double angle;
  double first, last;
  JointLimits limits;

  [[nodiscard]] bool empty() const { return first > last; }
  /// A value that exceeds a limit by rounding is clamped to it.
  [[nodiscard]] double value(double k) const {
    return std::clamp(angle + k * kFullTurn, limits.lower, limits.upper);
  }
};

Turns turns(double angle, double reference, JointLimits limits, const Tx90IkOptions& options) {
  const double nearest = std::round((reference - angle) / kFullTurn);
  if (!options.respect_limits || std::isinf(limits.lower)) {
    limits.lower = -std::numeric_limits<double>::infinity();
    limits.upper = std::numeric_limits<double>::infinity();
    return {angle, nearest, nearest, limits};
  }
  const double first = std::ceil((limits.lower - kLimitTolerance - angle) / kFullTurn);
  const double last = std::floor((limits.upper + kLimitTolerance - angle) / kFullTurn);
  if (options.full_turn_alternates || first > last) {
    return {angle, first, last, limits};
  }
  const double chosen = std::clamp(nearest, first, last);
  return {angle, chosen, chosen, limits};
}

class Solution : public SphericalWristInverseKinematics {
 public:
  Solution(std::shared_ptr<const RobotModel> model, int tip_link, const Tx90Chain& chain,
           const Tx90IkOptions& options)
      : SphericalWristInverseKinematics(std::move(model), tip_link,
                                        {chain.variables.begin(), chain.variables.end()}),
        chain_(chain),
        geometry_(tx90_geometry(this->model(), chain, tip_link)),
        options_(options) {
    for (std::size_t k = 0; k < 6; ++k) {
      places_[k] = std::ranges::lower_bound(variables(), chain.variables[k]) - variables().begin();
    }
  }

  [[nodiscard]] ArmBranch branch_of(const Configuration& q) const override {
    return tx90_branch(geometry_, chain_values(q));
  }

 private:
  [[nodiscard]] Tx90Joints chain_values(const Configuration& q) const {
    Tx90Joints joints;
    for (std::size_t k = 0; k < 6; ++k) {
      joints[k] = q[chain_.variables[k]];
    }
    return joints;
  }

  [[nodiscard]] IkResult do_solve(const Pose& X_BT, const Configuration& reference) const override {
    const Tx90Joints near = chain_values(reference);
    Tx90Postures postures = tx90_postures(geometry_, X_BT, near);
    IkResult result;
    for (int i = 0; i < postures.count; ++i) {
      const Tx90Posture& posture = postures.list[static_cast<std::size_t>(i)];
      std::array<Turns, 6> choices;
      bool within = true;
      for (std::size_t k = 0; k < 6 && within; ++k) {
        const Joint& joint = model().joint(chain_.links[k]);
        choices[k] = turns(posture.q[k], near[k], joint.limits, options_);
        within = !choices[k].empty();
        if (!within) {
          result.reason = fmt::format(
              "every posture that reaches the pose is out of limits, the last for joint {} at "
              "{:.2f} degrees",
              joint.name, degrees(std::remainder(posture.q[k], kFullTurn)));
        }
      }
      if (within) {
        IkSolution begun{Configuration(6), posture.branch};
        add_turns(choices, 0, begun, result.solutions);
      }
    }
    if (!result.solutions.empty()) {
      result.reason.clear();
    } else if (postures.count == 0) {
      result.reason = std::move(postures.reason);
    }
    return result;
  }

  /// Adds the solutions with the values that joints k to 5 may take.
  void add_turns(const std::array<Turns, 6>& choices, std::size_t k, IkSolution& begun,
                 std::vector<IkSolution>& solutions) const {
    if (k == choices.size()) {
      solutions.push_back(begun);
      return;
    }
    for (double turn = choices[k].first; turn <= choices[k].last; ++turn) {
      begun.q[places_[k]] = choices[k].value(turn);
      add_turns(choices, k + 1, begun, solutions);
    }
  }

  Tx90Chain chain_;
  Tx90Geometry geometry_;
  Tx90IkOptions options_;
  std::array<Eigen::Index, 6> places_;  ///< Position of each joint in a solution.
};

}  // namespace

SphericalWristInverseKinematics::~SphericalWristInverseKinematics() = default;

std::unique_ptr<SphericalWristInverseKinematics> make_spherical_wrist_inverse_kinematics(
    std::shared_ptr<const RobotModel> model, std::string_view tip_link,
    const Tx90IkOptions& options) {
  const std::optional<int> tip = model->find_link(tip_link);
  if (!tip) {
    throw InputError({"inverse kinematics of " + model->name(), "link " + std::string(tip_link),
                      "no link of this name", "a link of the robot", ""});
  }
  const Tx90Chain chain = tx90_chain(*model, *tip);
  return std::make_unique<Solution>(std::move(model), *tip, chain, options);
}

}  // namespace handway::geometric
