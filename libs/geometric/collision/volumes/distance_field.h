#pragma once

#include "collision/volumes/on_demand.h"
#include "collision/volumes/primitive_distance.h"
#include "collision/volumes/triangle_tree.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace handway::geometric {

class DistanceFieldGrowth;

/// A lower bound of the distance of any point from a mesh's surface, in constant
/// time.
///
/// The space around the mesh is divided into cubic cells, finer where that helps.
/// Each holds a slab: on either side of it the distance is at least that from the
/// slab. For flat and gently curved surfaces that is the distance itself, whatever
/// the cell's size. The distance from a convex piece, a triangle or a box, is convex,
/// so that its tangent in the cell's middle bounds it; a side's function is the
/// lowest of these over a tree of boxes, brought to the slope of the nearest one. If
/// that is too coarse but only a few triangles matter to a cell, the cell lists
/// these.
///
/// Primitives have distances in closed form, and no cells.
class DistanceField {
 public:
  /// The larger of front + slope · p and back - slope · p (m, p in the mesh's frame);
  /// a refined cell has children instead, a listed one a block of triangles.
  struct Cell {
    float front = 0.0F;
    float back = 0.0F;
    std::array<float, 3> slope{};

    [[nodiscard]] float bound(const Eigen::Vector3f& p) const {
      const float along = slope[0] * p.x() + slope[1] * p.y() + slope[2] * p.z();
      return std::max(front + along, back - along);
    }
    [[nodiscard]] float bound(const std::array<Eigen::Vector3f, 3>& triangle) const {
      const Eigen::Vector3f normal(slope[0], slope[1], slope[2]);
      const float a = normal.dot(triangle[0]);
      const float b = normal.dot(triangle[1]);
      const float c = normal.dot(triangle[2]);
      return std::max(front + std::min({a, b, c}), back - std::max({a, b, c}));
    }
    [[nodiscard]] bool refined() const { return front == kRefined; }
    [[nodiscard]] bool listed() const { return front == kListed; }
    [[nodiscard]] std::uint32_t index() const { return std::bit_cast<std::uint32_t>(slope[0]); }
    [[nodiscard]] static Cell marked(float mark, std::size_t index) {
      return {mark, 0.0F, {std::bit_cast<float>(static_cast<std::uint32_t>(index)), 0.0F, 0.0F}};
    }
  };
  static constexpr float kNothing = -1e30F;
  static constexpr float kRefined = -2e30F;
  static constexpr float kListed = -1e30F;
  static constexpr int kSplit = 2;  ///< Children of a cell along each axis, x fastest.
  static constexpr std::uint32_t kChildren = kSplit * kSplit * kSplit;

  DistanceField() = default;

  /// @param triangles of the mesh. @param budget approximate number of cells.
  /// @pre the mesh has a triangle.
  /// @throws PreparationStopped once `stop` is requested.
  DistanceField(const TriangleMesh& mesh, const TriangleTree& triangles, std::size_t budget,
                const std::stop_token& stop = {});

  explicit DistanceField(const PrimitiveDistance& primitive);

  /// A field without a budget, whose cells are made on access: for meshes of which only a part is
  /// ever near to other bodies.
  /// @pre the mesh has a triangle.
  [[nodiscard]] static DistanceField growing(std::shared_ptr<const TriangleMesh> mesh,
                                             OnDemand<TriangleTree> triangles);

  /// Distance function of a primitive; nothing for other meshes.
  [[nodiscard]] const std::optional<PrimitiveDistance>& primitive() const { return primitive_; }

  /// The cell of a point, null if it is outside the grid.
  struct Place {
    const Cell* cell;
    float room;  ///< m: the ball of this radius is in the cell, too.
  };
  [[nodiscard]] Place find(const Eigen::Vector3f& p) const;

