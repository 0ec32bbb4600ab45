#include "setup/point_tree.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <utility>

namespace handway::geometric {

/// Points as nanoflann reads them, and its tree.
struct PointTree::Tree {
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Tree>,
                                                    Tree, 3, std::uint32_t>;

  explicit Tree(const std::vector<Eigen::Vector3d>& from)
      : points(from), index(3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points[point][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }

  const std::vector<Eigen::Vector3d>& points;
  Index index;
};

PointTree::PointTree(const std::vector<Eigen::Vector3d>& points)
    : tree_(points.empty() ? nullptr : std::make_unique<const Tree>(points)) {}

PointTree::~PointTree() = default;

std::vector<std::uint32_t> PointTree::nearest(const Eigen::Vector3d& p, std::size_t count) const {
  std::vector<std::uint32_t> found(count);
  std::vector<double> squared(count);
  found.resize(tree_ ? tree_->index.knnSearch(p.data(), count, found.data(), squared.data()) : 0);
  return found;
}

std::vector<std::uint32_t> PointTree::within(const Eigen::Vector3d& p, double distance) const {
  std::vector<std::uint32_t> found;
  if (tree_) {
    std::vector<std::pair<std::uint32_t, double>> matches;
    nanoflann::SearchParams params;
    params.sorted = false;
    tree_->index.radiusSearch(p.data(), distance * distance, matches, params);
    for (const auto& [index, squared] : matches) {
      found.push_back(index);
    }
    std::ranges::sort(found);
  }
  return found;
}

}  // namespace handway::geometric
