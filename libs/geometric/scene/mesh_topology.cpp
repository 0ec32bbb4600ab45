#include "handway/geometric/scene/mesh_topology.h"

#include <boost/container_hash/hash.hpp>
#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace handway::geometric {
namespace {

using Place = std::array<double, 3>;

Place place_of(const Eigen::Vector3d& vertex, double grid) {
  if (grid == 0.0) {
    return {vertex.x(), vertex.y(), vertex.z()};
  }
  return {std::round(vertex.x() / grid), std::round(vertex.y() / grid),
          std::round(vertex.z() / grid)};
}

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh, double grid) {
  TriangleMesh result;
  std::unordered_map<Place, std::uint32_t, boost::hash<Place>> numbers;
  std::vector<std::uint32_t> number;
  number.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const auto next = static_cast<std::uint32_t>(numbers.size());
    const auto [place, is_new] = numbers.try_emplace(place_of(vertex, grid), next);
    number.push_back(place->second);
    if (is_new) {
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
  boost::disjoint_sets_with_storage<> sets(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.union_set(a, b);
    sets.union_set(a, c);
  }
  std::unordered_map<std::size_t, std::uint32_t> numbers;
  std::vector<std::uint32_t> pieces;
  pieces.reserve(mesh.vertices.size());
  for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
    const auto next = static_cast<std::uint32_t>(numbers.size());
    pieces.push_back(numbers.try_emplace(sets.find_set(vertex), next).first->second);
  }
  return pieces;
}

TriangleMesh distinct_triangles(const TriangleMesh& mesh) {
  TriangleMesh result{mesh.vertices, {}};
  std::unordered_set<std::array<std::uint32_t, 3>, boost::hash<std::array<std::uint32_t, 3>>> seen;
  seen.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    std::array<std::uint32_t, 3> sorted = triangle;
    std::ranges::sort(sorted);
    if (sorted[0] != sorted[1] && sorted[1] != sorted[2] && seen.insert(sorted).second) {
      result.triangles.push_back(triangle);
    }
  }
  return result;
}

bool is_closed(const TriangleMesh& mesh) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back(std::minmax(triangle[k], triangle[(k + 1) % 3]));
    }
  }
  std::ranges::sort(edges);
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    if ((next - edge) % 2 != 0) {
      return false;
    }
    edge = next;
  }
  return !edges.empty();
}

}  // namespace handway::geometric
