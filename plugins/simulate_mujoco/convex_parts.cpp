#include "convex_parts.h"

#include "handway/geometric/mesh/convex_hull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace handway::simulate_mujoco {
namespace {

using Eigen::Vector3d;
using geometric::TriangleMesh;
using Triangle = std::array<Vector3d, 3>;

double signed_volume(const std::vector<Triangle>& triangles) {
  if (triangles.empty()) {
    return 0.0;
  }
  const Vector3d& origin = triangles.front()[0];
  double six_volumes = 0.0;
  for (const Triangle& t : triangles) {
    six_volumes += (t[0] - origin).dot((t[1] - origin).cross(t[2] - origin));
  }
  return six_volumes / 6.0;
}

double volume_of(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  return std::abs(signed_volume(triangles));
}

/// A part that may be cut further.
struct Part {
  std::vector<Triangle> triangles;  ///< Closed, if `closed`, by the faces of the cuts.
  bool closed = false;
  TriangleMesh hull;
  double hull_volume = 0.0;
  double volume = 0.0;  ///< 0 of an open surface.
  bool whole = false;   ///< No cut makes it better.

  [[nodiscard]] double excess() const { return whole ? 0.0 : hull_volume - volume; }
};

bool before(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

TriangleMesh hull_of(const std::vector<Triangle>& triangles) {
  std::vector<Vector3d> points;
  points.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    points.insert(points.end(), triangle.begin(), triangle.end());
  }
  std::ranges::sort(points, before);
  const auto repeated = std::ranges::unique(points);
  points.erase(repeated.begin(), repeated.end());
  return geometric::convex_hull(points);
}

Part part_of(std::vector<Triangle> triangles, bool closed) {
  Part part{std::move(triangles), closed, {}, 0.0, 0.0, false};
  part.hull = hull_of(part.triangles);
  part.hull_volume = volume_of(part.hull);
  part.volume = closed ? std::abs(signed_volume(part.triangles)) : 0.0;
  return part;
}

/// The plane where coordinate `axis` equals `offset` (m).
struct Plane {
  int axis = 0;
  double offset = 0.0;
};

/// Triangles on one side of a plane, closed by the face of the cut if they are of a solid.
class Side {
 public:
  /// @param sign +1: the side of larger coordinates.
  Side(const Plane& plane, double sign, double tolerance)
      : plane_(plane), sign_(sign), tolerance_(tolerance) {}

  void add(const Triangle& triangle) {
    std::array<double, 3> height{};
    std::ranges::transform(triangle, height.begin(), [&](const Vector3d& p) { return above(p); });
    if (std::ranges::all_of(height, [](double h) { return h == 0.0; })) {
      // A face in the plane belongs to the side that it bounds: its normal points away from there.
      const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
      if (sign_ * normal[plane_.axis] < 0.0) {
        add_polygon({triangle.begin(), triangle.end()});
      }
      return;
    }
    std::vector<Vector3d> kept;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      if (height[i] >= 0.0) {
        kept.push_back(triangle[i]);
      }
      if (height[i] * height[next] < 0.0) {
        kept.push_back(crossing(triangle[i], triangle[next]));
      }
    }
    if (std::ranges::any_of(kept, [&](const Vector3d& p) { return above(p) > 0.0; })) {
      add_polygon(kept);
    }
  }

  // The rim of the cut may have several loops, holes too: triangles from one of its points to each
  // of its edges have the right signed volume for all of them.
  [[nodiscard]] std::vector<Triangle> closed() && {
    if (!rim_.empty()) {
      const Vector3d centre = rim_.front().first;
      for (const auto& [from, to] : rim_) {
        triangles_.push_back({centre, to, from});
      }
    }
    return std::move(triangles_);
  }
  [[nodiscard]] std::vector<Triangle> open() && { return std::move(triangles_); }

 private:
  // The signed height; 0 for what is in the plane.
  [[nodiscard]] double above(const Vector3d& p) const {
    const double height = sign_ * (p[plane_.axis] - plane_.offset);
    return std::abs(height) <= tolerance_ ? 0.0 : height;
  }

  // Where an edge passes the plane: the same point for both of its triangles and both sides.
  [[nodiscard]] Vector3d crossing(const Vector3d& p, const Vector3d& q) const {
    const bool in_order = before(p, q);
    const Vector3d& a = in_order ? p : q;
    const Vector3d& b = in_order ? q : p;
    const double share = (plane_.offset - a[plane_.axis]) / (b[plane_.axis] - a[plane_.axis]);
    Vector3d point = a + share * (b - a);
    point[plane_.axis] = plane_.offset;
    return point;
  }

  void add_polygon(const std::vector<Vector3d>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3d& from = corners[i];
      const Vector3d& to = corners[(i + 1) % corners.size()];
      if (above(from) == 0.0 && above(to) == 0.0) {
        rim_.emplace_back(from, to);
      }
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      triangles_.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }

  Plane plane_;
  double sign_;
  double tolerance_;
  std::vector<Triangle> triangles_;
  std::vector<std::pair<Vector3d, Vector3d>> rim_;
};

