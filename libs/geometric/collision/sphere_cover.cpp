#include "collision/sphere_cover.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace handway::geometric {
namespace {

// What part of a triangle a sphere is to contain.
struct Piece {
  std::array<Eigen::Vector3d, 3> corners;
  std::uint32_t triangle;

  [[nodiscard]] Eigen::Vector3d sum() const { return corners[0] + corners[1] + corners[2]; }
};

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

Aabb box_around(std::span<const Piece> pieces) {
  Aabb box{pieces.front().corners[0], pieces.front().corners[0]};
  for (const Piece& piece : pieces) {
    for (const Eigen::Vector3d& p : piece.corners) {
      box.lower = box.lower.cwiseMin(p);
      box.upper = box.upper.cwiseMax(p);
    }
  }
  return box;
}

// A small ball around all corners: start at the box's centre, then move towards
// the farthest point in shrinking steps (Badoiu and Clarkson, 2003).
Ball enclosing_ball(std::span<const Piece> pieces) {
  const auto farthest_from = [&](const Eigen::Vector3d& centre) {
    const Eigen::Vector3d* farthest = nullptr;
    double most = -1.0;
    for (const Piece& piece : pieces) {
      for (const Eigen::Vector3d& p : piece.corners) {
        if (const double squared = (p - centre).squaredNorm(); squared > most) {
          most = squared;
          farthest = &p;
        }
      }
    }
    return farthest;
  };
  Eigen::Vector3d centre = box_around(pieces).centre();
  const Eigen::Vector3d* farthest = farthest_from(centre);
  Ball best{centre, (*farthest - centre).norm()};
  for (int i = 1; i <= 6; ++i) {
    centre += (*farthest - centre) / (i + 1.0);
    farthest = farthest_from(centre);
    if (const double radius = (*farthest - centre).norm(); radius < best.radius) {
      best = {centre, radius};
    }
  }
  return best;
}

struct Plane {
  Eigen::Vector3f normal;
  float thickness;
};

// The mean plane through `centre`.
Plane plane_through(const Eigen::Vector3f& centre, std::span<const Piece> pieces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Piece& piece : pieces) {
    const auto& [a, b, c] = piece.corners;
    sum += (b - a).cross(c - a);
  }
  const double length = sum.norm();
  const Eigen::Vector3f normal =
      (length > 0.0 ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::UnitZ()).cast<float>();
  double thickness = 0.0;
  for (const Piece& piece : pieces) {
    for (const Eigen::Vector3d& p : piece.corners) {
      thickness =
          std::max(thickness, std::abs((p - centre.cast<double>()).dot(normal.cast<double>())));
    }
  }
  return {normal, std::nextafter(static_cast<float>(thickness), 1e30F)};
}

// Centres are rounded to float; the radius makes up for that.
BoundingSphere rounded(const Ball& ball) {
  const Eigen::Vector3f centre = ball.centre.cast<float>();
  const double radius = ball.radius + (centre.cast<double>() - ball.centre).norm();
  return {centre, std::nextafter(static_cast<float>(radius * (1.0 + 1e-7)), 1e30F)};
}

// Cut until no edge is longer, or there are more than `most` pieces.
void cut(const Piece& piece, double longest_edge, std::size_t most, std::vector<Piece>& pieces) {
  const auto& [a, b, c] = piece.corners;
  const double ab = (b - a).norm();
  const double bc = (c - b).norm();
  const double ca = (a - c).norm();
  const double longest = std::max({ab, bc, ca});
  if (longest <= longest_edge || pieces.size() > most) {
    pieces.push_back(piece);
    return;
  }
  // Turn the triangle so that its longest edge comes first, and halve that.
  const std::size_t first = bc == longest ? 1 : ca == longest ? 2 : 0;
  const Eigen::Vector3d& p = piece.corners[first];
  const Eigen::Vector3d& q = piece.corners[(first + 1) % 3];
  const Eigen::Vector3d& r = piece.corners[(first + 2) % 3];
  const Eigen::Vector3d middle = 0.5 * (p + q);
  cut({{p, middle, r}, piece.triangle}, longest_edge, most, pieces);
  cut({{middle, q, r}, piece.triangle}, longest_edge, most, pieces);
}

// All triangles cut so; with more than `most` pieces it is not complete.
std::vector<Piece> cut(const TriangleMesh& mesh, double longest_edge, std::size_t most) {
  std::vector<Piece> pieces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    cut({{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, t}, longest_edge, most, pieces);
    if (pieces.size() > most) {
      break;
    }
  }
  return pieces;
}

}  // namespace

class SphereCoverBuilder {
 public:
  SphereCoverBuilder(SphereCover& cover, double leaf_radius)
      : cover_(cover), leaf_radius_(leaf_radius) {}

