#include "collision/volumes/sphere_bounds.h"

#include "collision/volumes/vector_units.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace handway::geometric {
namespace {

constexpr std::size_t kWidth = SphereTree::kWidth;

struct alignas(64) Points {
  std::array<float, kWidth> x, y, z;
};

// Moves the centres; bit k: sphere k is nearer than `tolerance` to the box of the field's mesh.
HANDWAY_VECTOR_UNITS std::uint32_t near_box(const SphereTree::Node& node, const float* centre,
                                            const float* half, const FloatPose& X, float tolerance,
                                            Points& moved) {
  alignas(64) std::array<std::uint32_t, kWidth> near;
  for (std::size_t k = 0; k < kWidth; ++k) {
    const float x = X.p[0] + X.R[0] * node.x[k] + X.R[1] * node.y[k] + X.R[2] * node.z[k];
    const float y = X.p[1] + X.R[3] * node.x[k] + X.R[4] * node.y[k] + X.R[5] * node.z[k];
    const float z = X.p[2] + X.R[6] * node.x[k] + X.R[7] * node.y[k] + X.R[8] * node.z[k];
    moved.x[k] = x;
    moved.y[k] = y;
    moved.z[k] = z;
    const float ox = std::max(std::abs(x - centre[0]) - half[0], 0.0F);
    const float oy = std::max(std::abs(y - centre[1]) - half[1], 0.0F);
    const float oz = std::max(std::abs(z - centre[2]) - half[2], 0.0F);
    const float within = node.radius[k] + tolerance;
    near[k] = within > 0.0F && ox * ox + oy * oy + oz * oz < within * within ? 1U << k : 0U;
  }
  std::uint32_t bits = 0;
  HANDWAY_LANES
  for (std::size_t k = 0; k < kWidth; ++k) {
    bits |= near[k];
  }
  return bits;
}

// How far a slab with that slope, `bound` away from the centre, is from the disk in a sphere.
float disk_bound(const SphereTree::Node& node, std::size_t k, float bound, const float* slope,
                 const FloatPose& X) {
  const float nx = node.normal_x[k];
  const float ny = node.normal_y[k];
  const float nz = node.normal_z[k];
  const float across = slope[0] * (X.R[0] * nx + X.R[1] * ny + X.R[2] * nz) +
                       slope[1] * (X.R[3] * nx + X.R[4] * ny + X.R[5] * nz) +
                       slope[2] * (X.R[6] * nx + X.R[7] * ny + X.R[8] * nz);
  constexpr float kRounding = 1e-5F;  // of `across`
  const float along = std::sqrt(std::max(0.0F, 1.0F - across * across) + kRounding);
  return bound - node.thickness[k] * (std::abs(across) + kRounding) - node.radius[k] * along;
}

// The same of the field, where the whole sphere is in one cell or the mesh is a primitive.
float disk_bound(const SphereTree::Node& node, std::size_t k, const DistanceField& field,
                 const DistanceField::Place& place, const FloatPose& X,
                 const Eigen::Vector3f& centre) {
  if (field.primitive()) {
    const auto [distance, slope] = field.primitive()->tangent(centre);
    return distance <= 0.0F ? DistanceField::kNothing
                            : disk_bound(node, k, distance, slope.data(), X);
  }
  if (place.cell == nullptr || place.cell->listed() || place.room < node.radius[k] + X.rounding) {
    return DistanceField::kNothing;
  }
  return disk_bound(node, k, place.cell->bound(centre), place.cell->slope.data(), X);
}

}  // namespace

FloatPose::FloatPose(const Pose& X_BA, float reach) {
  const Eigen::Matrix3f rotation = X_BA.linear().cast<float>();
  const Eigen::Vector3f translation = X_BA.translation().cast<float>();
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(R.data()) = rotation;
  Eigen::Map<Eigen::Vector3f>(p.data()) = translation;
  rounding = kMoveRounding * (reach + translation.lpNorm<1>());
}

void sphere_bounds(const SphereTree::Node& node, const DistanceField& field, const FloatPose& X_BA,
                   float tolerance, SphereBounds& bounds) {
  Points moved;
  const float within = tolerance + X_BA.rounding;
  std::uint32_t candidates =
      near_box(node, field.centre().data(), field.half().data(), X_BA, within, moved);
  bounds.near = 0;
  for (; candidates != 0; candidates &= candidates - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(candidates));
    const Eigen::Vector3f centre(moved.x[k], moved.y[k], moved.z[k]);
    const DistanceField::Place place = field.find(centre);
    float bound = field.bound(centre, place) - node.radius[k] - X_BA.rounding;
    if (bound < tolerance) {
      bound = std::max(bound, disk_bound(node, k, field, place, X_BA, centre) - X_BA.rounding);
    }
    bounds.bound[k] = bound;
    bounds.near |= bound < tolerance ? 1U << k : 0U;
  }
}

}  // namespace handway::geometric
