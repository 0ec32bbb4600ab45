#include "handway/geometric/setup/object_proposal.h"

#include "setup/point_tree.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

namespace handway::geometric {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kThinning = 0.006;        // m: of points in one such cell one is looked at
constexpr std::size_t kNeighbours = 12;    // of a normal
constexpr double kLevel = 0.9;             // cosine of the angle of a level surface's normal
constexpr double kMostlyLevel = 0.6;       // share of points
constexpr double kUpright = 0.5;           // the same of a side, at most
constexpr double kLayer = 0.005;           // m: heights in one layer
constexpr double kSurfaceDepth = 0.012;    // m: points of a surface are that near to its height
constexpr double kSurfaceGap = 0.03;       // m: parts of one surface are nearer to each other
constexpr double kAreaCell = 0.02;         // m
constexpr double kLeastArea = 0.05;        // m²
constexpr double kThickness = 0.02;        // m, of a surface
constexpr double kAbove = 0.008;           // m: what is lower belongs to the surface
constexpr double kHighest = 0.8;           // m: what is higher above a surface does not stand on it
constexpr double kObjectGap = 0.02;        // m
constexpr std::size_t kFewestPoints = 40;  // of an object
constexpr double kLargestRadius = 0.3;     // m
constexpr std::size_t kMostSupports = 20;

// Colours for points that have none.
constexpr Color kSurfaceColor{0.72F, 0.62F, 0.48F, 1.0F};
constexpr Color kObjectColor{0.28F, 0.50F, 0.72F, 1.0F};

using Indices = std::vector<std::uint32_t>;

/// Points in the world, thinned out evenly.
struct Samples {
  std::vector<Vector3d> points;
  std::vector<Vector3d> colors;  ///< 0 to 1; or empty.
  std::vector<double> levels;    ///< |z| of each normal.
};

Samples thinned(const PointCloud& cloud, const Pose& X_WC) {
  std::set<std::array<int, 3>> taken;
  Samples samples;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3d p = X_WC * cloud.points[i].cast<double>();
    const Eigen::Array3i cell = (p.array() / kThinning).floor().cast<int>();
    if (taken.insert({cell.x(), cell.y(), cell.z()}).second) {
      samples.points.push_back(p);
      if (!cloud.colors.empty()) {
        const auto& [red, green, blue] = cloud.colors[i];
        samples.colors.emplace_back(Vector3d(red, green, blue) / 255.0);
      }
    }
  }
  return samples;
}

