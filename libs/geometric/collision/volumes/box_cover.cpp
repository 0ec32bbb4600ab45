#include "collision/volumes/box_cover.h"

#include "collision/volumes/box_tree.h"
#include "collision/volumes/free_space.h"
#include "collision/volumes/vector_units.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace handway::geometric {
namespace {

constexpr std::size_t kPieces = 8;        // of a mesh that have boxes
constexpr std::size_t kDirections = 200;  // of the largest triangles that are looked at
constexpr double kSame = 1e-3;            // rad: faces that are across one axis
constexpr double kSideRounding = 2e-6;    // of the coordinates: more than single precision loses
constexpr float kNever = -1e30F;          // half a box that nothing is in
constexpr std::size_t kSeeds = 24;        // places that each box is grown from
constexpr double kHair = 2e-6;            // m: boxes are at least so far from the surface
constexpr double kLeastShare = 0.005;  // of the space on its side: smaller boxes are not worth it

using Block = FreeSpace::Block;
using Index = FreeSpace::Index;

BoxCover::Boxes no_boxes() {
  BoxCover::Boxes boxes;
  for (std::array<float, BoxCover::kMost>& half : boxes.half) {
    half.fill(kNever);
  }
  return boxes;
}

// Rounded so that nothing is in it that is not in `box`.
void store(const Aabb& box, BoxCover::Boxes& boxes, std::size_t k) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double centre = box.centre()[i];
    const double half = 0.5 * box.size()[i];
    boxes.centre[axis][k] = static_cast<float>(centre);
    boxes.half[axis][k] = static_cast<float>(half - kSideRounding * (std::abs(centre) + half));
  }
}

// Rounded so that all of `box` is in it.
void store_around(const Aabb& box, BoxCover& boxes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double half = 0.5 * box.size()[i];
    boxes.centre[axis] = static_cast<float>(box.centre()[i]);
    boxes.half[axis] =
        static_cast<float>(half + kSideRounding * (std::abs(box.centre()[i]) + half));
  }
}

// Fills one side of a surface with the largest boxes there are.
class Filling {
 public:
  Filling(const FreeSpace& space, bool inside) : space_(space), counts_(space.counts()) {
    for (std::size_t cell = 0; cell < space.cell_count(); ++cell) {
      if (space.is_inside(cell) == inside) {
        open_.push_back(cell);
        whole_ += space.volume(space.block_of(cell));
      }
    }
    sum_up(inside);
  }

  [[nodiscard]] BoxCover::Boxes boxes() {
    BoxCover::Boxes boxes = no_boxes();
    for (std::size_t k = 0; k < BoxCover::kMost && !open_.empty(); ++k) {
      const Block best = largest();
      if (space_.volume(best) < kLeastShare * whole_) {
        break;
      }
      store(space_.box(best), boxes, k);
      std::erase_if(open_, [&](std::size_t cell) { return contains(best, cell); });
    }
    return boxes;
  }

 private:
  // Of those grown from cells all over what no box has yet.
  [[nodiscard]] Block largest() const {
    const std::size_t stride = std::max<std::size_t>(1, open_.size() / kSeeds);
    Block best = space_.block_of(open_.front());
    for (std::size_t k = stride / 2; k < open_.size(); k += stride) {
      const Block grown = grow(space_.block_of(open_[k]));
      if (space_.volume(grown) > space_.volume(best)) {
        best = grown;
      }
    }
    return best;
  }

