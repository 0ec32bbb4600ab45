#include "collision/mesh_pieces.h"

#include "handway/geometric/scene/mesh_topology.h"

#include <algorithm>
#include <array>
#include <map>

namespace handway::geometric {
namespace {

TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  TriangleMesh part;
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (const std::uint32_t number : triangles) {
    std::array<std::uint32_t, 3> triangle = mesh.triangles[number];
    for (std::uint32_t& vertex : triangle) {
      const auto next = static_cast<std::uint32_t>(numbers.size());
      const auto [place, is_new] = numbers.try_emplace(vertex, next);
      if (is_new) {
        part.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = place->second;
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

}  // namespace

std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh) {
  TriangleMesh whole = distinct_triangles(welded(mesh));
  if (whole.empty()) {
    whole = welded(mesh);  // nothing but lines and points
  }
  const std::vector<std::uint32_t> piece_of = piece_numbers(whole);
  std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    parts[piece_of[whole.triangles[t][0]]].push_back(t);
  }
  std::vector<TriangleMesh> pieces;
  pieces.reserve(parts.size());
  for (const auto& [number, triangles] : parts) {
    pieces.push_back(part_of(whole, triangles));
  }
  std::ranges::stable_sort(pieces, std::ranges::greater(), [](const TriangleMesh& piece) {
    return bounding_box(piece).size().norm();
  });
  return pieces;
}

}  // namespace handway::geometric
