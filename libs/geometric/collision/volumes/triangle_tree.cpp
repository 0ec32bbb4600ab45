#include "collision/volumes/triangle_tree.h"

#include "math/vector_units.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace handway::geometric {
namespace {

// Returns whether the segment from p to q goes through the triangle.
bool pierces(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleCorners& t) {
  const Eigen::Vector3d along = q - p;
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double enough = kTouch * normal.norm();
  const double before = normal.dot(p - t[0]);
  const double after = normal.dot(q - t[0]);
  if (!((before > enough && after < -enough) || (before < -enough && after > enough))) {
    return false;
  }
  // The line has to pass all three borders on the same side, each at a distance.
  const double length = along.norm();
  int left = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d border = t[(i + 1) % 3] - t[i];
    const double passes = along.dot((t[i] - p).cross(border));
    if (std::abs(passes) <= kTouch * length * border.norm()) {
      return false;
    }
    left += passes > 0.0 ? 1 : 0;
  }
  return left == 0 || left == 3;
}

}  // namespace

TrianglePlane::TrianglePlane(const TriangleCorners& triangle)
    : corner_(triangle[0]),
      normal_((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0])),
      length_(normal_.norm()) {}

bool TrianglePlane::is_beside(const TriangleCorners& other, double tolerance) const {
  const double enough = tolerance * length_;
  const double a = normal_.dot(other[0] - corner_);
  const double b = normal_.dot(other[1] - corner_);
  const double c = normal_.dot(other[2] - corner_);
  return std::min({a, b, c}) > enough || std::max({a, b, c}) < -enough;
}

bool surely_cross(const TriangleCorners& s, const TriangleCorners& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (pierces(s[i], s[(i + 1) % 3], t) || pierces(t[i], t[(i + 1) % 3], s)) {
      return true;
    }
  }
  return false;
}

TriangleBlock::TriangleBlock(std::span<const TriangleCorners> triangles) {
  for (std::size_t k = 0; k < kWidth; ++k) {
    const TriangleCorners& t = triangles[std::min(k, triangles.size() - 1)];
    const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const double length = normal.norm();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        corners_[corner][axis][k] = static_cast<float>(t[corner][i]);
      }
      normals_[axis][k] = length > 0.0 ? static_cast<float>(normal[i] / length) : 0.0F;
    }
  }
}

// Over a triangle's face the distance is that from its plane, elsewhere that from its
// edges.
HANDWAY_VECTOR_UNITS TriangleBlock::Lanes TriangleBlock::squared_distances(
    const Eigen::Vector3f& p) const {
  Lanes squared;
  const float px = p.x();
  const float py = p.y();
  const float pz = p.z();
  for (std::size_t k = 0; k < kWidth; ++k) {
    const float nx = normals_[0][k];
    const float ny = normals_[1][k];
    const float nz = normals_[2][k];
    float from_edges = 1e30F;
    float least_side = 1e30F;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vectors& a = corners_[corner];
      const Vectors& b = corners_[(corner + 1) % 3];
      const float ex = b[0][k] - a[0][k];
      const float ey = b[1][k] - a[1][k];
      const float ez = b[2][k] - a[2][k];
      const float qx = px - a[0][k];
      const float qy = py - a[1][k];
      const float qz = pz - a[2][k];
      const float along =
          (ex * qx + ey * qy + ez * qz) / std::max(ex * ex + ey * ey + ez * ez, 1e-30F);
      const float t = std::min(std::max(along, 0.0F), 1.0F);
      const float dx = qx - t * ex;
      const float dy = qy - t * ey;
      const float dz = qz - t * ez;
      from_edges = std::min(from_edges, dx * dx + dy * dy + dz * dz);
      const float side =
          (ny * ez - nz * ey) * qx + (nz * ex - nx * ez) * qy + (nx * ey - ny * ex) * qz;
      least_side = std::min(least_side, side);
    }
    const float above = nx * (px - corners_[0][0][k]) + ny * (py - corners_[0][1][k]) +
                        nz * (pz - corners_[0][2][k]);
    const bool over_face = least_side > 0.0F;
    squared[k] = over_face ? above * above : from_edges;
  }
  return squared;
}

