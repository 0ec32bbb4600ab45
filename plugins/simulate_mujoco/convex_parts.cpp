#include "convex_parts.h"

#include "handway/geometric/mesh/convex_hull.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace handway::simulate_mujoco {
namespace {

using Eigen::Vector3d;
using geometric::TriangleMesh;
using Triangle = std::array<Vector3d, 3>;

// Returns the volume of the space between the triangles and the origin.
double signed_volume(const std::vector<Triangle>& triangles) {
  double six_volumes = 0.0;
  for (const Triangle& t : triangles) {
    six_volumes += t[0].dot(t[1].cross(t[2]));
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

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 *
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  }
  return area;
}

/// From one point to another.
using Segment = std::pair<Vector3d, Vector3d>;

/// The flat face of a cut, given by its rim: loops around the face and its holes, counterclockwise
/// and clockwise seen from outside of the part, as segments in any order.
using Cap = std::vector<Segment>;

// Of the space between a cap and the origin: that of triangles from any point of its plane to its
// rim, those across holes included, which count negative.
double signed_volume(const Cap& cap) {
  double six_volumes = 0.0;
  for (const auto& [from, to] : cap) {
    six_volumes += cap.front().first.dot(from.cross(to));
  }
  return six_volumes / 6.0;
}

Vector3d normal_of(const Cap& cap) {
  Vector3d normal = Vector3d::Zero();
  for (const auto& [from, to] : cap) {
    normal += (from - cap.front().first).cross(to - cap.front().first);
  }
  return normal;
}

/// A part that may be cut further.
struct Part {
  std::vector<Triangle> surface;  ///< Triangles of the mesh.
  std::vector<Cap> caps;          ///< Faces of the cuts of a solid, which close it.
  bool closed = false;
  TriangleMesh hull;
  double hull_volume = 0.0;
  double hull_area = 0.0;
  double volume = 0.0;  ///< 0 of an open surface.

  [[nodiscard]] double excess() const { return hull_volume - volume; }
  [[nodiscard]] double depth() const { return hull_area > 0.0 ? excess() / hull_area : 0.0; }
};

bool before(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

TriangleMesh hull_of(const std::vector<Triangle>& surface, const std::vector<Cap>& caps) {
  std::vector<Vector3d> points;
  for (const Triangle& triangle : surface) {
    points.insert(points.end(), triangle.begin(), triangle.end());
  }
  for (const Cap& cap : caps) {
    for (const auto& [from, to] : cap) {
      points.insert(points.end(), {from, to});
    }
  }
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return geometric::convex_hull(points);
}

Part part_of(std::vector<Triangle> surface, std::vector<Cap> caps, bool closed) {
  Part part{std::move(surface), std::move(caps), closed, {}, 0.0, 0.0, 0.0};
  part.hull = hull_of(part.surface, part.caps);
  part.hull_volume = volume_of(part.hull);
  part.hull_area = area_of(part.hull);
  if (closed) {
    double volume = signed_volume(part.surface);
    for (const Cap& cap : part.caps) {
      volume += signed_volume(cap);
    }
    part.volume = std::abs(volume);
  }
  return part;
}

/// The points p with normal · p = offset (m).
struct Plane {
  Vector3d normal;  ///< A unit vector.
  double offset = 0.0;
};

/// The piece of a part on one side of a plane.
class Side {
 public:
  /// @param sign +1: the side that the plane's normal points to.
  Side(const Plane& plane, double sign, double tolerance)
      : plane_(plane), sign_(sign), tolerance_(tolerance) {}

  [[nodiscard]] Part of(const Part& part) && {
    std::vector<Triangle> surface;
    for (const Triangle& triangle : part.surface) {
      add(triangle, surface);
    }
    std::vector<Cap> caps;
    for (const Cap& cap : part.caps) {
      add(cap, caps);
    }
    if (part.closed && !rim_.empty()) {
      caps.push_back(std::move(rim_));
    }
    return part_of(std::move(surface), std::move(caps), part.closed);
  }

 private:
  void add(const Triangle& triangle, std::vector<Triangle>& kept) {
    std::array<double, 3> height{};
    std::ranges::transform(triangle, height.begin(), [&](const Vector3d& p) { return above(p); });
    std::vector<Vector3d> corners;
    if (std::ranges::all_of(height, is_zero)) {
      if (is_bounded_by((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]))) {
        corners.assign(triangle.begin(), triangle.end());
      }
    } else if (std::ranges::any_of(height, [](double h) { return h > 0.0; })) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (height[i] >= 0.0) {
          corners.push_back(triangle[i]);
        }
        if (height[i] * height[next] < 0.0) {
          corners.push_back(crossing(triangle[i], triangle[next]));
        }
      }
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      note_rim(corners[i], corners[(i + 1) % corners.size()]);
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      kept.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }

