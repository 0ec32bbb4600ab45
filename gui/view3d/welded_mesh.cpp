#include "view3d/welded_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <unordered_map>

namespace handway::gui {
namespace {

using Index = std::uint32_t;
using Place = std::array<std::int64_t, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    std::size_t hash = 0;
    for (const std::int64_t coordinate : place) {
      hash = hash * 1000003U + std::hash<std::int64_t>{}(coordinate);
    }
    return hash;
  }
};

// For every vertex the number of the place where it lies.
std::vector<Index> number_places(const std::vector<Eigen::Vector3d>& vertices) {
  constexpr double kGrid = 1e7;
  std::unordered_map<Place, Index, PlaceHash> numbers;
  std::vector<Index> place_of(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d& v = vertices[i];
    const Place place{std::llround(v.x() * kGrid), std::llround(v.y() * kGrid),
                      std::llround(v.z() * kGrid)};
    place_of[i] = numbers.emplace(place, static_cast<Index>(numbers.size())).first->second;
  }
  return place_of;
}

// Which vertices hang together.
class Pieces {
 public:
  explicit Pieces(std::size_t vertices) : parent_(vertices) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index piece_of(Index vertex) {
    while (parent_[vertex] != vertex) {
      vertex = parent_[vertex] = parent_[parent_[vertex]];
    }
    return vertex;
  }
  void join(Index a, Index b) { parent_[piece_of(a)] = piece_of(b); }

 private:
  std::vector<Index> parent_;
};

bool is_closed(const geometric::TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> passed;  // by edge: times up less times down
  const auto pass = [&](Index from, Index to) {
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

geometric::TriangleMesh welded(const geometric::TriangleMesh& mesh) {
  const std::vector<Index> place_of = number_places(mesh.vertices);
  geometric::TriangleMesh welded;
  for (std::size_t i = 0; i < place_of.size(); ++i) {
    if (place_of[i] == welded.vertices.size()) {
      welded.vertices.push_back(mesh.vertices[i]);
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array corners{place_of[a], place_of[b], place_of[c]};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
      welded.triangles.push_back(corners);
    }
  }
  return welded;
}

bool is_solid(const geometric::TriangleMesh& mesh) {
  if (mesh.empty() || !is_closed(mesh)) {
    return false;
  }
  Pieces pieces(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    pieces.join(a, b);
    pieces.join(b, c);
  }
  std::map<Index, double> volumes;  // six times, m³
  for (const auto& [a, b, c] : mesh.triangles) {
    volumes[pieces.piece_of(a)] += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  }
  return std::ranges::all_of(volumes, [](const auto& piece) { return piece.second > 0.0; });
}

}  // namespace handway::gui
