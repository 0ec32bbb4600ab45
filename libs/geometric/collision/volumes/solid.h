#pragma once

#include "collision/volumes/box_tree.h"
#include "collision/volumes/on_demand.h"
#include "collision/volumes/primitive_distance.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_description.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace handway::geometric {

/// The sides of a closed surface, by the cells of a regular grid around it. Cells that the surface
/// does not enter are inside or outside as a whole: one test point per cell decides.
class SideGrid {
 public:
  /// @param box around the surface.
  SideGrid(const TriangleMesh& surface, const Aabb& box);

  /// Returns whether `p`, in the box, is inside. @param find decides it for any point; called in
  /// cells that the surface enters, and once in every other cell.
  [[nodiscard]] bool is_inside(const Eigen::Vector3d& p,
                               const std::function<bool(const Eigen::Vector3d&)>& find) const;

 private:
  enum class Side : std::uint8_t { kUnknown, kInside, kOutside, kBoth };
  using Index = Eigen::Array3i;

  [[nodiscard]] Index index_of(const Eigen::Vector3d& p) const;
  [[nodiscard]] std::size_t number_of(const Index& cell) const;

  Eigen::Vector3d lower_;
  double edge_;  ///< Edge of a cell, m.
  Index count_;
  mutable std::vector<std::atomic<Side>> sides_;  ///< Per cell.
};

/// The inside of a closed surface. Every connected piece of the surface is a solid of its own: a
/// point inside any piece is inside, also where a piece lies in another one.
class Solid {
 public:
  /// @param surface with a triangle; welded(), distinct_triangles() and is_closed().
  explicit Solid(TriangleMesh surface);

  /// Around the surface.
  [[nodiscard]] const Aabb& box() const { return box_; }

  /// @param p m, in the surface's frame; the result is arbitrary for a point on the surface to
  /// within rounding.
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const;

  /// Prepares contains() for a mesh that isn't large; else the first point does.
  void prepare() const;

 private:
  /// Connected pieces that rays are counted by.
  struct Pieces {
    Pieces(const TriangleMesh& surface, const Aabb& box);

    SideGrid sides;
    BoxTree tree;
    std::vector<std::uint32_t> piece_of;  ///< Shape [triangles].
    /// Shape [pieces]: true if neighbours are wound consistently; then windings give the inside
    /// also where a piece intersects itself.
    std::vector<bool> is_oriented;
  };

  [[nodiscard]] bool is_within_windings(const Eigen::Vector3d& p) const;

  std::shared_ptr<const TriangleMesh> surface_;
  Aabb box_;
  std::optional<PrimitiveDistance> primitive_;
  OnDemand<Pieces> pieces_;
};

/// Data of a body that containment tests need.
struct BodySolids {
  struct Part {
    Pose X_GB;  ///< The body's frame in the solid's.
    std::shared_ptr<const Solid> solid;
  };
  std::vector<Part> parts;              ///< Its closed shapes, if they are filled, …
  std::vector<Part> shells;             ///< … and if they are hollow.
  std::vector<Eigen::Vector3d> points;  ///< One point of each connected piece, m.
  Aabb box;                             ///< Around the parts, m.

  /// @param p m, in the body's frame.
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const;
};

/// @param shapes of one body; X_LG is the pose in the body's frame.
/// @param solid whether closed shapes are filled; else they are surfaces, as open ones are.
[[nodiscard]] std::shared_ptr<const BodySolids> make_body_solids(
    std::span<const LinkGeometry> shapes, bool solid = true);

/// Returns whether a connected piece of `inner` is inside of `outer`.
/// @param X_OI pose of the inner body in the outer one's frame.
/// @pre the surfaces do not touch: so every piece is inside or outside as a whole.
[[nodiscard]] bool is_inside(const BodySolids& inner, const BodySolids& outer, const Pose& X_OI);

/// Returns whether a piece of either body is inside of the other. @pre as of is_inside().
[[nodiscard]] bool contain_each_other(const BodySolids& a, const Pose& X_WA, const BodySolids& b,
                                      const Pose& X_WB);

}  // namespace handway::geometric