  void add(const Cap& cap, std::vector<Cap>& caps) {
    const auto is_in_plane = [&](const Segment& segment) {
      return above(segment.first) == 0.0 && above(segment.second) == 0.0;
    };
    Cap kept;
    if (std::ranges::all_of(cap, is_in_plane)) {
      if (is_bounded_by(normal_of(cap))) {
        kept = cap;
      }
    } else if (std::ranges::any_of(
                   cap, [&](const Segment& segment) { return above(segment.first) > 0.0; })) {
      kept = clipped(cap);
    }
    for (const auto& [from, to] : kept) {
      note_rim(from, to);
    }
    if (!kept.empty()) {
      caps.push_back(std::move(kept));
    }
  }

  // The part of a cap on this side: its rim as far as it is here, closed along the plane. Where the
  // rim leaves this side it goes along the plane to where it comes back.
  [[nodiscard]] Cap clipped(const Cap& cap) const {
    const Vector3d along = normal_of(cap).cross(plane_.normal).normalized();
    std::vector<Turn> turns;
    Cap kept;
    for (const auto& [from, to] : cap) {
      const double begin = above(from);
      const double end = above(to);
      if (begin >= 0.0 && end >= 0.0) {
        kept.emplace_back(from, to);
      } else if (begin >= 0.0) {
        const Vector3d leaves = begin > 0.0 ? crossing(from, to) : from;
        kept.emplace_back(from, leaves);
        turns.push_back({leaves, along.dot(leaves), 1});
      } else if (end >= 0.0) {
        const Vector3d returns = end > 0.0 ? crossing(from, to) : to;
        kept.emplace_back(returns, to);
        turns.push_back({returns, along.dot(returns), -1});
      }
    }
    std::ranges::stable_sort(turns, {}, &Turn::place);
    int flow = 0;  // rims on their way from one turn to the next; negative: backwards
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
      flow += turns[i].flow;
      const Vector3d& here = turns[i].point;
      const Vector3d& next = turns[i + 1].point;
      for (int k = 0; k < std::abs(flow); ++k) {
        kept.push_back(flow > 0 ? Segment(here, next) : Segment(next, here));
      }
    }
    std::erase_if(kept, [](const Segment& segment) { return segment.first == segment.second; });
    return kept;
  }

  /// Where the rim of a cap leaves this side (flow 1) or returns (-1).
  struct Turn {
    Vector3d point;
    double place;  ///< Along the plane, m.
    int flow;
  };

  // A face in the plane belongs to the side that it bounds: its normal points away from there.
  [[nodiscard]] bool is_bounded_by(const Vector3d& normal) const {
    return sign_ * normal.dot(plane_.normal) < 0.0;
  }

  static bool is_zero(double height) { return height == 0.0; }

  // The signed height; 0 for what is in the plane.
  [[nodiscard]] double above(const Vector3d& p) const {
    const double height = sign_ * (plane_.normal.dot(p) - plane_.offset);
    return std::abs(height) <= tolerance_ ? 0.0 : height;
  }

  // Where an edge passes the plane: the same point for both of its triangles and both sides.
  [[nodiscard]] Vector3d crossing(const Vector3d& p, const Vector3d& q) const {
    const bool in_order = before(p, q);
    const Vector3d& a = in_order ? p : q;
    const Vector3d& b = in_order ? q : p;
    const double share = (plane_.offset - plane_.normal.dot(a)) / plane_.normal.dot(b - a);
    return a + share * (b - a);
  }

  // An edge of a kept face that lies in the plane bounds the new cap, which passes it the other
  // way.
  void note_rim(const Vector3d& from, const Vector3d& to) {
    if (above(from) == 0.0 && above(to) == 0.0) {
      rim_.emplace_back(to, from);
    }
  }

  Plane plane_;
  double sign_;
  double tolerance_;
  Cap rim_;
};

using Halves = std::array<Part, 2>;

Halves cut(const Part& part, const Plane& plane, double tolerance) {
  return {Side(plane, -1.0, tolerance).of(part), Side(plane, 1.0, tolerance).of(part)};
}