// The direction in which the points around one vary least.
double level_of(const std::vector<Vector3d>& points, std::span<const std::uint32_t> around) {
  Vector3d mean = Vector3d::Zero();
  for (const std::uint32_t i : around) {
    mean += points[i] / static_cast<double>(around.size());
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : around) {
    spread += (points[i] - mean) * (points[i] - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  return std::abs(axes.eigenvectors()(2, 0));
}

void find_levels(Samples& samples, const PointTree& tree) {
  samples.levels.resize(samples.points.size());
  tbb::parallel_for(std::size_t{0}, samples.points.size(), [&](std::size_t i) {
    samples.levels[i] = level_of(samples.points, tree.nearest(samples.points[i], kNeighbours));
  });
}

/// Groups of points of which each is nearer than `gap` to another one of its group, the largest
/// first.
std::vector<Indices> clusters_of(const std::vector<Vector3d>& points, const Indices& members,
                                 double gap) {
  std::vector<Vector3d> own;
  for (const std::uint32_t member : members) {
    own.push_back(points[member]);
  }
  const PointTree tree(own);
  std::vector<char> is_taken(own.size());
  std::vector<Indices> clusters;
  for (std::uint32_t seed = 0; seed < own.size(); ++seed) {
    if (is_taken[seed] != 0) {
      continue;
    }
    is_taken[seed] = 1;
    Indices cluster = {seed};
    for (std::size_t next = 0; next < cluster.size(); ++next) {
      for (const std::uint32_t near : tree.within(own[cluster[next]], gap)) {
        if (is_taken[near] == 0) {
          is_taken[near] = 1;
          cluster.push_back(near);
        }
      }
    }
    std::ranges::sort(cluster);
    std::ranges::transform(cluster, cluster.begin(), [&](std::uint32_t i) { return members[i]; });
    clusters.push_back(std::move(cluster));
  }
  std::ranges::stable_sort(clusters, std::ranges::greater{}, &Indices::size);
  return clusters;
}

/// A rectangle in the plane, its length along its x axis.
struct Rectangle {
  Vector2d centre = Vector2d::Zero();
  Vector2d size = Vector2d::Zero();
  double angle = 0.0;

  [[nodiscard]] Vector2d local(const Vector2d& p) const {
    return Eigen::Rotation2Dd(-angle) * (p - centre);
  }
  [[nodiscard]] bool contains(const Vector2d& p, double margin) const {
    return (local(p).array().abs() <= 0.5 * size.array() + margin).all();
  }
};

// The corners of the convex hull, counterclockwise (Andrew, 1979).
std::vector<Vector2d> hull_of(std::vector<Vector2d> points) {
  std::ranges::sort(points, [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2d> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= first + 2) {
        const Vector2d edge = hull.back() - hull[hull.size() - 2];
        const Vector2d next = *p - hull.back();
        if (edge.x() * next.y() - edge.y() * next.x() > 0.0) {
          break;
        }
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

// The smallest rectangle has a side along an edge of the hull (Freeman and Shapira, 1975).
Rectangle rectangle_around(const std::vector<Vector2d>& points) {
  const std::vector<Vector2d> hull = hull_of(points);
  Rectangle smallest;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    const double angle = std::atan2(edge.y(), edge.x());
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : hull) {
      box.extend(Eigen::Rotation2Dd(-angle) * corner);
    }
    if (box.volume() < least) {
      least = box.volume();
      smallest = {Eigen::Rotation2Dd(angle) * box.center(), box.sizes(), angle};
    }
  }
  return smallest;
}

/// A level surface that something may stand on.
struct Support {
  Rectangle outline;
  double height = 0.0;
  Indices points;
};

/// The points of a cluster, for fits.
struct Cluster {
  std::vector<Vector3d> points;
  std::vector<Vector2d> flat;   ///< Seen from above.
  std::vector<Vector2d> sides;  ///< Points with level normals, seen from above.
  double lowest = 0.0;
  double highest = 0.0;
  double level_share = 0.0;  ///< Share of the points with upright normals.

  Cluster(const Samples& samples, const Indices& members) {
    std::vector<double> heights;
    for (const std::uint32_t i : members) {
      points.push_back(samples.points[i]);
      flat.emplace_back(samples.points[i].head<2>());
      heights.push_back(samples.points[i].z());
      level_share += samples.levels[i] > kLevel ? 1.0 / static_cast<double>(members.size()) : 0.0;
      if (samples.levels[i] < kUpright) {
        sides.push_back(flat.back());
      }
    }
    std::ranges::sort(heights);
    lowest = heights.front();
    highest = heights[heights.size() * 98 / 100];
  }
};

/// A primitive and how well it fits.
struct Fit {
  Shape shape;
  Pose X_WO = Pose::Identity();
  double error = 0.0;  ///< Mean distance of the points from its surface, m.
};

template <typename Distance>
double mean_distance(const std::vector<Vector3d>& points, const Pose& X_WO,
                     const Distance& distance) {
  const Pose X_OW = X_WO.inverse();
  double sum = 0.0;
  for (const Vector3d& p : points) {
    sum += std::abs(distance(Vector3d(X_OW * p)));
  }
  return sum / static_cast<double>(points.size());
}

// Signed distance from a box whose half edges are given, in any dimension.
template <typename Vector>
double box_distance(const Vector& p, const Vector& half) {
  const Vector outside = p.cwiseAbs() - half;
  return outside.cwiseMax(0.0).norm() + std::min(outside.maxCoeff(), 0.0);
}

Fit box_over(const Rectangle& outline, double foot, double top) {
  Box box{Vector3d(outline.size.x(), outline.size.y(), top - foot)};
  box.size = box.size.cwiseMax(1e-3);
  return {box, pose_from_rpy({outline.centre.x(), outline.centre.y(), 0.5 * (foot + top)}, 0.0, 0.0,
                             outline.angle)};
}

Fit box_fit(const Cluster& cluster, double foot) {
  Fit fit = box_over(rectangle_around(cluster.flat), foot, cluster.highest);
  const Vector3d half = 0.5 * std::get<Box>(fit.shape).size;
  fit.error = mean_distance(cluster.points, fit.X_WO,
                            [&](const Vector3d& p) { return box_distance<Vector3d>(p, half); });
  return fit;
}

/// Returns the centre and the radius of the circle or sphere through points, by least squares on
/// their squared equations (Kåsa, 1976), in the units of the points.
template <int kSize>
std::optional<std::pair<Eigen::Matrix<double, kSize, 1>, double>> round_fit(
    const std::vector<Eigen::Matrix<double, kSize, 1>>& points) {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Unknowns = Eigen::Matrix<double, kSize + 1, 1>;
  if (points.size() < kFewestPoints / 2) {
    return std::nullopt;
  }
  Vector mean = Vector::Zero();
  for (const Vector& p : points) {
    mean += p / static_cast<double>(points.size());
  }
  Eigen::Matrix<double, kSize + 1, kSize + 1> normal;
  normal.setZero();
  Unknowns right = Unknowns::Zero();
  for (const Vector& p : points) {
    Unknowns row;
    row << 2.0 * (p - mean), 1.0;
    normal += row * row.transpose();
    right += row * (p - mean).squaredNorm();
  }
  const Unknowns solved = normal.ldlt().solve(right);
  const Vector centre = solved.template head<kSize>();
  const double squared = solved[kSize] + centre.squaredNorm();
  if (!solved.allFinite() || squared <= 0.0 || std::sqrt(squared) > kLargestRadius) {
    return std::nullopt;
  }
  return std::pair<Vector, double>(mean + centre, std::sqrt(squared));
}

std::optional<Fit> cylinder_fit(const Cluster& cluster, double foot) {
  const auto circle = round_fit<2>(cluster.sides);
  const double length = cluster.highest - foot;
  if (!circle || length <= 0.0) {
    return std::nullopt;
  }
  const Vector2d centre = circle->first;
  const double radius = circle->second;
  Fit fit{Cylinder{radius, length}};
  fit.X_WO.translation() = Vector3d(centre.x(), centre.y(), foot + 0.5 * length);
  fit.error = mean_distance(cluster.points, fit.X_WO, [&](const Vector3d& p) {
    return box_distance<Vector2d>({p.head<2>().norm(), p.z()}, {radius, 0.5 * length});
  });
  return fit;
}

std::optional<Fit> sphere_fit(const Cluster& cluster) {
  const auto ball = round_fit<3>(cluster.points);
  if (!ball) {
    return std::nullopt;
  }
  Fit fit{Sphere{ball->second}};
  fit.X_WO.translation() = ball->first;
  fit.error = mean_distance(cluster.points, fit.X_WO,
                            [&](const Vector3d& p) { return p.norm() - ball->second; });
  return fit;
}

Fit best_fit(const Cluster& cluster, double foot) {
  // A round fit has to be clearly better: a few sides of a box lie on some circle too.
  constexpr double kClearly = 0.8;
  Fit best = box_fit(cluster, foot);
  for (const std::optional<Fit>& round : {cylinder_fit(cluster, foot), sphere_fit(cluster)}) {
    const bool is_box = std::holds_alternative<Box>(best.shape);
    if (round && round->error < (is_box ? kClearly : 1.0) * best.error) {
      best = *round;
    }
  }
  return best;
}

/// Finds supports, then what stands on them.
class ObjectSearch {
 public:
  explicit ObjectSearch(Samples samples) : samples_(std::move(samples)) {}

  [[nodiscard]] std::vector<SceneObject> run() {
    find_supports();
    std::vector<SceneObject> objects;
    for (const Support& support : supports_) {
      objects.push_back(
          object_of("surface", support.points,
                    box_over(support.outline, support.height - kThickness, support.height)));
    }
    for (const Support& support : supports_) {
      add_objects_on(support, objects);
    }
    return objects;
  }

 private:
  // Level points by the number of their layer.
  [[nodiscard]] std::map<int, Indices> layers() const {
    std::map<int, Indices> layers;
    for (std::uint32_t i = 0; i < samples_.points.size(); ++i) {
      if (samples_.levels[i] > kLevel) {
        layers[static_cast<int>(std::floor(samples_.points[i].z() / kLayer))].push_back(i);
      }
    }
    return layers;
  }

  void find_supports() {
    std::map<int, Indices> rest = layers();
    while (!rest.empty() && supports_.size() < kMostSupports) {
      const auto fullest =
          std::ranges::max_element(rest, {}, [](const auto& layer) { return layer.second.size(); });
      if (area_of(fullest->second) < 0.5 * kLeastArea) {
        return;
      }
      const int middle = fullest->first;
      const double height = mean_height(fullest->second);
      const int reach = static_cast<int>(std::ceil(kSurfaceDepth / kLayer));
      Indices near;
      for (int layer = middle - reach; layer <= middle + reach; ++layer) {
        if (const auto found = rest.find(layer); found != rest.end()) {
          std::ranges::copy_if(found->second, std::back_inserter(near), [&](std::uint32_t i) {
            return std::abs(samples_.points[i].z() - height) <= kSurfaceDepth;
          });
          rest.erase(found);
        }
      }
      add_supports(near);
    }
  }

  void add_supports(const Indices& near) {
    for (Indices& cluster : clusters_of(samples_.points, near, kSurfaceGap)) {
      if (area_of(cluster) < kLeastArea) {
        continue;
      }
      std::vector<Vector2d> flat;
      for (const std::uint32_t i : cluster) {
        flat.emplace_back(samples_.points[i].head<2>());
      }
      supports_.push_back({rectangle_around(flat), mean_height(cluster), std::move(cluster)});
    }
  }

  [[nodiscard]] double mean_height(const Indices& members) const {
    double sum = 0.0;
    for (const std::uint32_t i : members) {
      sum += samples_.points[i].z();
    }
    return sum / static_cast<double>(members.size());
  }

  [[nodiscard]] double area_of(const Indices& members) const {
    std::set<std::pair<int, int>> cells;
    for (const std::uint32_t i : members) {
      const Eigen::Array2i cell =
          (samples_.points[i].head<2>().array() / kAreaCell).floor().cast<int>();
      cells.emplace(cell.x(), cell.y());
    }
    return kAreaCell * kAreaCell * static_cast<double>(cells.size());
  }

  void add_objects_on(const Support& support, std::vector<SceneObject>& objects) {
    Indices above;
    for (std::uint32_t i = 0; i < samples_.points.size(); ++i) {
      const Vector3d& p = samples_.points[i];
      const double height = p.z() - support.height;
      if (height > kAbove && height < kHighest && support.outline.contains(p.head<2>(), 0.0) &&
          !is_of_support(i)) {
        above.push_back(i);
      }
    }
    for (const Indices& members : clusters_of(samples_.points, above, kObjectGap)) {
      const Cluster cluster(samples_, members);
      // A box that is seen from above has a top alone; all else begins at the surface.
      const bool stands =
          cluster.lowest - support.height < 2.0 * kObjectGap || cluster.level_share > kMostlyLevel;
      if (members.size() >= kFewestPoints && stands) {
        objects.push_back(object_of("object", members, best_fit(cluster, support.height)));
      }
    }
  }

  [[nodiscard]] bool is_of_support(std::uint32_t point) const {
    return std::ranges::any_of(supports_, [&](const Support& support) {
      return std::ranges::binary_search(support.points, point);
    });
  }

  [[nodiscard]] SceneObject object_of(const char* name, const Indices& members,
                                      const Fit& fit) const {
    SceneObject object;
    object.name = name;
    object.shape = fit.shape;
    object.X_PO = fit.X_WO;
    object.color = std::string_view(name) == "surface" ? kSurfaceColor : kObjectColor;
    if (!samples_.colors.empty()) {
      Vector3d color = Vector3d::Zero();
      for (const std::uint32_t i : members) {
        color += samples_.colors[i] / static_cast<double>(members.size());
      }
      const Eigen::Vector3f parts = color.cast<float>();
      object.color = {parts.x(), parts.y(), parts.z(), 1.0F};
    }
    return object;
  }

  Samples samples_;
  std::vector<Support> supports_;
};

}  // namespace

std::vector<SceneObject> propose_objects(const PointCloud& cloud, const Pose& X_WC) {
  Samples samples = thinned(cloud, X_WC);
  if (samples.points.size() < kNeighbours) {
    return {};
  }
  find_levels(samples, PointTree(samples.points));
  return ObjectSearch(std::move(samples)).run();
}

}  // namespace handway::geometric
