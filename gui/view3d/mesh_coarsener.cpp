#include "view3d/mesh_coarsener.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <utility>

namespace handway::gui {
namespace {

constexpr double kBorderWeight = 10.0;  // borders are seen more than what they enclose
constexpr double kHold = 1e-4;          // of a point to where it was, in the middle of planes
constexpr double kMostTurn = 0.3;       // cosine between a triangle's normals before and after

Eigen::Vector3d normal_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  return (b - a).cross(c - a);  // length: twice the area
}

}  // namespace

void MeshCoarsener::Quadric::add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point,
                                       double share) {
  const double offset = -normal.dot(point);
  A += share * normal * normal.transpose();
  b += share * offset * normal;
  c += share * offset * offset;
  weight += share;
}

void MeshCoarsener::Quadric::add_point(const Eigen::Vector3d& point, double share) {
  A.diagonal().array() += share;
  b -= share * point;
  c += share * point.squaredNorm();
}

MeshCoarsener::Quadric& MeshCoarsener::Quadric::operator+=(const Quadric& other) {
  A += other.A;
  b += other.b;
  c += other.c;
  weight += other.weight;
  return *this;
}

Eigen::Vector3d MeshCoarsener::Quadric::best_point() const { return A.ldlt().solve(-b); }

double MeshCoarsener::Quadric::mean_at(const Eigen::Vector3d& point) const {
  return std::max(point.dot(A * point) + 2.0 * b.dot(point) + c, 0.0) / weight;
}

MeshCoarsener::MeshCoarsener(const geometric::TriangleMesh& mesh)
    : origins_(mesh.vertices),
      triangles_(mesh.triangles),
      triangle_is_there_(mesh.triangles.size(), true) {
  vertices_.reserve(mesh.vertices.size());
  for (Index v = 0; v < mesh.vertices.size(); ++v) {
    vertices_.push_back({mesh.vertices[v], {}, {}, v, 0, true});
  }
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (const Index corner : triangles_[t]) {
      vertices_[corner].triangles.push_back(t);
    }
  }
  add_planes();
  add_borders();
  for (Index v = 0; v < vertices_.size(); ++v) {
    for (const Index other : neighbours(v)) {
      if (v < other) {
        offer(v, other);
      }
    }
  }
}

void MeshCoarsener::add_planes() {
  for (const auto& [a, b, c] : triangles_) {
    const Eigen::Vector3d normal =
        normal_of(vertices_[a].place, vertices_[b].place, vertices_[c].place);
    const double area = normal.norm();
    if (area > 0.0) {
      for (const Index corner : {a, b, c}) {
        vertices_[corner].quadric.add_plane(normal / area, vertices_[a].place, area);
        vertices_[corner].quadric.add_point(vertices_[corner].place, kHold * area);
      }
    }
  }
}

// Planes upright on the triangles along edges that only one triangle has.
void MeshCoarsener::add_borders() {
  std::map<std::pair<Index, Index>, std::pair<int, Index>> edges;  // passes, and a triangle there
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto& [count, triangle] = edges[std::minmax({triangles_[t][k], triangles_[t][(k + 1) % 3]})];
      ++count;
      triangle = t;
    }
  }
  for (const auto& [ends, edge] : edges) {
    if (edge.first == 1) {
      const auto& [a, b, c] = triangles_[edge.second];
      const Eigen::Vector3d along = vertices_[ends.second].place - vertices_[ends.first].place;
      const Eigen::Vector3d across =
          along.cross(normal_of(vertices_[a].place, vertices_[b].place, vertices_[c].place));
      if (across.norm() > 0.0) {
        for (const Index end : {ends.first, ends.second}) {
          vertices_[end].quadric.add_plane(across.normalized(), vertices_[end].place,
                                           kBorderWeight * along.squaredNorm());
        }
      }
    }
  }
}

