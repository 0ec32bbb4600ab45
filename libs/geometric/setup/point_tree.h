#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace handway::geometric {

/// Finds the neighbours of points, by nanoflann's trees. From any thread.
class PointTree {
 public:
  /// @param points m; they outlive the tree. May be empty.
  explicit PointTree(const std::vector<Eigen::Vector3d>& points);
  ~PointTree();
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// Returns the `count` nearest points, nearest first; fewer if there are fewer.
  [[nodiscard]] std::vector<std::uint32_t> nearest(const Eigen::Vector3d& p,
                                                   std::size_t count) const;
  /// Returns the points nearer than `distance` (m), in order of their indices.
  [[nodiscard]] std::vector<std::uint32_t> within(const Eigen::Vector3d& p, double distance) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace handway::geometric
