#include "handway/geometric/mesh/triangle_mesh.h"

#include "mesh/vertex_groups.h"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace handway::geometric {
Aabb bounding_box(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) {
    return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  }
  Aabb box{mesh.vertices.front(), mesh.vertices.front()};
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    box.lower = box.lower.cwiseMin(vertex);
    box.upper = box.upper.cwiseMax(vertex);
  }
  return box;
}

TriangleMesh transformed(const TriangleMesh& mesh, const Pose& X_AB, const Eigen::Vector3d& scale) {
  TriangleMesh result = mesh;
  for (Eigen::Vector3d& vertex : result.vertices) {
    vertex = X_AB * scale.cwiseProduct(vertex);
  }
  if (scale.prod() < 0.0) {  // a mirrored mesh keeps its outward winding
    for (auto& triangle : result.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return result;
}

void append(TriangleMesh& whole, const TriangleMesh& part) {
  const auto offset = static_cast<std::uint32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& triangle : part.triangles) {
    whole.triangles.push_back({triangle[0] + offset, triangle[1] + offset, triangle[2] + offset});
  }
}

TriangleMesh welded(const TriangleMesh& mesh, double grid) {
  TriangleMesh result;
  VertexTable places;
  std::vector<std::uint32_t> number;
  number.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const auto next = static_cast<std::uint32_t>(places.vertices().size());
    number.push_back(places.number_of(
        grid == 0.0 ? vertex : Eigen::Vector3d((vertex / grid).array().round().matrix())));
    if (number.back() == next) {
      result.vertices.push_back(vertex);
    }
  }
  result.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    result.triangles.push_back({number[a], number[b], number[c]});
  }
  return result;
}

std::vector<std::uint32_t> piece_numbers(const TriangleMesh& mesh) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  boost::disjoint_sets_with_storage<> sets(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.union_set(a, b);
    sets.union_set(a, c);
  }
  std::vector<std::uint32_t> number(mesh.vertices.size(), kNone);  // of a set's representative
  std::uint32_t count = 0;
  std::vector<std::uint32_t> pieces;
  pieces.reserve(mesh.vertices.size());
  for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
    std::uint32_t& piece = number[sets.find_set(vertex)];
    if (piece == kNone) {
      piece = count++;
    }
    pieces.push_back(piece);
  }
  return pieces;
}

TriangleMesh distinct_triangles(const TriangleMesh& mesh) {
  struct Others {  // vertices of a triangle besides the lowest
    std::uint32_t middle;
    std::uint32_t highest;
    std::uint32_t triangle;
  };
  VertexGroups<Others> triangles(mesh.vertices.size(), [&](const auto& add) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      std::array<std::uint32_t, 3> sorted = mesh.triangles[t];
      std::ranges::sort(sorted);
      if (sorted[0] != sorted[1] && sorted[1] != sorted[2]) {
        add(sorted[0], Others{sorted[1], sorted[2], t});
      }
    }
  });
  std::vector<bool> is_first(mesh.triangles.size());
  const auto ends = [](const Others& others) { return std::pair(others.middle, others.highest); };
  for (std::size_t vertex = 0; vertex < triangles.size(); ++vertex) {
    const std::span<Others> group = triangles[vertex];
    std::ranges::sort(group, {}, [](const Others& others) {
      return std::array{others.middle, others.highest, others.triangle};
    });
    for (std::size_t i = 0; i < group.size(); ++i) {
      is_first[group[i].triangle] = i == 0 || ends(group[i]) != ends(group[i - 1]);
    }
  }
  TriangleMesh result{mesh.vertices, {}};
  result.triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_first[t]) {
      result.triangles.push_back(mesh.triangles[t]);
    }
  }
  return result;
}

bool is_closed(const TriangleMesh& mesh) {
  VertexGroups<std::uint32_t> edges(mesh.vertices.size(), [&](const auto& add) {
    for (const auto& triangle : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
        add(low, high);
      }
    }
  });
  for (std::size_t vertex = 0; vertex < edges.size(); ++vertex) {
    const std::span<std::uint32_t> highs = edges[vertex];
    std::ranges::sort(highs);
    for (auto edge = highs.begin(); edge != highs.end();) {
      const auto next = std::upper_bound(edge, highs.end(), *edge);
      if ((next - edge) % 2 != 0) {
        return false;
      }
      edge = next;
    }
  }
  return !mesh.triangles.empty();
}

}  // namespace handway::geometric
