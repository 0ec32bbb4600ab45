#include "grasps/grasp_place.h"

#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;

constexpr double kLateralShift = 0.015;    // m
constexpr double kMaxDepthShare = 0.45;    // of the distance from the fingers' ends to the palm
constexpr double kMaxAxisAlignment = 0.9;  // cosine: an axis above that is not square to the chord
constexpr double kTilt = geometric::radians(25.0);
constexpr double kNeighbourShift = 0.015;                    // m, along each axis
constexpr double kNeighbourTurn = geometric::radians(15.0);  // about each axis

// In [-1, 1].
double signed_uniform(sampling::RandomStream& random) { return 2.0 * random.uniform() - 1.0; }

Vector3d signed_vector(sampling::RandomStream& random) {
  return Vector3d(signed_uniform(random), signed_uniform(random), signed_uniform(random));
}

// Draws the orientation of the grip (the fingers' row, opposition, their normal) in the object:
// the opposition along a chord; the row square to it, along the object's axes as often as not.
Eigen::Matrix3d orientation(const Chord& chord, sampling::RandomStream& random) {
  const Vector3d across = (random.below(2) == 0 ? 1.0 : -1.0) * chord.direction;
  const Vector3d axis = Vector3d::Unit(static_cast<int>(random.below(3)));
  const bool is_along = random.below(2) == 0 && std::abs(axis.dot(across)) < kMaxAxisAlignment;
  const Vector3d square =
      (is_along ? Vector3d(axis - axis.dot(across) * across) : across.unitOrthogonal())
          .normalized();
  const double turn = is_along ? static_cast<double>(random.below(2)) : 2.0 * random.uniform();
  const Vector3d row = Eigen::AngleAxisd(std::numbers::pi * turn, across) * square;
  Eigen::Matrix3d R_OG;
  R_OG << row, across, row.cross(across);
  const double share = random.uniform();  // some nearly straight: a narrow gripper needs them
  const Vector3d tilt = share * kTilt * signed_vector(random);
  return R_OG * Eigen::AngleAxisd(tilt.norm(), tilt.stableNormalized()).toRotationMatrix();
}

}  // namespace

Pose palm_at(const HandClosing::Preshape& preshape, const Chord& chord,
             sampling::RandomStream& random) {
  Eigen::Matrix3d R_PG;
  R_PG << preshape.row, preshape.opposition, preshape.row.cross(preshape.opposition);
  Pose X_OP = Pose::Identity();
  X_OP.linear() = orientation(chord, random) * R_PG.transpose();
  const double share = random.uniform();
  const Vector3d aside = share * kLateralShift * signed_vector(random);
  const double depth = 1.0 - kMaxDepthShare * random.uniform();
  X_OP.translation() = chord.centre - X_OP.linear() * (depth * preshape.grip + aside);
  return X_OP;
}

GraspPlace beside(const GraspPlace& place, sampling::RandomStream& random) {
  const double size = random.uniform();
  const Vector3d shift = size * kNeighbourShift * signed_vector(random);
  const Vector3d turn = size * kNeighbourTurn * signed_vector(random);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
  const Vector3d p_OGrip = place.X_OP * place.preshape.grip;
  GraspPlace moved = place;
  moved.X_OP.linear() = R * place.X_OP.linear();
  moved.X_OP.translation() = p_OGrip + shift - moved.X_OP.linear() * place.preshape.grip;
  return moved;
}

}  // namespace handway::planning
