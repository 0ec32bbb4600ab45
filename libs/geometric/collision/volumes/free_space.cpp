#include "collision/volumes/free_space.h"

#include "collision/volumes/box_tree.h"
#include "collision/volumes/solid.h"

#include <algorithm>
#include <map>
#include <utility>

namespace handway::geometric {
namespace {

constexpr int kSteps = 32;              // of a grid along each axis, besides lines at flat faces
constexpr std::size_t kGridFaces = 12;  // so many flat faces across an axis have lines of their own
constexpr double kBeside = 1e-5;        // m: so far on either side
constexpr double kBeyond = 1.0;         // m: so far around the piece the grid reaches
constexpr double kGridHair = 2e-6;      // m: free cells are at least so far from the surface
constexpr std::size_t kParts = 24;      // the largest, whose sides are found

// The coordinates of the largest faces across an axis.
std::vector<double> flat_faces(const TriangleMesh& piece, Eigen::Index axis) {
  std::map<double, double> areas;
  for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) {
    const auto [a, b, c] = corners(piece, t);
    const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
    if (high - low < kGridHair) {
      areas[a[axis]] += (b - a).cross(c - a).norm();
    }
  }
  std::vector<std::pair<double, double>> largest;
  largest.reserve(areas.size());
  for (const auto& [place, area] : areas) {
    largest.emplace_back(-area, place);
  }
  std::ranges::sort(largest);
  largest.resize(std::min(largest.size(), kGridFaces));
  std::vector<double> faces;
  std::ranges::transform(largest, std::back_inserter(faces), &std::pair<double, double>::second);
  return faces;
}

}  // namespace

FreeSpace::FreeSpace(const TriangleMesh& piece) : around_(bounding_box(piece)) {
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lay_lines(piece, axis);
    count_[axis] = static_cast<int>(lines_[axis].size()) - 1;
    cells *= lines_[axis].size() - 1;
  }
  part_.assign(cells, kFree);
  for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) {
    block_cells(corners(piece, t));
  }
  find_parts(piece);
}

void FreeSpace::lay_lines(const TriangleMesh& piece, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  std::vector<double>& lines = lines_[axis];
  for (const double face : flat_faces(piece, i)) {
    lines.insert(lines.end(), {face - kBeside, face + kBeside});
  }
  lines.insert(lines.end(), {around_.lower[i] - kBeyond, around_.upper[i] + kBeyond});
  for (int k = 0; k <= kSteps; ++k) {
    lines.push_back(around_.lower[i] + k * around_.size()[i] / kSteps);
  }
  std::ranges::sort(lines);
  const auto is_same = [](double low, double high) { return high - low < 0.5 * kBeside; };
  lines.erase(std::unique(lines.begin(), lines.end(), is_same), lines.end());
}

void FreeSpace::block_cells(const std::array<Eigen::Vector3d, 3>& triangle) {
  const Eigen::Vector3d lower = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
  const Eigen::Vector3d upper = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
  Block cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const std::vector<double>& lines = lines_[axis];
    const auto below = std::ranges::lower_bound(lines, lower[i] - kGridHair) - lines.begin();
    const auto above = std::ranges::upper_bound(lines, upper[i] + kGridHair) - lines.begin();
    cells.first[axis] = std::max(0, static_cast<int>(below) - 1);
    cells.end[axis] = std::min(count_[axis], static_cast<int>(above));
  }
  for (int z = cells.first[2]; z < cells.end[2]; ++z) {
    for (int y = cells.first[1]; y < cells.end[1]; ++y) {
      for (int x = cells.first[0]; x < cells.end[0]; ++x) {
        part_[cell_at({x, y, z})] = kBlocked;
      }
    }
  }
}

void FreeSpace::find_parts(const TriangleMesh& piece) {
  struct Part {
    double volume;
    int number;
    std::size_t cell;
  };
  std::vector<Part> parts;
  for (std::size_t cell = 0; cell < part_.size(); ++cell) {
    if (part_[cell] == kFree) {
      const int number = static_cast<int>(parts.size());
      parts.push_back({flood(cell, number), number, cell});
    }
  }
  is_inside_.assign(parts.size(), std::nullopt);
  std::ranges::stable_sort(parts, std::ranges::greater(), &Part::volume);
  parts.resize(std::min(parts.size(), kParts));
  const Solid solid(piece);
  for (const Part& part : parts) {
    const Aabb cell = box(block_of(part.cell));
    is_inside_[static_cast<std::size_t>(part.number)] = solid.contains(cell.centre());
  }
}

double FreeSpace::flood(std::size_t from, int number) {
  double flooded = 0.0;
  std::vector<std::size_t> waiting{from};
  part_[from] = number;
  while (!waiting.empty()) {
    const Block cell = block_of(waiting.back());
    waiting.pop_back();
    flooded += volume(cell);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Index next = cell.first;
        next[axis] += step;
        if (next[axis] >= 0 && next[axis] < count_[axis] && part_[cell_at(next)] == kFree) {
          part_[cell_at(next)] = number;
          waiting.push_back(cell_at(next));
        }
      }
    }
  }
  return flooded;
}

FreeSpace::Block FreeSpace::block_of(std::size_t cell) const {
  const int n = static_cast<int>(cell);
  const Index i{n % count_[0], n / count_[0] % count_[1], n / count_[0] / count_[1]};
  return {i, {i[0] + 1, i[1] + 1, i[2] + 1}};
}

Eigen::Vector3d FreeSpace::corner(const Index& i) const {
  return {lines_[0][static_cast<std::size_t>(i[0])], lines_[1][static_cast<std::size_t>(i[1])],
          lines_[2][static_cast<std::size_t>(i[2])]};
}

Aabb FreeSpace::box(const Block& block) const { return {corner(block.first), corner(block.end)}; }

double FreeSpace::volume(const Block& block) const {
  return (corner(block.end).cwiseMin(around_.upper) - corner(block.first).cwiseMax(around_.lower))
      .cwiseMax(0.0)
      .prod();
}

}  // namespace handway::geometric
