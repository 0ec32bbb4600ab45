#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Core>

namespace handway::planning {

/// A line through the material of an object, from surface to surface: a place to hold it at. In the
/// object's frame.
struct Chord {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();      ///< Its middle, m.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< Unit vector.
  double length = 0.0;                                   ///< m
};

/// Draws places to hold an object at from all over its surface: sides of it that look away from
/// each other, however the object is bent. For any thread.
class ObjectChords {
 public:
  /// @param mesh with at least one triangle; of an open one the triangles' order of vertices gives
  /// the outside.
  explicit ObjectChords(const geometric::TriangleMesh& mesh);

  /// Draws a chord that begins anywhere on the surface, evenly, and goes straight into the object;
  /// if there are several surfaces behind each other, to any of those with an opposed normal.
  /// @returns a length of 0 if there is no such surface.
  [[nodiscard]] Chord draw(sampling::RandomStream& random) const;

  /// The box around the surface near a point, `radius` (m) around it, less half its shortest side
  /// all around: what fingers close around when they hold the object there. m, object's frame.
  [[nodiscard]] geometric::Aabb core(const Eigen::Vector3d& point, double radius) const;

 private:
  [[nodiscard]] Chord chord_from(Eigen::Index point, sampling::RandomStream& random) const;

  Eigen::Matrix3Xd points_;   ///< Evenly on the surface, m.
  Eigen::Matrix3Xd normals_;  ///< Out of the object there.
  double spacing_ = 0.0;      ///< m, between them.
};

}  // namespace handway::planning
