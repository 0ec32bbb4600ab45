#include "robot/tx90_postures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace handway::geometric {
namespace {

using Shoulder = ArmBranch::Shoulder;
using Bend = ArmBranch::Bend;

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
/// Rounding, in metres, that may put a pose at the border of reach outside it.
constexpr double kReachTolerance = 1e-11;
/// Sine of the wrist's bend below which axes 4 and 6 count as in line.
constexpr double kWristSingularity = 1e-10;
/// Lengths (m) below which a direction counts as undefined.
constexpr double kNoDirection = 1e-9;
/// Branches nearer than this (rad) in every joint are one.
constexpr double kSameJoint = 1e-9;

bool same_posture(const Tx90Joints& a, const Tx90Joints& b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::abs(std::remainder(a[k] - b[k], kWholeTurn)) > kSameJoint) {
      return false;
    }
  }
  return true;
}

/// Where the wrist centre must be in the arm's plane, relative to axis 2.
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
    // How far, in C, the tip must turn from where it is at zero.
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
      // Of the two shoulders the lefty one, in front, says more to a person.
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

}  // namespace

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

}  // namespace handway::geometric