std::array<Part, 2> cut(const Part& part, const Plane& plane, double tolerance) {
  Side below(plane, -1.0, tolerance);
  Side above(plane, 1.0, tolerance);
  for (const Triangle& triangle : part.triangles) {
    below.add(triangle);
    above.add(triangle);
  }
  if (part.closed) {
    return {part_of(std::move(below).closed(), true), part_of(std::move(above).closed(), true)};
  }
  return {part_of(std::move(below).open(), false), part_of(std::move(above).open(), false)};
}

// Offsets of planes across an axis that may suit: evenly spread ones, and those in which most
// corners are, as faces and edges of machined parts.
std::vector<double> offsets_across(const Part& part, int axis, double tolerance) {
  constexpr int kEven = 3;
  constexpr std::size_t kFaces = 6;
  double lower = std::numeric_limits<double>::infinity();
  double upper = -lower;
  std::map<std::int64_t, std::pair<int, double>> corners;  // by rounded coordinate
  for (const Triangle& triangle : part.triangles) {
    for (const Vector3d& p : triangle) {
      lower = std::min(lower, p[axis]);
      upper = std::max(upper, p[axis]);
      auto& [count, offset] = corners[std::llround(p[axis] / tolerance)];
      ++count;
      offset = p[axis];
    }
  }
  std::vector<double> offsets;
  for (int k = 1; k <= kEven; ++k) {
    offsets.push_back(lower + (upper - lower) * k / (kEven + 1));
  }
  std::vector<std::pair<int, double>> faces;
  const double margin = 0.02 * (upper - lower);  // no slivers
  for (const auto& [key, face] : corners) {
    if (face.second > lower + margin && face.second < upper - margin) {
      faces.push_back(face);
    }
  }
  std::ranges::stable_sort(faces, std::greater<>(), [](const auto& face) { return face.first; });
  for (std::size_t i = 0; i < std::min(kFaces, faces.size()); ++i) {
    offsets.push_back(faces[i].second);
  }
  return offsets;
}

// The cut that leaves the least volume of hulls; nothing if none leaves less than there is.
std::optional<std::array<Part, 2>> best_cut(const Part& part) {
  const geometric::Aabb box = geometric::bounding_box(part.hull);
  const double tolerance = 1e-7 * box.size().maxCoeff();
  std::optional<std::array<Part, 2>> best;
  double least = part.hull_volume - 1e-6 * part.hull_volume;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double offset : offsets_across(part, axis, tolerance)) {
      auto halves = cut(part, {axis, offset}, tolerance);
      const double left = halves[0].hull_volume + halves[1].hull_volume;
      if (left < least) {
        least = left;
        best = std::move(halves);
      }
    }
  }
  return best;
}

// The connected pieces of a mesh.
std::vector<Part> pieces(const TriangleMesh& mesh) {
  const TriangleMesh joined = geometric::distinct_triangles(geometric::welded(mesh));
  const std::vector<std::uint32_t> numbers = geometric::piece_numbers(joined);
  std::map<std::uint32_t, TriangleMesh> by_number;
  for (const auto& corners : joined.triangles) {
    by_number[numbers[corners[0]]].triangles.push_back(corners);
  }
  std::vector<Part> parts;
  for (auto& [number, piece] : by_number) {
    piece.vertices = joined.vertices;
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : piece.triangles) {
      triangles.push_back({joined.vertices[a], joined.vertices[b], joined.vertices[c]});
    }
    if (signed_volume(triangles) < 0.0) {  // wound the other way
      std::ranges::for_each(triangles, [](Triangle& t) { std::swap(t[1], t[2]); });
    }
    parts.push_back(part_of(std::move(triangles), geometric::is_closed(piece)));
  }
  return parts;
}

}  // namespace

std::vector<ConvexPart> convex_parts(const TriangleMesh& mesh, const ConvexPartsLimits& limits) {
  std::vector<Part> parts = pieces(mesh);
  double volume = 0.0;
  double excess = 0.0;
  for (const Part& part : parts) {
    volume += part.volume;
    excess += part.excess();
  }
  while (!parts.empty() && static_cast<int>(parts.size()) < limits.most &&
         excess > limits.excess * volume) {
    const auto worst = std::ranges::max_element(parts, {}, &Part::excess);
    if (worst->excess() <= 0.0) {
      break;
    }
    excess -= worst->excess();
    if (auto halves = best_cut(*worst)) {
      excess += (*halves)[0].excess() + (*halves)[1].excess();
      *worst = std::move((*halves)[0]);
      parts.push_back(std::move((*halves)[1]));
    } else {
      worst->whole = true;
    }
  }
  std::vector<ConvexPart> result;
  for (Part& part : parts) {
    if (part.hull_volume > 0.0) {  // flat ones have none
      result.push_back({std::move(part.hull.vertices), part.hull_volume});
    }
  }
  return result;
}

double enclosed_volume(const TriangleMesh& mesh) { return volume_of(mesh); }

}  // namespace handway::simulate_mujoco
