#include "handway/geometric/scene/mesh_topology.h"

#include <boost/container_hash/hash.hpp>
#include <boost/pending/disjoint_sets.hpp>

#include <array>
#include <cmath>
#include <unordered_map>

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

}  // namespace handway::geometric
