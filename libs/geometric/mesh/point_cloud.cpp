#include "handway/geometric/mesh/point_cloud.h"

#include "mesh/vertex_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::geometric {
namespace {

constexpr std::size_t kMostTriangles = 4'000'000;

using Cell = std::array<std::int64_t, 3>;

/// A cell as one number; its neighbours along an axis differ by step_along() of this axis.
using CellKey = std::uint64_t;

constexpr unsigned kBitsOfAxis = 21;
constexpr std::int64_t kMiddle = std::int64_t{1} << (kBitsOfAxis - 1);

CellKey key_of(const Cell& cell) {
  CellKey key = 0;
  for (const std::int64_t place : cell) {
    key = key << kBitsOfAxis | static_cast<CellKey>(place + kMiddle);
  }
  return key;
}

Cell cell_of(CellKey key) {
  constexpr CellKey kMask = (CellKey{1} << kBitsOfAxis) - 1;
  Cell cell{};
  for (std::size_t axis = 3; axis-- > 0; key >>= kBitsOfAxis) {
    cell[axis] = static_cast<std::int64_t>(key & kMask) - kMiddle;
  }
  return cell;
}

CellKey step_along(std::size_t axis) { return CellKey{1} << ((2 - axis) * kBitsOfAxis); }

/// A set of cells, in order once all have been added.
class CellSet {
 public:
  void add(const Cell& cell) {
    const CellKey key = key_of(cell);
    if (keys_.empty() || keys_.back() != key) {
      keys_.push_back(key);
    }
    if (keys_.size() >= next_sort_) {
      sort();
    }
  }
  void sort() {
    std::ranges::sort(keys_);
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    next_sort_ = std::max(kFewestToSort, 2 * keys_.size());
  }

  [[nodiscard]] const std::vector<CellKey>& keys() const { return keys_; }
  [[nodiscard]] bool contains(CellKey key) const { return std::ranges::binary_search(keys_, key); }

 private:
  static constexpr std::size_t kFewestToSort = 4'000'000;

  std::vector<CellKey> keys_;
  std::size_t next_sort_ = kFewestToSort;
};

std::int64_t place_of(double coordinate, double size) {
  return static_cast<std::int64_t>(std::floor(coordinate / size));
}

/// Adds the cells that a ball touches.
class BallCells {
 public:
  BallCells(const CloudCells& cells, CellSet& set) : cells_(cells), set_(set) {}

  void add(const Eigen::Vector3d& centre) {
    Cell first{};
    Cell last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = centre[static_cast<Eigen::Index>(axis)];
      first[axis] = place_of(place - cells_.radius, cells_.size);
      last[axis] = place_of(place + cells_.radius, cells_.size);
    }
    Cell cell{};
    for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0]) {
      for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1]) {
        for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2]) {
          if (touches(centre, cell)) {
            set_.add(cell);
          }
        }
      }
    }
  }

 private:
  [[nodiscard]] bool touches(const Eigen::Vector3d& centre, const Cell& cell) const {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = centre[static_cast<Eigen::Index>(axis)];
      const double lower = cells_.size * static_cast<double>(cell[axis]);
      const double outside = std::max({lower - place, place - lower - cells_.size, 0.0});
      squared += outside * outside;
    }
    return squared <= cells_.radius * cells_.radius + 1e-15;
  }

  const CloudCells& cells_;
  CellSet& set_;
};

/// The sides of cells without a neighbour, each of two triangles.
class CellSurface {
 public:
  CellSurface(const CellSet& cells, double size) : cells_(cells), size_(size) {}

  // @returns false if there are too many.
  [[nodiscard]] bool build() {
    for (const CellKey key : cells_.keys()) {
      const Cell cell = cell_of(key);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!cells_.contains(key - step_along(axis))) {
          add_side(cell, axis, false);
        }
        if (!cells_.contains(key + step_along(axis))) {
          add_side(cell, axis, true);
        }
      }
      if (triangles_.size() > kMostTriangles) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] TriangleMesh mesh() && {
    return {std::move(places_.vertices()), std::move(triangles_)};
  }

 private:
  void add_side(const Cell& cell, std::size_t axis, bool upper) {
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Cell corner = cell;
      corner[axis] += upper ? 1 : 0;
      corner[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
      corner[(axis + 2) % 3] += i >= 2 ? 1 : 0;
      corners[i] = places_.number_of(size_ * Eigen::Vector3d(static_cast<double>(corner[0]),
                                                             static_cast<double>(corner[1]),
                                                             static_cast<double>(corner[2])));
    }
    if (!upper) {
      std::swap(corners[1], corners[3]);
    }
    triangles_.push_back({corners[0], corners[1], corners[2]});
    triangles_.push_back({corners[0], corners[2], corners[3]});
  }

  const CellSet& cells_;
  double size_;
  VertexTable places_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::optional<TriangleMesh> cells_around(const PointCloud& cloud, const CloudCells& cells) {
  CellSet set;
  BallCells balls(cells, set);
  for (const Eigen::Vector3f& point : cloud.points) {
    balls.add(point.cast<double>());
  }
  set.sort();
  CellSurface surface(set, cells.size);
  return surface.build() ? std::optional(std::move(surface).mesh()) : std::nullopt;
}

}  // namespace handway::geometric