float TriangleBlock::distance(const Eigen::Vector3f& p) const {
  return std::sqrt(std::ranges::min(squared_distances(p)));
}

namespace {

constexpr float kTreeRounding = 2e-6F;  // share of the coordinates: bound of rounding
constexpr float kPastLast = -1e30F;     // half a box that no point is near to

struct TreePiece {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
  std::uint32_t triangle;
};

}  // namespace

class TriangleTreeBuilder {
 public:
  TriangleTreeBuilder(TriangleTree& tree, const TriangleMesh& mesh) : tree_(tree), mesh_(mesh) {}

  void build() {
    std::vector<TreePiece> pieces;
    pieces.reserve(mesh_.triangles.size());
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const TriangleCorners t = corners(mesh_, i);
      pieces.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2]), i});
      tree_.size_ = std::max({tree_.size_, static_cast<float>(-pieces.back().lower.minCoeff()),
                              static_cast<float>(pieces.back().upper.maxCoeff())});
    }
    tree_.root_ = add(pieces);
  }

 private:
  using Pieces = std::span<TreePiece>;

  std::uint32_t add(Pieces pieces) {
    return pieces.size() <= TriangleBlock::kWidth ? add_leaf(pieces) : add_node(pieces);
  }

  std::uint32_t add_leaf(Pieces pieces) {
    std::vector<TriangleCorners> triangles;
    TriangleTree::Leaf leaf;
    for (const TreePiece& piece : pieces) {
      leaf.triangles[triangles.size()] = piece.triangle;
      triangles.push_back(corners(mesh_, piece.triangle));
    }
    leaf.count = static_cast<std::uint32_t>(triangles.size());
    leaf.block = TriangleBlock(triangles);
    tree_.leaves_.push_back(leaf);
    return TriangleTree::kLeaf | static_cast<std::uint32_t>(tree_.leaves_.size() - 1);
  }

  std::uint32_t add_node(Pieces pieces) {
    const std::size_t index = tree_.nodes_.size();
    for (auto& half : tree_.nodes_.emplace_back().half) {
      half.fill(kPastLast);
    }
    std::vector<Pieces> groups{pieces};
    while (groups.size() < TriangleTree::kWidth) {
      const auto largest = std::ranges::max_element(groups, {}, &Pieces::size);
      if (largest->size() <= TriangleBlock::kWidth) {
        break;
      }
      const auto [low, high] = halves(*largest);
      *largest = low;
      groups.push_back(high);
    }
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const std::uint32_t child = add(groups[k]);
      TriangleTree::Node& node = tree_.nodes_[index];  // added ones may have moved it
      node.child[k] = child;
      set_box(node, k, box_of(groups[k]));
    }
    return static_cast<std::uint32_t>(index);
  }

  static void set_box(TriangleTree::Node& node, std::size_t k, const Aabb& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      node.centre[axis][k] = static_cast<float>(box.centre()[i]);
      node.half[axis][k] = static_cast<float>(0.5 * box.size()[i]);
    }
  }

  // Halves the longer side so that as many leaves as possible are full.
  static std::pair<Pieces, Pieces> halves(Pieces pieces) {
    Eigen::Index axis = 0;
    box_of(pieces).size().maxCoeff(&axis);
    constexpr std::size_t kFull = TriangleBlock::kWidth;
    const std::size_t half = (pieces.size() / 2 + kFull - 1) / kFull * kFull;
    std::ranges::nth_element(
        pieces, pieces.begin() + static_cast<std::ptrdiff_t>(half), {},
        [axis](const TreePiece& piece) { return (piece.lower + piece.upper)[axis]; });
    return {pieces.first(half), pieces.subspan(half)};
  }

  static Aabb box_of(Pieces pieces) {
    Aabb box{pieces.front().lower, pieces.front().upper};
    for (const TreePiece& piece : pieces) {
      box.lower = box.lower.cwiseMin(piece.lower);
      box.upper = box.upper.cwiseMax(piece.upper);
    }
    return box;
  }

  TriangleTree& tree_;
  const TriangleMesh& mesh_;
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) { TriangleTreeBuilder(*this, mesh).build(); }

