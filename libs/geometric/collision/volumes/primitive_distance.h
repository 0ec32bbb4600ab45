#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace handway::geometric {

/// Distances from the surface of a primitive in closed form, in its mesh's frame, without any
/// preparation. A box is exact. The polyhedron of a round primitive lies between two primitives,
/// one around it and one within it; the result is the distance from the nearer one.
class PrimitiveDistance {
 public:
  /// @returns nothing if the mesh is neither a box along the axes of its frame nor a result of
  /// tessellate() for a round primitive.
  [[nodiscard]] static std::optional<PrimitiveDistance> of(const TriangleMesh& mesh);

  /// The box around the surface, m.
  [[nodiscard]] const Aabb& box() const { return box_; }

  /// A lower bound (m) of the distance of `p` from the surface, inside or outside.
  [[nodiscard]] float bound(const Eigen::Vector3f& p) const {
    return kind_ == Kind::kBox ? std::abs(box_distance(p)) : round_bound(p);
  }

  /// A plane that bounds the distance outside of the surface: in any point q it is at least
  /// distance + slope · (q - p).
  struct Tangent {
    float distance;  ///< m; 0 or less if `p` is not outside: then without a slope.
    Eigen::Vector3f slope;
  };
  [[nodiscard]] Tangent tangent(const Eigen::Vector3f& p) const;

  /// Returns whether a point (m) is inside; nothing if that needs the mesh.
  [[nodiscard]] std::optional<bool> contains(const Eigen::Vector3d& p) const;

 private:
  enum class Kind { kBox, kSphere, kCylinder, kCone };
  /// Half a section through the axis of a round primitive: distance from the axis, and height.
  using Section = Eigen::Vector2f;

  PrimitiveDistance(Kind kind, const Aabb& box) : kind_(kind), box_(box) {}

  /// Returns nothing if the mesh is not a round_mesh(). @param box around the mesh.
  [[nodiscard]] static std::optional<PrimitiveDistance> round_primitive(const TriangleMesh& mesh,
                                                                        const Aabb& box);
  /// Kinds and numbers of segments of a round_mesh() with the number of vertices of `mesh`.
  [[nodiscard]] static std::vector<std::pair<Kind, std::uint32_t>> possible_segments(
      const TriangleMesh& mesh);

  /// Negative inside.
  [[nodiscard]] float box_distance(const Eigen::Vector3f& p) const;
  [[nodiscard]] float round_bound(const Eigen::Vector3f& p) const;
  /// Distance from the primitive around a round one to `p`, both outside of it and in the section.
  [[nodiscard]] Section offset_from_outer(const Section& p) const;
  /// Depth (m) of `p` in the primitive within a round one; negative outside of that.
  [[nodiscard]] float depth_in_inner(const Section& p) const;

  Kind kind_;
  Aabb box_;
  Eigen::Vector3f centre_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f half_ = Eigen::Vector3f::Zero();
  float outer_ = 0.0F;  ///< Radii, m: of the round primitive around the mesh …
  float inner_ = 0.0F;  ///< … and of the one within it.
};

}  // namespace handway::geometric