// Planes across an axis of the mesh in which most corners are, as faces and edges of machined
// parts.
std::vector<Plane> faces_across(const Part& part, int axis, double tolerance) {
  constexpr std::size_t kMost = 4;
  double lower = std::numeric_limits<double>::infinity();
  double upper = -lower;
  std::map<std::int64_t, std::pair<int, double>> corners;  // by rounded coordinate
  for (const Triangle& triangle : part.surface) {
    for (const Vector3d& p : triangle) {
      lower = std::min(lower, p[axis]);
      upper = std::max(upper, p[axis]);
      auto& [count, offset] = corners[std::llround(p[axis] / tolerance)];
      ++count;
      offset = p[axis];
    }
  }
  std::vector<std::pair<int, double>> faces;
  const double margin = 0.02 * (upper - lower);  // no slivers
  for (const auto& [key, face] : corners) {
    if (face.second > lower + margin && face.second < upper - margin) {
      faces.push_back(face);
    }
  }
  std::ranges::stable_sort(faces, std::greater<>(), [](const auto& face) { return face.first; });
  faces.resize(std::min(kMost, faces.size()));
  std::vector<Plane> planes(faces.size());
  std::ranges::transform(faces, planes.begin(), [axis](const auto& face) {
    return Plane{Vector3d::Unit(axis), face.second};
  });
  return planes;
}

// Planes through the middle of a part: across the axes of the mesh through the middle of its box,
// across its own principal axes through its centre.
std::vector<Plane> middle_planes(const Part& part) {
  std::vector<Plane> planes;
  planes.reserve(6);
  const Vector3d middle = geometric::bounding_box(part.hull).centre();
  for (int axis = 0; axis < 3; ++axis) {
    planes.push_back({Vector3d::Unit(axis), middle[axis]});
  }
  double area = 0.0;
  Vector3d centre = Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const bool centred : {false, true}) {
    for (const Triangle& t : part.surface) {
      const double share = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
      const Vector3d p = (t[0] + t[1] + t[2]) / 3.0;
      if (centred) {
        spread += share * (p - centre) * (p - centre).transpose();
      } else {
        area += share;
        centre += share * p;
      }
    }
    centre /= centred ? 1.0 : area;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d normal = axes.eigenvectors().col(axis);
    planes.push_back({normal, normal.dot(centre)});
  }
  return planes;
}

double hull_volume(const Halves& halves) { return halves[0].hull_volume + halves[1].hull_volume; }

double tolerance_of(const Part& part) {
  return 1e-7 * geometric::bounding_box(part.hull).size().maxCoeff();
}

// The cut that leaves the least volume of hulls; nothing if none leaves less than there is.
std::optional<Halves> best_cut(const Part& part) {
  const double tolerance = tolerance_of(part);
  std::vector<Plane> planes = middle_planes(part);
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::copy(faces_across(part, axis, tolerance), std::back_inserter(planes));
  }
  std::optional<Halves> best;
  double least = part.hull_volume - 1e-3 * part.excess();
  for (const Plane& plane : planes) {
    Halves halves = cut(part, plane, tolerance);
    if (hull_volume(halves) < least) {
      least = hull_volume(halves);
      best = std::move(halves);
    }
  }
  return best;
}

// The least volume of hulls after a cut through the middle.
double least_after_a_cut(const Part& part) {
  double least = part.hull_volume;
  if (!part.hull.empty()) {
    for (const Plane& plane : middle_planes(part)) {
      least = std::min(least, hull_volume(cut(part, plane, tolerance_of(part))));
    }
  }
  return least;
}

// One cut through a ring leaves what there is; the second one helps. Of the cuts through the middle
// this is the one after which the next leaves least.
Halves cut_before_the_next(const Part& part) {
  Halves best;
  double least = std::numeric_limits<double>::infinity();
  for (const Plane& plane : middle_planes(part)) {
    Halves halves = cut(part, plane, tolerance_of(part));
    const double left = least_after_a_cut(halves[0]) + least_after_a_cut(halves[1]);
    if (left < least) {
      least = left;
      best = std::move(halves);
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
    parts.push_back(part_of(std::move(triangles), {}, geometric::is_closed(piece)));
  }
  return parts;
}

}  // namespace

std::vector<ConvexPart> convex_parts(const TriangleMesh& mesh, const ConvexPartsLimits& limits) {
  std::vector<Part> parts = pieces(mesh);
  const auto to_cut = [&](const Part& part) {
    return part.depth() > limits.depth ? part.excess() : 0.0;
  };
  while (!parts.empty() && static_cast<int>(parts.size()) < limits.most) {
    const auto worst = std::ranges::max_element(parts, {}, to_cut);
    if (to_cut(*worst) <= 0.0) {
      break;
    }
    std::optional<Halves> best = best_cut(*worst);
    Halves halves = best ? std::move(*best) : cut_before_the_next(*worst);
    *worst = std::move(halves[0]);
    parts.push_back(std::move(halves[1]));
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