  // Takes in the layer that adds most, again and again; at last what is beside the surface's box.
  [[nodiscard]] Block grow(Block block) const {
    while (true) {
      std::optional<Block> best;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const bool up : {false, true}) {
          Block next = block;
          (up ? next.end[axis] : next.first[axis]) += up ? 1 : -1;
          if (next.first[axis] >= 0 && next.end[axis] <= counts_[axis] && is_free(next) &&
              (!best || is_larger(next, *best))) {
            best = next;
          }
        }
      }
      if (!best) {
        return block;
      }
      block = *best;
    }
  }

  [[nodiscard]] bool is_larger(const Block& a, const Block& b) const {
    const auto sizes = [this](const Block& block) {
      return std::pair(space_.volume(block), space_.box(block).size().prod());
    };
    return sizes(a) > sizes(b);
  }

  // How many cells below each corner of the grid are not on that side (a summed-volume table).
  void sum_up(bool inside) {
    const auto wide = [](int n) { return static_cast<std::size_t>(n) + 1; };
    sums_.assign(wide(counts_[0]) * wide(counts_[1]) * wide(counts_[2]), 0);
    for (int z = 1; z <= counts_[2]; ++z) {
      for (int y = 1; y <= counts_[1]; ++y) {
        for (int x = 1; x <= counts_[0]; ++x) {
          const bool other = space_.is_inside(space_.cell_at({x - 1, y - 1, z - 1})) != inside;
          sums_[corner_at({x, y, z})] = (other ? 1 : 0) + sum(x - 1, y, z) + sum(x, y - 1, z) +
                                        sum(x, y, z - 1) - sum(x - 1, y - 1, z) -
                                        sum(x - 1, y, z - 1) - sum(x, y - 1, z - 1) +
                                        sum(x - 1, y - 1, z - 1);
        }
      }
    }
  }

  [[nodiscard]] int sum(int x, int y, int z) const { return sums_[corner_at({x, y, z})]; }

  [[nodiscard]] std::size_t corner_at(const Index& i) const {
    const auto wide = [](int n) { return static_cast<std::size_t>(n); };
    return wide(i[0]) + wide(counts_[0] + 1) * (wide(i[1]) + wide(counts_[1] + 1) * wide(i[2]));
  }

  // Whether all of its cells are on that side.
  [[nodiscard]] bool is_free(const Block& block) const {
    const auto& [x, y, z] = block.first;
    const auto& [u, v, w] = block.end;
    return sum(u, v, w) - sum(x, v, w) - sum(u, y, w) - sum(u, v, z) + sum(x, y, w) + sum(x, v, z) +
               sum(u, y, z) - sum(x, y, z) ==
           0;
  }

  [[nodiscard]] bool contains(const Block& block, std::size_t cell) const {
    const Index i = space_.block_of(cell).first;
    return i[0] >= block.first[0] && i[0] < block.end[0] && i[1] >= block.first[1] &&
           i[1] < block.end[1] && i[2] >= block.first[2] && i[2] < block.end[2];
  }

  const FreeSpace& space_;
  const Index& counts_;
  std::vector<std::size_t> open_;  ///< Cells that no box has yet.
  double whole_ = 0.0;             ///< m³
  std::vector<int> sums_;
};

// The direction that most of the area is across, of faces at a right angle to `other`.
Eigen::Vector3d most_faced(const TriangleMesh& piece, const Eigen::Vector3d& other) {
  std::vector<Eigen::Vector3d> areas;
  for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) {
    const auto [a, b, c] = corners(piece, t);
    const Eigen::Vector3d area = (b - a).cross(c - a);
    if (area.norm() > 0.0 && std::abs(area.normalized().dot(other)) < kSame) {
      areas.push_back(area);
    }
  }
  std::ranges::sort(areas, std::ranges::greater(), &Eigen::Vector3d::squaredNorm);
  areas.resize(std::min(areas.size(), kDirections));
  Eigen::Vector3d best = other.isZero() ? Eigen::Vector3d::UnitZ() : other.unitOrthogonal();
  double most = 0.0;
  for (const Eigen::Vector3d& area : areas) {
    const Eigen::Vector3d direction = area.normalized();
    double sum = 0.0;
    for (const Eigen::Vector3d& part : areas) {
      sum += part.cross(direction).norm() < kSame * part.norm() ? part.norm() : 0.0;
    }
    if (sum > most) {
      most = sum;
      best = direction;
    }
  }
  return best;
}

Eigen::Matrix3d frame_of(const TriangleMesh& piece) {
  const Eigen::Vector3d z = most_faced(piece, Eigen::Vector3d::Zero());
  const Eigen::Vector3d x = z.cross(most_faced(piece, z)).normalized();
  Eigen::Matrix3d R_PB;
  R_PB << x.transpose(), z.cross(x).transpose(), z.transpose();
  return R_PB;
}

BoxCover boxes_of(const TriangleMesh& piece) {
  const Eigen::Matrix3d R_PB = frame_of(piece);
  const TriangleMesh turned = transformed(piece, Pose(R_PB));
  BoxCover boxes{};
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(boxes.R_PB.data()) = R_PB.cast<float>();
  store_around(bounding_box(turned), boxes);
  const FreeSpace space(turned);
  boxes.inside = Filling(space, true).boxes();
  boxes.outside = Filling(space, false).boxes();
  return boxes;
}

}  // namespace

