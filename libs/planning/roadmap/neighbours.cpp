#include "roadmap/neighbours.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace handway::planning {
namespace {

using Offset = Eigen::Index;

constexpr std::size_t kLeaf = 32;  // points: so many are faster looked at than divided

/// Some of the points for nanoflann: data and metric in one.
struct Columns {
  using ElementType = double;
  using DistanceType = double;

  const Eigen::MatrixXd* points;
  Offset first;
  Offset count;
  mutable Offset seen = 0;  ///< Points whose distance was computed.

  [[nodiscard]] std::size_t kdtree_get_point_count() const {
    return static_cast<std::size_t>(count);
  }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t index, std::size_t axis) const {
    return (*points)(static_cast<Offset>(axis), first + index);
  }
  template <typename Box>
  [[nodiscard]] bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
  // NOLINTNEXTLINE(readability-identifier-naming)
  [[nodiscard]] double evalMetric(const double* point, std::uint32_t index,
                                  std::size_t size) const {
    ++seen;
    const Eigen::Map<const Eigen::VectorXd> x(point, static_cast<Offset>(size));
    return (points->col(first + index) - x).squaredNorm();
  }
  [[nodiscard]] static double accum_dist(double a, double b, std::int32_t /*axis*/) {
    return (a - b) * (a - b);
  }
};

/// The nearest points seen so far.
class Nearest {
 public:
  Nearest(std::size_t most, double radius, const std::function<bool(int)>& wanted)
      : most_(most), radius_(radius), wanted_(wanted) {
    set_limit(radius * radius);
  }

  void see(double squared, int number) {
    const Neighbour seen(squared, number);
    const bool full = found_.size() == most_;
    if (std::sqrt(squared) > radius_ || (full && !(seen < found_.front())) ||
        (wanted_ && !wanted_(number))) {
      return;
    }
    if (full) {
      std::ranges::pop_heap(found_);
      found_.pop_back();
    }
    found_.push_back(seen);
    std::ranges::push_heap(found_);
    if (found_.size() == most_) {
      set_limit(found_.front().first);
    }
  }

  /// Squared distance from which points are ignored.
  [[nodiscard]] double limit() const { return limit_; }

  [[nodiscard]] std::vector<Neighbour> sorted() && {
    std::ranges::sort_heap(found_);
    for (Neighbour& neighbour : found_) {
      neighbour.first = std::sqrt(neighbour.first);
    }
    return std::move(found_);
  }

 private:
  // Margin far above the rounding of distances to a tree's cells, and above the one that equally
  // far points need.
  void set_limit(double squared) {
    constexpr double kRounding = 1e-9;
    limit_ = (1.0 + kRounding) * squared + std::numeric_limits<double>::min();
  }

  std::size_t most_;
  double radius_;
  const std::function<bool(int)>& wanted_;
  double limit_ = 0.0;
  std::vector<Neighbour> found_;  ///< A heap, the farthest first; distances squared.
};

/// Collects the points that a tree visits, with nanoflann's interface.
struct Seen {
  Nearest& nearest;
  const int* numbers;

  // NOLINTNEXTLINE(readability-identifier-naming)
  [[nodiscard]] bool addPoint(double squared, std::uint32_t index) const {
    nearest.see(squared, numbers[index]);
    return true;
  }
  // NOLINTNEXTLINE(readability-identifier-naming)
  [[nodiscard]] double worstDist() const { return nearest.limit(); }
  [[nodiscard]] static bool full() { return true; }
};

}  // namespace

/// A kd-tree over points in the order of their addition.
struct Neighbours::Run {
  /// Sorts them, and their numbers, in the order of the tree's leaves, so that they are read
  /// sequentially.
  Run(Eigen::MatrixXd& points, std::vector<int>& numbers, Offset first, Offset count)
      : columns{&points, first, count},
        tree(static_cast<std::int32_t>(points.rows()), columns, {kLeaf}) {
    const Eigen::MatrixXd old_points = points.middleCols(first, count);
    const std::vector<int> old_numbers(numbers.begin() + first, numbers.begin() + first + count);
    for (Offset i = 0; i < count; ++i) {
      std::uint32_t& index = tree.vAcc[static_cast<std::size_t>(i)];
      points.col(first + i) = old_points.col(index);
      numbers[static_cast<std::size_t>(first + i)] = old_numbers[index];
      index = static_cast<std::uint32_t>(i);
    }
  }

  /// Returns whether the next query uses the tree: unless it was useless for the last one. In a
  /// space of many dimensions that is filled evenly, points are too far apart for a tree to leave
  /// any out.
  [[nodiscard]] bool worth_it() const { return useful || queries % kTrial == 0; }

  template <typename Seen>
  void ask(Seen& seen, const Eigen::VectorXd& point) {
    tree.distance.seen = 0;
    tree.findNeighbors(seen, point.data(), {});
    useful = 2 * tree.distance.seen < columns.count;
  }

  [[nodiscard]] Offset end() const { return columns.first + columns.count; }

  static constexpr int kTrial = 32;  // queries after which a tree is tried again

  Columns columns;
  nanoflann::KDTreeSingleIndexAdaptor<Columns, Columns, -1, std::uint32_t> tree;
  int queries = 0;
  bool useful = true;
};

Neighbours::Neighbours(int linear, geometric::Periods periods)
    : linear_(linear), periods_(std::move(periods)) {}
Neighbours::~Neighbours() = default;

void Neighbours::add(int number, const Eigen::VectorXd& point) {
  const auto count = static_cast<Offset>(numbers_.size());
  if (count == points_.cols()) {
    points_.conservativeResize(point.size(), std::max<Offset>(64, 2 * count));
  }
  points_.col(count) = point;
  numbers_.push_back(number);
  Offset first = runs_.empty() ? 0 : runs_.back()->end();
  if (count + 1 - first < linear_ || !periods_.none()) {
    return;
  }
  while (!runs_.empty() && runs_.back()->columns.count == count + 1 - first) {
    first = runs_.back()->columns.first;
    runs_.pop_back();
  }
  runs_.push_back(std::make_unique<Run>(points_, numbers_, first, count + 1 - first));
}

std::vector<Neighbour> Neighbours::nearest(const Eigen::VectorXd& point, int most, double radius,
                                           const std::function<bool(int)>& wanted) const {
  Nearest nearest(static_cast<std::size_t>(most), radius, wanted);
  const auto look_at = [&](Offset first, Offset end) {
    for (Offset i = first; i < end; ++i) {
      const double squared = periods_.none() ? (points_.col(i) - point).squaredNorm()
                                             : periods_.squared_distance(point, points_.col(i));
      if (squared <= nearest.limit()) {
        nearest.see(squared, numbers_[static_cast<std::size_t>(i)]);
      }
    }
  };
  for (const auto& run : runs_) {
    if (run->worth_it()) {
      Seen seen{nearest, numbers_.data() + run->columns.first};
      run->ask(seen, point);
    } else {
      look_at(run->columns.first, run->end());
    }
    ++run->queries;
  }
  look_at(runs_.empty() ? 0 : runs_.back()->end(), static_cast<Offset>(numbers_.size()));
  return std::move(nearest).sorted();
}

}  // namespace handway::planning
