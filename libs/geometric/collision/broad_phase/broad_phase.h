#pragma once

#include "collision/volumes/sphere_tree.h"
#include "handway/geometric/collision/collision_world.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unsupported/Eigen/BVH>
#include <vector>

namespace handway::geometric {

/// Fixed bodies of a world in a tree of their boxes, so that the bodies near a place are found
/// without testing all.
class StaticBodies {
 public:
  /// @param p_WO origin of the coordinates, m.
  StaticBodies(const CollisionWorld& world, const Eigen::Vector3d& p_WO);

  /// Adds the pairs of the moving body `body` with fixed bodies nearer than `reach` (m) to
  /// `centre`, by its box along the axes of the world, and maybe some more.
  void append_near(int body, const Eigen::Vector3f& centre, float reach,
                   std::vector<int>& pairs) const;

 private:
  Eigen::KdBVH<float, 3, int> tree_;       ///< Leaves are numbers of fixed bodies.
  std::vector<std::vector<int>> pair_of_;  ///< Pair of each body and fixed body; -1: none.
};

/// Lower bounds of the distances of all pairs of a world from one volume per body: the sphere
/// around a moving body, against another such sphere or against the box of a fixed body. They are
/// computed in single precision, from an origin O near the robot; the rounding error, which grows
/// with the coordinates, is subtracted.
class BroadPhase {
 public:
  /// Positions of the spheres in one configuration.
  struct Placement {
    std::vector<float> x, y, z;       ///< m, from O; shape [moving bodies, to full lanes].
    float rounding = 0.0F;            ///< Rounding of coordinates far from O, m.
    std::vector<std::uint32_t> near;  ///< Buffer for results.
    std::vector<int> candidates;
  };

  /// @param spheres shape [bodies], around each body in its own frame.
  BroadPhase(const CollisionWorld& world, std::vector<BoundingSphere> spheres);

  [[nodiscard]] Placement placement() const;
  /// @param X_WBody shape [bodies].
  void place(std::span<const Pose> X_WBody, Placement& placement) const;

  /// Sets `pairs` to all that may be nearer than `tolerance` (m), in order.
  void find_near(Placement& placement, double tolerance, std::vector<int>& pairs) const;

  /// Returns whether both of the pair's bodies move.
  [[nodiscard]] bool both_move(int pair) const {
    return static_cast<std::size_t>(pair) < moving_pairs_;
  }

  /// A lower bound (m) of the pair's distance; negative where the volumes overlap.
  [[nodiscard]] double bound(const Placement& placement, int pair) const;

 private:
  struct Cell {
    std::size_t row;
    std::size_t column;
  };
  /// Neighbouring columns of a row, as many as are tested together.
  struct Block {
    std::size_t row;
    std::size_t first;  ///< Its first column.
  };
  /// Pairs to check: a row for each body of one kind, a column for each moving body.
  struct Table {
    Table(std::size_t row_count, std::size_t column_count);
    void add(int pair, Cell cell, float radius);
    /// Lists the blocks that have a pair. @pre all pairs were added.
    void list_blocks();
    /// Appends the pairs of the bits that are set in `near`, shape [blocks].
    void append_found(const std::uint32_t* near, std::vector<int>& found) const;

    std::size_t width;         ///< Columns, to full lanes.
    std::vector<float> radii;  ///< Shape [rows, width]: radii with rounding.
    std::vector<int> pairs;    ///< Shape [rows, width].
    std::vector<Block> blocks;
  };
  /// A fixed body's box.
  struct StillBox {
    std::array<float, 12> X_BoxO;  ///< R and p, row by row.
    std::array<float, 3> half;     ///< Halves of its edges, m.
  };
  /// @param column shape [bodies].
  void add_pair(int a, int b, const std::vector<std::size_t>& column, bool both_move,
                double padding);
  void add_box(const CollisionBody& still);
  /// Sets a bit for every column that is nearer than `within` (m); shape of `near` [blocks].
  void find_near_moving(const Placement& at, float within, std::uint32_t* near) const;
  void find_near_still(const Placement& at, float within, std::uint32_t* near) const;
  /// Appends near pairs with many fixed bodies, which are looked up in a tree.
  void append_near_still(Placement& placement, double tolerance, std::vector<int>& pairs) const;

  Eigen::Vector3d p_WO_;
  std::vector<BoundingSphere> spheres_;
  std::vector<int> bodies_;       ///< The moving bodies.
  std::vector<Cell> cells_;       ///< Cell of each pair in its table.
  float most_padding_ = 0.0F;     ///< m, of all pairs.
  std::size_t moving_pairs_ = 0;  ///< Number of pairs, at the front, of moving bodies.
  Table moving_;                  ///< Pairs of two moving bodies; those named first are the rows.
  Table still_;                   ///< Pairs of a fixed body, the row, and a moving one.
  std::vector<StillBox> boxes_;   ///< Per fixed body.
  std::vector<float> box_rounding_;   ///< Per fixed body, m.
  std::optional<StaticBodies> many_;  ///< Used for many bodies.
};

}  // namespace handway::geometric