  void build(std::vector<Piece> pieces) {
    cover_.root_ = rounded(enclosing_ball(pieces));
    add_node(pieces);
    cover_.leaves_.push_back(static_cast<std::uint32_t>(cover_.triangles_.size()));
  }

 private:
  using Part = std::span<Piece>;

  std::uint32_t add_node(Part pieces) {
    const auto index = static_cast<std::uint32_t>(cover_.nodes_.size());
    SphereCover::Node node;
    node.x.fill(0.0F);
    node.y.fill(0.0F);
    node.z.fill(0.0F);
    node.radius.fill(-1e30F);
    node.normal_x.fill(0.0F);
    node.normal_y.fill(0.0F);
    node.normal_z.fill(1.0F);
    node.thickness.fill(0.0F);
    node.child.fill(SphereCover::kLeaf);
    cover_.nodes_.emplace_back();
    for (const Part& part : parted(pieces)) {
      const Ball ball = enclosing_ball(part);
      const BoundingSphere sphere = rounded(ball);
      const std::size_t k = node.count++;
      node.x[k] = sphere.centre.x();
      node.y[k] = sphere.centre.y();
      node.z[k] = sphere.centre.z();
      node.radius[k] = sphere.radius;
      const Plane plane = plane_through(sphere.centre, part);
      node.normal_x[k] = plane.normal.x();
      node.normal_y[k] = plane.normal.y();
      node.normal_z[k] = plane.normal.z();
      node.thickness[k] = plane.thickness;
      node.child[k] =
          is_leaf(part, ball.radius) ? SphereCover::kLeaf | add_leaf(part) : add_node(part);
    }
    cover_.nodes_[index] = node;
    return index;
  }

  [[nodiscard]] bool is_leaf(const Part& part, double radius) const {
    return part.size() == 1 || radius <= leaf_radius_;
  }

  std::uint32_t add_leaf(Part pieces) {
    const auto leaf = static_cast<std::uint32_t>(cover_.leaves_.size());
    const std::size_t first = cover_.triangles_.size();
    cover_.leaves_.push_back(static_cast<std::uint32_t>(first));
    for (const Piece& piece : pieces) {
      cover_.triangles_.push_back(piece.triangle);
    }
    const auto begin = cover_.triangles_.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, cover_.triangles_.end());
    cover_.triangles_.erase(std::unique(begin, cover_.triangles_.end()), cover_.triangles_.end());
    return leaf;
  }

  // The largest part is halved until there are sixteen or all are leaves.
  [[nodiscard]] std::vector<Part> parted(Part pieces) const {
    struct Sized {
      Part part;
      double radius;
    };
    std::vector<Sized> parts{{pieces, enclosing_ball(pieces).radius}};
    while (parts.size() < SphereCover::kWidth) {
      const auto largest = std::ranges::max_element(parts, [&](const Sized& s, const Sized& t) {
        return (is_leaf(s.part, s.radius) ? -1.0 : s.radius) <
               (is_leaf(t.part, t.radius) ? -1.0 : t.radius);
      });
      if (is_leaf(largest->part, largest->radius)) {
        break;
      }
      const auto [first, second] = halves(largest->part);
      *largest = {first, enclosing_ball(first).radius};
      parts.push_back({second, enclosing_ball(second).radius});
    }
    std::vector<Part> result;
    result.reserve(parts.size());
    for (const Sized& sized : parts) {
      result.push_back(sized.part);
    }
    return result;
  }

  static std::pair<Part, Part> halves(Part pieces) {
    Eigen::Index axis = 0;
    box_around(pieces).size().maxCoeff(&axis);
    const std::size_t half = pieces.size() / 2;
    std::ranges::nth_element(
        pieces, pieces.begin() + static_cast<std::ptrdiff_t>(half),
        [axis](const Piece& s, const Piece& t) { return s.sum()[axis] < t.sum()[axis]; });
    return {pieces.first(half), pieces.subspan(half)};
  }

  SphereCover& cover_;
  double leaf_radius_;
};

SphereCover::SphereCover(const TriangleMesh& mesh, double leaf_radius) {
  constexpr double kEdge = 1.5;  // of the radius
  const std::size_t most = mesh.triangles.size() + kMostPieces;
  std::vector<Piece> pieces = cut(mesh, kEdge * leaf_radius, most);
  while (pieces.size() > most) {
    leaf_radius *= 2.0;
    pieces = cut(mesh, kEdge * leaf_radius, most);
  }
  SphereCoverBuilder(*this, leaf_radius).build(std::move(pieces));
}

}  // namespace handway::geometric