SurfaceSides make_box_cover(const std::vector<TriangleMesh>& pieces) {
  SurfaceSides sides;
  for (const TriangleMesh& piece : pieces) {
    if (sides.pieces.size() < kPieces && is_closed(piece)) {
      sides.pieces.push_back(boxes_of(piece));
    }
  }
  sides.has_all = sides.pieces.size() == pieces.size();
  return sides;
}

SurfaceSides make_box_cover(const PrimitiveDistance& primitive) {
  BoxCover boxes{};
  boxes.R_PB = {1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F};
  store_around(primitive.box(), boxes);
  boxes.inside = no_boxes();
  boxes.outside = no_boxes();
  std::size_t count = 0;
  for (Aabb box : primitive.inner_boxes()) {
    box.lower.array() += kHair;
    box.upper.array() -= kHair;
    store(box, boxes.inside, count++);
  }
  return {{boxes}, true};
}

namespace {

// A piece's vertices and the middles of its triangles.
std::vector<Eigen::Vector3d> candidates(const TriangleMesh& piece) {
  std::vector<Eigen::Vector3d> points = piece.vertices;
  for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) {
    const auto [a, b, c] = corners(piece, t);
    points.emplace_back((a + b + c) / 3.0);
  }
  return points;
}

}  // namespace

// Each point is the farthest from those before it.
SurfacePoints::SurfacePoints(const TriangleMesh& piece) {
  const std::vector<Eigen::Vector3d> points = candidates(piece);
  std::vector<double> distances(points.size(), std::numeric_limits<double>::max());
  std::size_t next = 0;
  for (std::size_t k = 0; k < kCount; ++k) {
    const Eigen::Vector3d& p = points[next];
    x[k] = static_cast<float>(p.x());
    y[k] = static_cast<float>(p.y());
    z[k] = static_cast<float>(p.z());
    for (std::size_t i = 0; i < points.size(); ++i) {
      distances[i] = std::min(distances[i], (points[i] - p).squaredNorm());
    }
    next = static_cast<std::size_t>(std::ranges::max_element(distances) - distances.begin());
  }
}

namespace {

using Rotation = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
using Boxes = BoxCover::Boxes;

constexpr std::size_t kCount = SurfacePoints::kCount;
constexpr std::size_t kBoxes = BoxCover::kMost;

HANDWAY_VECTOR_UNITS void move(const SurfacePoints& points, const float* R, const float* p,
                               SurfacePoints& moved) {
  for (std::size_t k = 0; k < kCount; ++k) {
    moved.x[k] = p[0] + R[0] * points.x[k] + R[1] * points.y[k] + R[2] * points.z[k];
    moved.y[k] = p[1] + R[3] * points.x[k] + R[4] * points.y[k] + R[5] * points.z[k];
    moved.z[k] = p[2] + R[6] * points.x[k] + R[7] * points.y[k] + R[8] * points.z[k];
  }
}

struct LocalBox {
  std::array<float, 3> centre;
  std::array<float, 3> half;
};

// How many points are in the box.
HANDWAY_VECTOR_UNITS std::uint32_t count_in(const SurfacePoints& points, const LocalBox& box) {
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
HANDWAY_VECTOR_UNITS float depth_in(const LocalBox& box, const Boxes& boxes) {
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

LocalBox box_of(const Boxes& boxes, std::size_t k, float gain) {
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

bool pierces(const SurfacePoints& a, const BoundingSphere& around, const BoxCover& b,
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

float gap_outside(const Eigen::Vector3f& centre, const Eigen::Vector3f& half, const BoxCover& b,
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
  return std::ranges::any_of(b.pieces,
                             [&](const BoxCover& piece) { return pierces(a, moved, piece, X_BA); });
}

float gap_outside(const Eigen::Vector3f& centre, const Eigen::Vector3f& half, const SurfaceSides& b,
                  const FloatPose& X_BA) {
  if (!b.has_all) {
    return 0.0F;
  }
  float least = std::numeric_limits<float>::max();
  for (const BoxCover& piece : b.pieces) {
    least = std::min(least, gap_outside(centre, half, piece, X_BA));
  }
  return least;
}

}  // namespace handway::geometric
