#include "collision/volumes/sphere_tree.h"

#include "math/vector_units.h"

#include <tbb/concurrent_vector.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kEdge = 1.5;       // multiple of a leaf's radius: longer edges are cut
constexpr double kNodeEdge = 0.25;  // share of a node's radius, for the spheres below it

// Part of a triangle that a sphere has to contain.
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

// A small ball around points: start at the box's centre, then move towards
// the farthest point in shrinking steps (Badoiu and Clarkson, 2003).
// @param visit shows all points to a function.
template <typename Visit>
Ball enclosing_ball(const Visit& visit, const Aabb& box) {
  const auto farthest_from = [&](const Eigen::Vector3d& centre) {
    const Eigen::Vector3d* farthest = nullptr;
    double most = -1.0;
    visit([&](const Eigen::Vector3d& p) {
      if (const double squared = (p - centre).squaredNorm(); squared > most) {
        most = squared;
        farthest = &p;
      }
    });
    return farthest;
  };
  Eigen::Vector3d centre = box.centre();
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

Ball enclosing_ball(std::span<const Piece> pieces) {
  return enclosing_ball(
      [&](const auto& see) {
        for (const Piece& piece : pieces) {
          std::ranges::for_each(piece.corners, see);
        }
      },
      box_around(pieces));
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

// Centres are rounded to float; the radius compensates for that.
BoundingSphere rounded(const Ball& ball) {
  const Eigen::Vector3f centre = ball.centre.cast<float>();
  const double radius = ball.radius + (centre.cast<double>() - ball.centre).norm();
  return {centre, std::nextafter(static_cast<float>(radius * (1.0 + 1e-7)), 1e30F)};
}

double longest_edge(const Piece& piece) {
  const auto& [a, b, c] = piece.corners;
  return std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

// Cuts until no edge is longer, or there are more than `most` pieces.
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
  // Turns the triangle so that its longest edge comes first, and halves that.
  const std::size_t first = bc == longest ? 1 : ca == longest ? 2 : 0;
  const Eigen::Vector3d& p = piece.corners[first];
  const Eigen::Vector3d& q = piece.corners[(first + 1) % 3];
  const Eigen::Vector3d& r = piece.corners[(first + 2) % 3];
  const Eigen::Vector3d middle = 0.5 * (p + q);
  cut({{p, middle, r}, piece.triangle}, longest_edge, most, pieces);
  cut({{middle, q, r}, piece.triangle}, longest_edge, most, pieces);
}

// Cuts all triangles; with more than `most` pieces the result is incomplete.
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

std::vector<Piece> uncut(const TriangleMesh& mesh) {
  std::vector<Piece> pieces;
  pieces.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    pieces.push_back({{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, t});
  }
  return pieces;
}

}  // namespace

/// Makes the nodes of one tree.
class SphereTreeGrowth {
 public:
  using Pieces = std::vector<Piece>;

  SphereTreeGrowth(Pieces pieces, double leaf_radius)
      : leaf_radius_(leaf_radius), root_(enclosing_ball(pieces)) {
    slots_.emplace_back(std::move(pieces));
  }

  SphereTreeGrowth(std::shared_ptr<const TriangleMesh> mesh, double leaf_radius)
      : leaf_radius_(leaf_radius),
        root_(enclosing_ball([&](const auto& see) { std::ranges::for_each(mesh->vertices, see); },
                             bounding_box(*mesh))),
        mesh_(std::move(mesh)) {
    slots_.emplace_back(Pieces());
  }

  [[nodiscard]] BoundingSphere root() const { return rounded(root_); }

  const SphereTree::Node& node(std::uint32_t index) {
    Slot& slot = slots_[index];
    if (const SphereTree::Node* made = slot.made.load(std::memory_order_acquire)) {
      return *made;
    }
    const std::scoped_lock lock(mutex_);
    if (!slot.node) {
      Pieces pieces = mesh_ ? uncut(*std::exchange(mesh_, {})) : std::exchange(slot.pieces, {});
      slot.node = std::make_unique<const SphereTree::Node>(made_of(std::move(pieces)));
      slot.made.store(slot.node.get(), std::memory_order_release);
    }
    return *slot.node;
  }

  [[nodiscard]] std::span<const std::uint32_t> leaf(std::uint32_t index) const {
    return leaves_[index];
  }

 private:
  using Part = std::span<Piece>;

  struct Slot {
    explicit Slot(Pieces below) : pieces(std::move(below)) {}

    Pieces pieces;  ///< Pieces of a node that is not made yet.
    std::unique_ptr<const SphereTree::Node> node;
    std::atomic<const SphereTree::Node*> made = nullptr;
  };

  SphereTree::Node made_of(Pieces pieces) {
    cut_for_node(pieces);
    SphereTree::Node node;
    node.x.fill(0.0F);
    node.y.fill(0.0F);
    node.z.fill(0.0F);
    node.radius.fill(-1e30F);
    node.normal_x.fill(0.0F);
    node.normal_y.fill(0.0F);
    node.normal_z.fill(1.0F);
    node.thickness.fill(0.0F);
    node.child.fill(SphereTree::kLeaf);
    for (const Part& part : split(pieces)) {
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
          is_leaf(part, ball.radius) ? SphereTree::kLeaf | add_leaf(part) : add_slot(part);
    }
    return node;
  }

  // Cuts large triangles into pieces that sixteen spheres can share.
  void cut_for_node(Pieces& pieces) const {
    const double longest =
        std::max(kEdge * leaf_radius_, kNodeEdge * enclosing_ball(pieces).radius);
    if (std::ranges::all_of(pieces,
                            [&](const Piece& piece) { return longest_edge(piece) <= longest; })) {
      return;
    }
    Pieces smaller;
    for (const Piece& piece : pieces) {
      cut(piece, longest, std::numeric_limits<std::size_t>::max(), smaller);
    }
    pieces = std::move(smaller);
  }

  [[nodiscard]] bool is_leaf(const Part& part, double radius) const {
    return radius <= leaf_radius_ ||
           (part.size() == 1 && longest_edge(part.front()) <= kEdge * leaf_radius_);
  }

  std::uint32_t add_slot(Part pieces) {
    const auto slot = slots_.emplace_back(Pieces(pieces.begin(), pieces.end()));
    return static_cast<std::uint32_t>(slot - slots_.begin());
  }

  std::uint32_t add_leaf(Part pieces) {
    std::vector<std::uint32_t> triangles;
    for (const Piece& piece : pieces) {
      triangles.push_back(piece.triangle);
    }
    std::ranges::sort(triangles);
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    const auto leaf = leaves_.push_back(std::move(triangles));
    return static_cast<std::uint32_t>(leaf - leaves_.begin());
  }

  // Halves the largest part until there are sixteen or none can be halved.
  [[nodiscard]] std::vector<Part> split(Part pieces) const {
    struct Sized {
      Part part;
      double radius;
    };
    // Negative for parts that can't be halved.
    const auto worth = [this](const Sized& sized) {
      return sized.part.size() == 1 || is_leaf(sized.part, sized.radius) ? -1.0 : sized.radius;
    };
    std::vector<Sized> parts{{pieces, enclosing_ball(pieces).radius}};
    while (parts.size() < SphereTree::kWidth) {
      const auto largest = std::ranges::max_element(parts, {}, worth);
      if (worth(*largest) < 0.0) {
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

  double leaf_radius_;
  Ball root_;
  std::shared_ptr<const TriangleMesh> mesh_;  ///< Until the first node is made of it.
  std::mutex mutex_;                          ///< Locked while a node is made.
  tbb::concurrent_vector<Slot> slots_;
  tbb::concurrent_vector<std::vector<std::uint32_t>> leaves_;
};

SphereTree::SphereTree(const TriangleMesh& mesh, double leaf_radius) {
  const std::size_t most = mesh.triangles.size() + kMostPieces;
  std::vector<Piece> pieces = cut(mesh, kEdge * leaf_radius, most);
  while (pieces.size() > most) {
    leaf_radius *= 2.0;
    pieces = cut(mesh, kEdge * leaf_radius, most);
  }
  SphereTreeGrowth growth(std::move(pieces), leaf_radius);
  root_ = growth.root();
  copy_complete(growth, 0);
  leaves_.push_back(static_cast<std::uint32_t>(triangles_.size()));
}

SphereTree SphereTree::growing(std::shared_ptr<const TriangleMesh> mesh, double leaf_radius) {
  SphereTree cover;
  cover.growth_ = std::make_shared<SphereTreeGrowth>(std::move(mesh), leaf_radius);
  cover.root_ = cover.growth_->root();
  return cover;
}

const SphereTree::Node& SphereTree::grown_node(std::uint32_t index) const {
  return growth_->node(index);
}

std::span<const std::uint32_t> SphereTree::grown_leaf(std::uint32_t leaf) const {
  return growth_->leaf(leaf);
}

std::uint32_t SphereTree::copy_complete(SphereTreeGrowth& growth, std::uint32_t index) {
  const auto copy = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(growth.node(index));
  for (std::size_t k = 0; k < nodes_[copy].count; ++k) {
    const std::uint32_t child = nodes_[copy].child[k];
    if ((child & kLeaf) == 0) {
      const std::uint32_t below = copy_complete(growth, child);
      nodes_[copy].child[k] = below;
      continue;
    }
    nodes_[copy].child[k] = kLeaf | static_cast<std::uint32_t>(leaves_.size());
    leaves_.push_back(static_cast<std::uint32_t>(triangles_.size()));
    const std::span<const std::uint32_t> triangles = growth.leaf(child & ~kLeaf);
    triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
  }
  return copy;
}

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

// Distance of a slab with slope `slope`, `bound` away from the centre, from the disk in a sphere.
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

// Returns the bound by the field, if the whole sphere is in one cell or the mesh is a primitive.
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
