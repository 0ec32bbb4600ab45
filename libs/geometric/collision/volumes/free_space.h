#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace handway::geometric {

/// What a closed surface leaves free of a grid of unequal cells around it. The grid's lines run
/// close to the surface's flat faces, so that thin plates keep cells of their own. Which side of
/// the surface free cells are on is known by parts that hang together.
class FreeSpace {
 public:
  using Index = std::array<int, 3>;
  /// Cells of the grid: the first and past the last along each axis.
  struct Block {
    Index first;
    Index end;
  };

  /// @param piece closed, with a triangle.
  explicit FreeSpace(const TriangleMesh& piece);

  [[nodiscard]] std::size_t cell_count() const { return part_.size(); }
  [[nodiscard]] const Index& counts() const { return count_; }

  /// The side of a cell; nothing if the surface may enter it, or if its part is tiny.
  [[nodiscard]] std::optional<bool> is_inside(std::size_t cell) const {
    return part_[cell] < 0 ? std::nullopt : is_inside_[static_cast<std::size_t>(part_[cell])];
  }

  [[nodiscard]] std::size_t cell_at(const Index& i) const {
    const auto wide = [](int n) { return static_cast<std::size_t>(n); };
    return wide(i[0]) + wide(count_[0]) * (wide(i[1]) + wide(count_[1]) * wide(i[2]));
  }
  [[nodiscard]] Block block_of(std::size_t cell) const;
  [[nodiscard]] Aabb box(const Block& block) const;
  /// Of what is in the box around the surface, m³.
  [[nodiscard]] double volume(const Block& block) const;

 private:
  static constexpr int kFree = -1;
  static constexpr int kBlocked = -2;

  void lay_lines(const TriangleMesh& piece, std::size_t axis);
  void block_cells(const std::array<Eigen::Vector3d, 3>& triangle);
  void find_parts(const TriangleMesh& piece);
  /// Numbers all free cells that can be got to. @returns the part's volume, m³.
  double flood(std::size_t from, int number);
  [[nodiscard]] Eigen::Vector3d corner(const Index& i) const;

  Aabb around_;
  std::array<std::vector<double>, 3> lines_;    ///< m
  Index count_{};                               ///< Of cells.
  std::vector<int> part_;                       ///< Per cell.
  std::vector<std::optional<bool>> is_inside_;  ///< Per part.
};

}  // namespace handway::geometric
