#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace handway::geometric {

/// Linear RGB and opacity, each in [0, 1].
struct Color {
  float red = 0.7F;
  float green = 0.7F;
  float blue = 0.7F;
  float alpha = 1.0F;

  friend bool operator==(const Color&, const Color&) = default;
};

/// A box centred in its frame; edge lengths in m.
struct Box {
  Eigen::Vector3d size{0.1, 0.1, 0.1};
};

/// A sphere centred in its frame; m.
struct Sphere {
  double radius = 0.05;
};

/// A cylinder along z, centred in its frame; m.
struct Cylinder {
  double radius = 0.05;
  double length = 0.1;
};

/// A cone along z: base disc at z = -length/2, apex at z = +length/2; m.
struct Cone {
  double radius = 0.05;
  double length = 0.1;
};

/// Triangles from a file, or from a program when `file` is empty.
struct Mesh {
  std::filesystem::path file;                       ///< Mesh file; absolute.
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< Already applied to `triangles`.
  std::shared_ptr<const TriangleMesh> triangles;    ///< Never null in a loaded scene.
};

/// Points from a file, or from a program when `file` is empty, and the cells around them, which are
/// the body. See make_cloud().
struct Cloud {
  std::filesystem::path file;                   ///< File of the points; absolute.
  CloudCells cells;                             ///< Already applied to `surface`.
  std::shared_ptr<const PointCloud> points;     ///< Never null in a loaded scene.
  std::shared_ptr<const TriangleMesh> surface;  ///< cells_around() the points; never null.
};

/// Geometry of a body.
using Shape = std::variant<Box, Sphere, Cylinder, Cone, Mesh, Cloud>;

/// "box", "sphere", "cylinder", "cone", "mesh" or "cloud": the word in scene files.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string_view shape_name(const Shape& shape);

/// Largest distance (m) of the polyhedron for a round shape from that shape.
inline constexpr double kRoundTolerance = 1e-4;

/// Returns the triangles of `shape` for collision checking. A box and a mesh are exact, a cloud has
/// its surface. A round shape becomes a polyhedron that contains the true solid and leaves it by at
/// most kRoundTolerance, or, if its radius is more than 10 m, by 1e-5 of the radius.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const TriangleMesh> tessellate(
    const Shape& shape);

/// Enlargement of a shape for collision checking, as MoveIt's link scale and padding: its size
/// times `scale` (see scaled()), and everything nearer to its surface than `distance` (m).
struct Padding {
  double scale = 1.0;
  double distance = 0.0;

  friend bool operator==(const Padding&, const Padding&) = default;
};

/// Returns the shape `scale` times as large about its own centre, a mesh or the surface of a cloud
/// (as a mesh) about the mean of its vertices.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Shape scaled(const Shape& shape, double scale);

/// Returns whether the shape has an inside: primitives and clouds do, and meshes
/// whose surface is_closed().
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_closed(const Shape& shape);

// Shapes of other programs, converted to Handway's.

/// A capsule along z, centred: its cylinder and the balls at its ends, with their poses in its
/// frame.
/// @param length m, of the cylinder alone.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::pair<Shape, Pose>> capsule_shapes(
    double radius, double length);

/// Returns a mesh around an ellipsoid with these radii (m) along its axes; it leaves the ellipsoid
/// by at most kRoundTolerance.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Mesh ellipsoid_mesh(const Eigen::Vector3d& radii);

}  // namespace handway::geometric