float TriangleTree::rounding(const Eigen::Vector3d& p, double distance) const {
  return kTreeRounding * (size_ + static_cast<float>(distance + p.lpNorm<1>()));
}

float TriangleTree::reach(const Eigen::Vector3d& p, double distance) const {
  return static_cast<float>(distance) + rounding(p, distance);
}

HANDWAY_VECTOR_UNITS std::uint32_t TriangleTree::near_boxes(const Node& node,
                                                            const Eigen::Vector3f& p,
                                                            float distance,
                                                            std::array<float, kWidth>& squared) {
  const float px = p.x();
  const float py = p.y();
  const float pz = p.z();
  std::uint32_t near = 0;
  HANDWAY_LANES
  for (std::size_t k = 0; k < kWidth; ++k) {
    const float x = std::max(std::abs(px - node.centre[0][k]) - node.half[0][k], 0.0F);
    const float y = std::max(std::abs(py - node.centre[1][k]) - node.half[1][k], 0.0F);
    const float z = std::max(std::abs(pz - node.centre[2][k]) - node.half[2][k], 0.0F);
    squared[k] = x * x + y * y + z * z;
    near |= squared[k] < distance * distance ? 1U << k : 0U;
  }
  return near;
}

template <typename Visit>
void TriangleTree::visit_near(const Eigen::Vector3f& p, const float& distance,
                              const Visit& visit) const {
  std::array<std::uint32_t, 256> stack;  // trees have at most seven waiting on a level
  std::size_t waiting = 0;
  stack[waiting++] = root_;
  while (waiting > 0) {
    const std::uint32_t top = stack[--waiting];
    if ((top & kLeaf) != 0) {
      if (visit(leaves_[top & ~kLeaf])) {
        return;
      }
      continue;
    }
    const Node& node = nodes_[top];
    std::array<float, kWidth> squared;
    std::uint32_t near = near_boxes(node, p, distance, squared);
    if (near == 0) {
      continue;
    }
    auto nearest = static_cast<std::size_t>(std::countr_zero(near));
    for (std::uint32_t bits = near; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(bits));
      nearest = squared[k] < squared[nearest] ? k : nearest;
    }
    for (near &= ~(1U << nearest); near != 0; near &= near - 1) {
      stack[waiting++] = node.child[static_cast<std::size_t>(std::countr_zero(near))];
    }
    stack[waiting++] = node.child[nearest];
  }
}

float TriangleTree::distance(const Eigen::Vector3f& p, float within) const {
  visit_near(p, within, [&](const Leaf& leaf) {
    within = std::min(within, leaf.block.distance(p));
    return false;
  });
  return within;
}

bool TriangleTree::has_triangle_within(const Eigen::Vector3f& p, float distance) const {
  bool found = false;
  visit_near(p, distance, [&](const Leaf& leaf) {
    found = leaf.block.distance(p) < distance;
    return found;
  });
  return found;
}

bool TriangleTree::is_nearer_than(const Eigen::Vector3d& p, double distance) const {
  return has_triangle_within(p.cast<float>(), reach(p, distance));
}

bool TriangleTree::is_surely_nearer_than(const Eigen::Vector3d& p, double distance) const {
  const float within = static_cast<float>(distance) - rounding(p, distance);
  return within > 0.0F && has_triangle_within(p.cast<float>(), within);
}

void TriangleTree::append_within(const Eigen::Vector3d& p, double distance,
                                 std::vector<std::uint32_t>& triangles) const {
  const float within = reach(p, distance);
  const Eigen::Vector3f point = p.cast<float>();
  visit_near(point, within, [&](const Leaf& leaf) {
    const TriangleBlock::Lanes squared = leaf.block.squared_distances(point);
    for (std::size_t k = 0; k < leaf.count; ++k) {
      if (squared[k] < within * within) {
        triangles.push_back(leaf.triangles[k]);
      }
    }
    return false;
  });
}

}  // namespace handway::geometric
