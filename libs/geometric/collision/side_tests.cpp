#include "collision/side_tests.h"

#include "collision/vector_units.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace handway::geometric {
namespace {

using Rotation = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
using Boxes = SidedBoxes::Boxes;

constexpr std::size_t kCount = SurfacePoints::kCount;
constexpr std::size_t kBoxes = SidedBoxes::kMost;

HANDWAY_VECTOR_UNITS void move(const SurfacePoints& points, const float* R, const float* p,
                               SurfacePoints& moved) {
  for (std::size_t k = 0; k < kCount; ++k) {
    moved.x[k] = p[0] + R[0] * points.x[k] + R[1] * points.y[k] + R[2] * points.z[k];
    moved.y[k] = p[1] + R[3] * points.x[k] + R[4] * points.y[k] + R[5] * points.z[k];
    moved.z[k] = p[2] + R[6] * points.x[k] + R[7] * points.y[k] + R[8] * points.z[k];
  }
}

struct Box {
  std::array<float, 3> centre;
  std::array<float, 3> half;
};

// How many points are in the box.
HANDWAY_VECTOR_UNITS std::uint32_t count_in(const SurfacePoints& points, const Box& box) {
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < kCount; ++k) {
    const float x = std::abs(points.x[k] - box.centre[0]) - box.half[0];
    const float y = std::abs(points.y[k] - box.centre[1]) - box.half[1];
    const float z = std::abs(points.z[k] - box.centre[2]) - box.half[2];
    count += std::max(std::max(x, y), z) < 0.0F ? 1U : 0U;
  }
  return count;
}

// Bit k: the ball reaches box k.
HANDWAY_VECTOR_UNITS std::uint32_t reached(const float* centre, float radius, const Boxes& boxes) {
  std::uint32_t bits = 0;
  HANDWAY_LANES
  for (std::size_t k = 0; k < kBoxes; ++k) {
    const float x = std::max(std::abs(centre[0] - boxes.centre[0][k]) - boxes.half[0][k], 0.0F);
    const float y = std::max(std::abs(centre[1] - boxes.centre[1][k]) - boxes.half[1][k], 0.0F);
    const float z = std::max(std::abs(centre[2] - boxes.centre[2][k]) - boxes.half[2][k], 0.0F);
    bits |= x * x + y * y + z * z < radius * radius ? 1U << k : 0U;
  }
  return bits;
}

// How deep in one of the boxes a box is; negative: in none.
HANDWAY_VECTOR_UNITS float depth_in(const Box& box, const Boxes& boxes) {
  alignas(64) std::array<float, kBoxes> depth;
  for (std::size_t k = 0; k < kBoxes; ++k) {
    const float x = boxes.half[0][k] - std::abs(box.centre[0] - boxes.centre[0][k]) - box.half[0];
    const float y = boxes.half[1][k] - std::abs(box.centre[1] - boxes.centre[1][k]) - box.half[1];
    const float z = boxes.half[2][k] - std::abs(box.centre[2] - boxes.centre[2][k]) - box.half[2];
    depth[k] = std::min(std::min(x, y), z);
  }
  for (std::size_t k = 0; k < kBoxes / 2; ++k) {
    depth[k] = std::max(depth[k], depth[k + kBoxes / 2]);
  }
  float deepest = depth[0];
  for (std::size_t k = 1; k < kBoxes / 2; ++k) {
    deepest = std::max(deepest, depth[k]);
  }
  return deepest;
}

Box box_of(const Boxes& boxes, std::size_t k, float gain) {
  return {{boxes.centre[0][k], boxes.centre[1][k], boxes.centre[2][k]},
          {boxes.half[0][k] + gain, boxes.half[1][k] + gain, boxes.half[2][k] + gain}};
}

bool any_in(const SurfacePoints& points, const Boxes& boxes, std::uint32_t bits, float rounding) {
  for (; bits != 0; bits &= bits - 1) {
    if (count_in(points,
                 box_of(boxes, static_cast<std::size_t>(std::countr_zero(bits)), -rounding)) > 0) {
      return true;
    }
  }
  return false;
}

bool pierces(const SurfacePoints& a, const BoundingSphere& around, const SidedBoxes& b,
             const FloatPose& X_BA) {
  const Eigen::Map<const Rotation> R_PB(b.R_PB.data());
  const Eigen::Vector3f centre = R_PB * around.centre;
  const std::uint32_t inside = reached(centre.data(), around.radius, b.inside);
  if (inside == 0) {
    return false;
  }
  const Rotation R_PA = R_PB * Eigen::Map<const Rotation>(X_BA.R.data());
  const Eigen::Vector3f p_PA = R_PB * Eigen::Map<const Eigen::Vector3f>(X_BA.p.data());
  SurfacePoints moved;
  move(a, R_PA.data(), p_PA.data(), moved);
  const float rounding = 2.0F * X_BA.rounding;  // moved twice
  const auto all_in = [&] {
    return count_in(moved, {b.centre,
                            {b.half[0] + rounding, b.half[1] + rounding, b.half[2] + rounding}}) ==
           kCount;
  };
  return any_in(moved, b.inside, inside, rounding) &&
         (!all_in() ||
          any_in(moved, b.outside, reached(centre.data(), around.radius, b.outside), rounding));
}

float gap_outside(const Eigen::Vector3f& centre, const Eigen::Vector3f& half, const SidedBoxes& b,
                  const FloatPose& X_BA) {
  const Eigen::Map<const Rotation> R_PB(b.R_PB.data());
  const Rotation R_PA = R_PB * Eigen::Map<const Rotation>(X_BA.R.data());
  const Eigen::Vector3f c = R_PA * centre + R_PB * Eigen::Map<const Eigen::Vector3f>(X_BA.p.data());
  const Eigen::Vector3f h = R_PA.cwiseAbs() * half;
  const Eigen::Vector3f beside =
      (c - Eigen::Map<const Eigen::Vector3f>(b.centre.data())).cwiseAbs() -
      Eigen::Map<const Eigen::Vector3f>(b.half.data()) - h;
  return std::max(beside.maxCoeff(),
                  depth_in({{c.x(), c.y(), c.z()}, {h.x(), h.y(), h.z()}}, b.outside)) -
         2.0F * X_BA.rounding;
}

}  // namespace

bool surely_pierces(const SurfacePoints& a, const BoundingSphere& around, const SurfaceSides& b,
                    const FloatPose& X_BA) {
  const BoundingSphere moved{Eigen::Map<const Rotation>(X_BA.R.data()) * around.centre +
                                 Eigen::Map<const Eigen::Vector3f>(X_BA.p.data()),
                             around.radius};
  return std::ranges::any_of(
      b.pieces, [&](const SidedBoxes& piece) { return pierces(a, moved, piece, X_BA); });
}

float gap_outside(const Eigen::Vector3f& centre, const Eigen::Vector3f& half, const SurfaceSides& b,
                  const FloatPose& X_BA) {
  if (!b.has_all) {
    return 0.0F;
  }
  float least = std::numeric_limits<float>::max();
  for (const SidedBoxes& piece : b.pieces) {
    least = std::min(least, gap_outside(centre, half, piece, X_BA));
  }
  return least;
}

}  // namespace handway::geometric