std::vector<MeshCoarsener::Index> MeshCoarsener::neighbours(Index vertex) const {
  std::vector<Index> found;
  for (const Index t : vertices_[vertex].triangles) {
    for (const Index corner : triangles_[t]) {
      if (corner != vertex) {
        found.push_back(corner);
      }
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void MeshCoarsener::offer(Index from, Index to) {
  Quadric sum = vertices_[from].quadric;
  sum += vertices_[to].quadric;
  if (sum.weight > 0.0) {
    edges_.push(
        {sum.mean_at(sum.best_point()), from, to, vertices_[from].version, vertices_[to].version});
  }
}

void MeshCoarsener::offer_around(Index vertex) {
  for (const Index other : neighbours(vertex)) {
    offer(vertex, other);
  }
}

bool MeshCoarsener::turns_over(Index vertex, Index other, const Eigen::Vector3d& place) const {
  return std::ranges::any_of(vertices_[vertex].triangles, [&](Index t) {
    const std::array<Index, 3>& corners = triangles_[t];
    if (std::ranges::count(corners, other) > 0) {
      return false;  // it vanishes
    }
    const auto at = [&](std::size_t k, bool moved) -> const Eigen::Vector3d& {
      return moved && corners.at(k) == vertex ? place : vertices_[corners.at(k)].place;
    };
    const Eigen::Vector3d before = normal_of(at(0, false), at(1, false), at(2, false));
    const Eigen::Vector3d after = normal_of(at(0, true), at(1, true), at(2, true));
    return before.dot(after) <= kMostTurn * before.norm() * after.norm();
  });
}

bool MeshCoarsener::can_join(Index from, Index to, const Eigen::Vector3d& place) const {
  const auto shared = std::ranges::count_if(vertices_[from].triangles, [&](Index t) {
    return std::ranges::count(triangles_[t], to) > 0;
  });
  const std::vector<Index> a = neighbours(from), b = neighbours(to);
  std::vector<Index> common;
  std::ranges::set_intersection(a, b, std::back_inserter(common));
  return std::cmp_equal(common.size(), shared) && !turns_over(from, to, place) &&
         !turns_over(to, from, place);
}

void MeshCoarsener::join(Index from, Index to, const Eigen::Vector3d& place) {
  Vertex& gone = vertices_[from];
  Vertex& kept = vertices_[to];
  for (const Index t : gone.triangles) {
    std::array<Index, 3>& corners = triangles_[t];
    if (std::ranges::count(corners, to) > 0) {
      triangle_is_there_[t] = false;
      for (const Index corner : corners) {
        if (corner != from) {
          std::erase(vertices_[corner].triangles, t);
        }
      }
    } else {
      std::ranges::replace(corners, from, to);
      kept.triangles.push_back(t);
    }
  }
  gone.is_there = false;
  gone.triangles.clear();
  if ((origins_[gone.origin] - place).norm() < (origins_[kept.origin] - place).norm()) {
    kept.origin = gone.origin;
  }
  kept.place = place;
  kept.quadric += gone.quadric;
  ++kept.version;
}

void MeshCoarsener::coarsen(double error) {
  while (!edges_.empty() && edges_.top().cost <= error * error) {
    const Edge edge = edges_.top();
    edges_.pop();
    const Vertex& from = vertices_[edge.from];
    const Vertex& to = vertices_[edge.to];
    if (!from.is_there || !to.is_there || from.version != edge.from_version ||
        to.version != edge.to_version) {
      continue;
    }
    Quadric sum = from.quadric;
    sum += to.quadric;
    const Eigen::Vector3d place = sum.best_point();
    if (can_join(edge.from, edge.to, place)) {
      join(edge.from, edge.to, place);
      offer_around(edge.to);
    }
  }
}

MeshCoarsener::Coarse MeshCoarsener::mesh() const {
  Coarse coarse;
  geometric::TriangleMesh& mesh = coarse.mesh;
  std::vector<Index> number(vertices_.size());
  for (Index v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].is_there && !vertices_[v].triangles.empty()) {
      number[v] = static_cast<Index>(mesh.vertices.size());
      mesh.vertices.push_back(vertices_[v].place);
      coarse.origins.push_back(vertices_[v].origin);
    }
  }
  for (Index t = 0; t < triangles_.size(); ++t) {
    if (triangle_is_there_[t]) {
      const auto& [a, b, c] = triangles_[t];
      mesh.triangles.push_back({number[a], number[b], number[c]});
    }
  }
  return coarse;
}

}  // namespace handway::gui
