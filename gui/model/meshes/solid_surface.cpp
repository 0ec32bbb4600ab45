#include "model/meshes/solid_surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace handway::gui {
namespace {

bool is_oriented_and_closed(const geometric::TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> passed;  // by edge: times up less times down
  const auto pass = [&](std::uint32_t from, std::uint32_t to) {
    const auto [low, high] = std::minmax(from, to);
    passed[(std::uint64_t{low} << 32U) | high] += from < to ? 1 : -1;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    pass(a, b);
    pass(b, c);
    pass(c, a);
  }
  return std::ranges::all_of(passed, [](const auto& edge) { return edge.second == 0; });
}

}  // namespace

geometric::TriangleMesh welded_to_draw(const geometric::TriangleMesh& mesh) {
  constexpr double kGrid = 1e-7;  // m
  geometric::TriangleMesh whole = geometric::welded(mesh, kGrid);
  std::erase_if(whole.triangles, [](const std::array<std::uint32_t, 3>& corners) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
  });
  return whole;
}

bool is_solid(const geometric::TriangleMesh& mesh) {
  if (mesh.empty() || !is_oriented_and_closed(mesh)) {
    return false;
  }
  const std::vector<std::uint32_t> piece_of = geometric::piece_numbers(mesh);
  std::map<std::uint32_t, double> volumes;  // six times, m³
  for (const auto& [a, b, c] : mesh.triangles) {
    volumes[piece_of[a]] += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  }
  return std::ranges::all_of(volumes, [](const auto& piece) { return piece.second > 0.0; });
}

}  // namespace handway::gui
