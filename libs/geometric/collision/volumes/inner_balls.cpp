#include "collision/volumes/inner_balls.h"

#include "collision/volumes/solid.h"

#include <algorithm>
#include <cmath>

namespace handway::geometric {
namespace {

constexpr std::size_t kMostBalls = 8;
constexpr double kPoints = 4096.0;    // of the grid in which centres are looked for, …
constexpr double kMostAlong = 256.0;  // … and so many along an edge of a thin body's box
constexpr float kShrink = 0.999F;     // share of a radius that rounding leaves
constexpr float kApart = 0.7F;  // share of a ball's radius within which no other has its centre

// Balls around the points of a regular grid, the largest first.
std::vector<InnerBall> balls_of_grid(const Solid& solid, const TriangleTree& triangles) {
  const Aabb& box = solid.box();
  const Eigen::Vector3d size = box.size();
  std::vector<InnerBall> balls;
  if (!(size.prod() > 0.0)) {
    return balls;
  }
  const double step = std::max(std::cbrt(size.prod() / kPoints), size.maxCoeff() / kMostAlong);
  const auto within = static_cast<float>(size.maxCoeff());
  // Odd numbers of points, so that some are in the middle.
  const Eigen::Array3i count = 2 * (0.5 * size / step).array().floor().cast<int>() + 1;
  const Eigen::Array3d cell = size.array() / count.cast<double>();
  for (int z = 0; z < count.z(); ++z) {
    for (int y = 0; y < count.y(); ++y) {
      for (int x = 0; x < count.x(); ++x) {
        const Eigen::Vector3d p = box.lower + (cell * (Eigen::Array3d(x, y, z) + 0.5)).matrix();
        if (solid.contains(p)) {
          const Eigen::Vector3f centre = p.cast<float>();
          balls.push_back({centre, kShrink * triangles.distance(centre, within)});
        }
      }
    }
  }
  std::ranges::stable_sort(balls, std::ranges::greater(), &InnerBall::radius);
  return balls;
}

}  // namespace

std::vector<InnerBall> inner_balls(const TriangleMesh& mesh, const TriangleTree& triangles) {
  TriangleMesh surface = distinct_triangles(welded(mesh));
  std::vector<InnerBall> chosen;
  if (surface.triangles.empty() || !is_closed(surface)) {
    return chosen;
  }
  for (const InnerBall& ball : balls_of_grid(Solid(std::move(surface)), triangles)) {
    const bool is_covered = std::ranges::any_of(chosen, [&](const InnerBall& other) {
      return (ball.centre - other.centre).norm() < kApart * other.radius;
    });
    if (!is_covered) {
      chosen.push_back(ball);
    }
    if (chosen.size() == kMostBalls) {
      break;
    }
  }
  return chosen;
}

}  // namespace handway::geometric