  /// The bound (m) for a point in the mesh's frame; may be negative near and
  /// within the surface.
  [[nodiscard]] float bound(const Eigen::Vector3f& p) const;
  /// Returns the bound (m) of a point whose place is known.
  [[nodiscard]] float bound(const Eigen::Vector3f& p, const Place& place) const;

  /// A lower bound (m) of a triangle's distance, if it lies in one cell; else
  /// -1e30.
  [[nodiscard]] float bound(const std::array<Eigen::Vector3f, 3>& triangle) const;

  /// Box of all vertices: outside the grid, the distance from it is the bound.
  [[nodiscard]] const Eigen::Vector3f& centre() const { return centre_; }
  [[nodiscard]] const Eigen::Vector3f& half() const { return half_; }

  /// Rounding error of a bound, m: cells and triangles are in single precision.
  [[nodiscard]] float rounding() const {
    constexpr float kRounding = 1e-6F;  // of the coordinates
    return kRounding * (centre_.cwiseAbs() + half_).maxCoeff();
  }

  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  [[nodiscard]] std::size_t block_count() const { return blocks_.size(); }

 private:
  friend class DistanceFieldBuilder;
  friend class VolumeArchive;

  void lay_out(const Aabb& box);
  /// @param i coarsest cell. @param u where in it, in cells.
  [[nodiscard]] Place find_grown(const Eigen::Array3i& i, const Eigen::Array3f& u) const;

  /// Returns the index of a cell of the grid.
  [[nodiscard]] std::size_t index_of(const Eigen::Array3i& i) const {
    const Eigen::Array<std::size_t, 3, 1> wide = i.cast<std::size_t>();
    const Eigen::Array<std::size_t, 3, 1> counts = counts_.cast<std::size_t>();
    return wide.x() + counts.x() * (wide.y() + counts.y() * wide.z());
  }

  Eigen::Vector3f centre_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f half_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();  ///< Lowest corner of the grid.
  float side_ = 1.0F;                                 ///< m, of the coarsest cells.
  float per_cell_ = 1.0F;                             ///< Cells per metre of the coarsest level.
  Eigen::Array3i counts_ = Eigen::Array3i::Zero();
  std::vector<Cell> cells_;
  std::vector<TriangleBlock> blocks_;
  std::optional<PrimitiveDistance> primitive_;
  std::shared_ptr<DistanceFieldGrowth> growth_;  ///< Null: all cells exist.
};

inline DistanceField::Place DistanceField::find(const Eigen::Vector3f& p) const {
  if (primitive_) {
    return {nullptr, 0.0F};
  }
  Eigen::Array3f u = (p - origin_).array() * per_cell_;
  if ((u < 0.0F).any() || (u >= counts_.cast<float>()).any()) {
    return {nullptr, 0.0F};
  }
  float side = side_;
  Eigen::Array3i i = u.cast<int>();
  if (growth_) {
    return find_grown(i, u - i.cast<float>());
  }
  const Cell* cell = &cells_[index_of(i)];
  while (cell->refined()) {
    side /= static_cast<float>(kSplit);
    u = (u - i.cast<float>()) * static_cast<float>(kSplit);
    i = u.cast<int>().min(kSplit - 1);
    cell = &cells_[cell->index() +
                   static_cast<std::uint32_t>(i.x() + kSplit * (i.y() + kSplit * i.z()))];
  }
  u -= i.cast<float>();
  return {cell, side * std::min(u.minCoeff(), 1.0F - u.maxCoeff())};
}

inline float DistanceField::bound(const Eigen::Vector3f& p) const { return bound(p, find(p)); }

inline float DistanceField::bound(const Eigen::Vector3f& p, const Place& place) const {
  if (primitive_) {
    return primitive_->bound(p);
  }
  const float outside = ((p - centre_).cwiseAbs() - half_).cwiseMax(0.0F).norm();
  if (place.cell == nullptr) {
    return outside;
  }
  return std::max(outside, place.cell->listed() ? blocks_[place.cell->index()].distance(p)
                                                : place.cell->bound(p));
}

}  // namespace handway::geometric
