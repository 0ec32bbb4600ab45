#include "collision/sphere_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace handway::geometric {
namespace {

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

// A small ball around points: start at the box's centre, then move towards the
// farthest point in shrinking steps (Badoiu and Clarkson, 2003).
Ball enclosing_ball(const std::vector<const Eigen::Vector3d*>& points) {
  Eigen::Vector3d lower = *points.front();
  Eigen::Vector3d upper = lower;
  for (const Eigen::Vector3d* p : points) {
    lower = lower.cwiseMin(*p);
    upper = upper.cwiseMax(*p);
  }
  const auto radius_around = [&](const Eigen::Vector3d& centre, const Eigen::Vector3d** farthest) {
    double most = -1.0;
    for (const Eigen::Vector3d* p : points) {
      const double squared = (*p - centre).squaredNorm();
      if (squared > most) {
        most = squared;
        *farthest = p;
      }
    }
    return std::sqrt(most);
  };
  const Eigen::Vector3d* farthest = nullptr;
  Ball best{0.5 * (lower + upper), 0.0};
  best.radius = radius_around(best.centre, &farthest);
  Eigen::Vector3d centre = best.centre;
  for (int i = 1; i <= 6; ++i) {
    centre += (*farthest - centre) / (i + 1.0);
    const double radius = radius_around(centre, &farthest);
    if (radius < best.radius) {
      best = {centre, radius};
    }
  }
  best.radius *= 1.0 + 1e-12;  // the roundings of this and of later transforms
  return best;
}

}  // namespace

SphereTree::SphereTree(const TriangleMesh& mesh, double leaf_radius) {
  std::vector<Piece> pieces;
  for (const auto& [a, b, c] : mesh.triangles) {
    cut({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, 1.5 * leaf_radius, pieces);
  }
  build(pieces, 0, pieces.size(), leaf_radius);
}

void SphereTree::cut(const Piece& piece, double longest_edge, std::vector<Piece>& pieces) {
  const double ab = (piece.b - piece.a).norm();
  const double bc = (piece.c - piece.b).norm();
  const double ca = (piece.a - piece.c).norm();
  const double longest = std::max({ab, bc, ca});
  if (longest <= longest_edge) {
    pieces.push_back(piece);
    return;
  }
  // Turn the triangle so that its longest edge is ab, and halve that.
  Piece turned = piece;
  if (bc == longest) {
    turned = {piece.b, piece.c, piece.a};
  } else if (ca == longest) {
    turned = {piece.c, piece.a, piece.b};
  }
  const Eigen::Vector3d middle = 0.5 * (turned.a + turned.b);
  cut({turned.a, middle, turned.c}, longest_edge, pieces);
  cut({middle, turned.b, turned.c}, longest_edge, pieces);
}

void SphereTree::build(std::vector<Piece>& pieces, std::size_t first, std::size_t count,
                       double leaf_radius) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  std::vector<const Eigen::Vector3d*> points;
  points.reserve(3 * count);
  for (std::size_t i = first; i < first + count; ++i) {
    points.insert(points.end(), {&pieces[i].a, &pieces[i].b, &pieces[i].c});
  }
  const Ball ball = enclosing_ball(points);
  nodes_[index].centre = ball.centre;
  nodes_[index].radius = ball.radius;
  if (count == 1 || ball.radius <= leaf_radius) {
    return;
  }
  Eigen::Vector3d lower = *points.front();
  Eigen::Vector3d upper = lower;
  for (const Eigen::Vector3d* p : points) {
    lower = lower.cwiseMin(*p);
    upper = upper.cwiseMax(*p);
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto begin = pieces.begin() + static_cast<std::ptrdiff_t>(first);
  const auto half = static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(begin, begin + half, begin + static_cast<std::ptrdiff_t>(count),
                   [axis](const Piece& s, const Piece& t) {
                     return (s.a + s.b + s.c)[axis] < (t.a + t.b + t.c)[axis];
                   });
  build(pieces, first, static_cast<std::size_t>(half), leaf_radius);
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(pieces, first + static_cast<std::size_t>(half), count - static_cast<std::size_t>(half),
        leaf_radius);
}

}  // namespace handway::geometric
