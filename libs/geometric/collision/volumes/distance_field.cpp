#include "collision/volumes/distance_field.h"

#include "collision/volumes/box_tree.h"
#include "collision/volumes/on_demand.h"
#include "handway/geometric/collision/volumes/preparation.h"

#include <queue>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr int kCoarsest = 12;        // cells along the longest side
constexpr double kMargin = 0.25;     // around the mesh, of its longest side
constexpr double kFine = 1e-4;       // m: no cell is refined for less
constexpr double kShare = 0.1;       // nor for this share of the distance
constexpr double kSlack = 0.005;     // share of a cell: tolerance of the best bound
constexpr double kTinyLength = 0.1;  // share of a cell: smaller boxes are not searched
constexpr double kNear = 0.002;      // m: what is nearer than this is as good as touching
constexpr int kDeepest = 4;          // times that a cell that grows is halved
constexpr int kMostNodes = 400;      // nodes looked at for one cell

struct Cube {
  Eigen::Vector3d centre;
  double half;
};

struct Bound {
  DistanceField::Cell cell;
  double worth;     // of refining it
  double distance;  // of the centre
  std::uint32_t nearest;
};

// Makes cells of a mesh's field.
class CellMaker {
 public:
  CellMaker(const TriangleMesh& mesh, const BoxTree& boxes, const TriangleTree& triangles)
      : mesh_(mesh), boxes_(boxes), triangles_(triangles) {}

  // Cells of the grid are stored in float and slightly apart from these cubes.
  [[nodiscard]] Bound bound_in(Cube cube, std::uint32_t hint) const {
    cube.half += 1e-6 * (cube.half + cube.centre.cwiseAbs().maxCoeff());
    const NearestPoint nearest = nearest_point(mesh_, boxes_, cube.centre, hint);
    const Eigen::Vector3d slope = slope_from(nearest, cube.centre);
    const double along = slope.dot(cube.centre);
    DistanceField::Cell cell;
    cell.front = static_cast<float>(lowest_value(cube, slope, nearest.distance) - along);
    cell.back = -1e3F;
    if (nearest.distance <= std::sqrt(3.0) * cube.half) {
      cell.back = static_cast<float>(lowest_value(cube, -slope, 0.0) + along);
    }
    for (int k = 0; k < 3; ++k) {
      cell.slope[static_cast<std::size_t>(k)] = static_cast<float>(slope[k]);
    }
    return {cell, worth_of_refining(cube, cell, nearest), nearest.distance, nearest.triangle};
  }

  // The triangles that may be nearest to a point of the cube; one more than a block can hold if
  // there are too many. `distance` is that of its centre.
  [[nodiscard]] std::vector<TriangleCorners> nearest_somewhere(const Cube& cube,
                                                               double distance) const {
    const double reach = distance + 2.0 * std::sqrt(3.0) * cube.half * 1.00001 + 1e-6;
    std::vector<TriangleCorners> triangles;
    waiting_.assign(1, {0, 0.0});
    while (!waiting_.empty() && triangles.size() <= TriangleBlock::kWidth) {
      const std::uint32_t index = waiting_.back().node;
      waiting_.pop_back();
      const BoxTree::Node& node = boxes_.nodes()[index];
      if (BoxTree::distance(node, cube.centre) > reach) {
        continue;
      }
      if (node.right != 0) {
        waiting_.push_back({node.right, 0.0});
        waiting_.push_back({index + 1, 0.0});
        continue;
      }
      const TriangleCorners triangle = corners(mesh_, node.triangle);
      if ((nearest_on_triangle(triangle, cube.centre) - cube.centre).norm() <= reach) {
        triangles.push_back(triangle);
      }
    }
    return triangles;
  }

 private:
  struct Waiting {
    std::uint32_t node;
    double value;
  };

  [[nodiscard]] Eigen::Vector3d slope_from(const NearestPoint& nearest,
                                           const Eigen::Vector3d& p) const {
    if (nearest.distance > 1e-9) {
      return (p - nearest.point) / nearest.distance;
    }
    const auto [a, b, c] = corners(mesh_, nearest.triangle);
    return (b - a).cross(c - a).normalized();
  }

  // Returns the largest error of the bound at some points of the cube, weighted more near to the
  // surface.
  [[nodiscard]] double worth_of_refining(const Cube& cube, const DistanceField::Cell& cell,
                                         const NearestPoint& nearest) const {
    constexpr double kOffset = 0.7;  // of half the cube
    const double within = 1.001 * (nearest.distance + std::sqrt(3.0) * kOffset * cube.half);
    double worth = 0.0;
    for (const int k : {0, 3, 5, 6}) {
      const Eigen::Vector3d p =
          cube.centre + kOffset * cube.half *
                            Eigen::Vector3d((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, (k >> 2) - 0.5) *
                            2.0;
      const double distance = triangles_.distance(p.cast<float>(), static_cast<float>(within));
      const double lost =
          distance - std::max(0.0, static_cast<double>(cell.bound(p.cast<float>())));
      if (lost > std::max(kFine, kShare * distance)) {
        worth = std::max(worth, lost / (kNear + distance));
      }
    }
    return worth;
  }

  // The largest a, up to `value`, so that a + slope · (p - centre) is at most the distance of p
  // from the surface everywhere in the cube.
  [[nodiscard]] double lowest_value(const Cube& cube, const Eigen::Vector3d& slope,
                                    double value) const {
    const double slack = kSlack * cube.half;
    waiting_.assign(1, {0, of_box(cube, slope, boxes_.nodes()[0])});
    double lowest = value;
    int looked_at = 0;
    while (!waiting_.empty()) {
      const Waiting top = waiting_.back();
      waiting_.pop_back();
      if (top.value >= lowest - slack) {
        continue;
      }
      const BoxTree::Node& node = boxes_.nodes()[top.node];
      if (++looked_at > kMostNodes || node.size < kTinyLength * cube.half) {
        lowest = top.value;
      } else if (node.right == 0) {
        lowest = std::min(lowest, of_triangle(cube, slope, node.triangle));
      } else {
        Waiting low{top.node + 1, of_box(cube, slope, boxes_.nodes()[top.node + 1])};
        Waiting high{node.right, of_box(cube, slope, boxes_.nodes()[node.right])};
        if (high.value < low.value) {
          std::swap(low, high);
        }
        waiting_.push_back(high);
        waiting_.push_back(low);
      }
    }
    return lowest - slack;
  }
  static double of_box(const Cube& cube, const Eigen::Vector3d& slope, const BoxTree::Node& box) {
    const Eigen::Vector3d offset = cube.centre - box.centre;
    const Eigen::Vector3d apart =
        (offset.cwiseAbs() - box.half).cwiseMax(0.0).cwiseProduct(offset.cwiseSign());
    const double beyond = slope.dot(offset) - slope.cwiseAbs().dot(box.half);
    return std::max(beyond, of_tangent(cube, slope, apart));
  }

  [[nodiscard]] double of_triangle(const Cube& cube, const Eigen::Vector3d& slope,
                                   std::uint32_t triangle) const {
    const auto points = corners(mesh_, triangle);
    const Eigen::Vector3d apart = cube.centre - nearest_on_triangle(points, cube.centre);
    const double beyond =
        slope.dot(cube.centre) -
        std::max({slope.dot(points[0]), slope.dot(points[1]), slope.dot(points[2])});
    return std::max(beyond, of_tangent(cube, slope, apart));
  }

  // Bound by the tangent, in the cube's centre, of the distance from a convex piece whose nearest
  // point is at `apart` from there.
  static double of_tangent(const Cube& cube, const Eigen::Vector3d& slope,
                           const Eigen::Vector3d& apart) {
    const double distance = apart.norm();
    const Eigen::Vector3d gradient =
        distance > 0.0 ? Eigen::Vector3d(apart / distance) : Eigen::Vector3d::Zero();
    return distance - cube.half * (gradient - slope).lpNorm<1>();
  }

  const TriangleMesh& mesh_;
  const BoxTree& boxes_;
  const TriangleTree& triangles_;
  mutable std::vector<Waiting> waiting_;
};

}  // namespace

class DistanceFieldBuilder {
 public:
  DistanceFieldBuilder(DistanceField& field, const TriangleMesh& mesh, const BoxTree& boxes,
                       const TriangleTree& triangles)
      : field_(field), maker_(mesh, boxes, triangles) {}

  void build(std::size_t budget, const std::stop_token& stop) {
    double side = 1.0 / field_.per_cell_;
    std::uint32_t hint = 0;
    for (int z = 0; z < field_.counts_.z(); ++z) {
      end_if_stopped(stop);
      for (int y = 0; y < field_.counts_.y(); ++y) {
        for (int x = 0; x < field_.counts_.x(); ++x) {
          const Eigen::Vector3d lowest =
              field_.origin_.cast<double>() + side * Eigen::Vector3d(x, y, z);
          hint = add({lowest + Eigen::Vector3d::Constant(0.5 * side), 0.5 * side}, hint);
        }
      }
    }
    while (!open_.empty() && spent() + DistanceField::kChildren <= budget) {
      end_if_stopped(stop);
      const Open worst = open_.top();
      open_.pop();
      improve(worst);
    }
  }

 private:
  struct Open {
    double worth;
    std::uint32_t cell;
    Cube cube;
    double distance;
    std::uint32_t nearest;

    bool operator<(const Open& other) const {
      return worth != other.worth ? worth < other.worth : cell > other.cell;
    }
  };

  std::uint32_t add(const Cube& cube, std::uint32_t hint) {
    const auto index = static_cast<std::uint32_t>(field_.cells_.size());
    const Bound bound = maker_.bound_in(cube, hint);
    field_.cells_.push_back(bound.cell);
    if (bound.worth > 0.0) {
      open_.push({bound.worth, index, cube, bound.distance, bound.nearest});
    }
    return bound.nearest;
  }

  // Counts cells, a block of triangles as the cells of its size.
  [[nodiscard]] std::size_t spent() const {
    constexpr std::size_t kCellsOfBlock = sizeof(TriangleBlock) / sizeof(DistanceField::Cell);
    return field_.cells_.size() + kCellsOfBlock * field_.blocks_.size();
  }

  void improve(const Open& open) {
    std::vector<TriangleCorners> triangles = maker_.nearest_somewhere(open.cube, open.distance);
    if (triangles.size() > TriangleBlock::kWidth) {
      refine(open);
      return;
    }
    field_.cells_[open.cell] =
        DistanceField::Cell::marked(DistanceField::kListed, field_.blocks_.size());
    field_.blocks_.emplace_back(triangles);
  }

  void refine(const Open& open) {
    const auto first = static_cast<std::uint32_t>(field_.cells_.size());
    const double half = open.cube.half / DistanceField::kSplit;
    const Eigen::Vector3d lowest =
        open.cube.centre - Eigen::Vector3d::Constant(open.cube.half - half);
    std::uint32_t hint = open.nearest;
    for (int z = 0; z < DistanceField::kSplit; ++z) {
      for (int y = 0; y < DistanceField::kSplit; ++y) {
        for (int x = 0; x < DistanceField::kSplit; ++x) {
          hint = add({lowest + 2.0 * half * Eigen::Vector3d(x, y, z), half}, hint);
        }
      }
    }
    field_.cells_[open.cell] = DistanceField::Cell::marked(DistanceField::kRefined, first);
  }

  DistanceField& field_;
  CellMaker maker_;
  std::priority_queue<Open> open_;
};

/// A field whose cells are made when a point is first looked up in them, by any thread: each
/// depends on the mesh and its own cube alone, whichever thread makes it.
class DistanceFieldGrowth {
 public:
  DistanceFieldGrowth(std::shared_ptr<const TriangleMesh> mesh, OnDemand<TriangleTree> triangles,
                      std::size_t coarsest)
      : mesh_(std::move(mesh)),
        boxes_([mesh = mesh_] { return BoxTree(*mesh); }),
        triangles_(std::move(triangles)),
        roots_(coarsest) {}

  ~DistanceFieldGrowth() {
    for (const Slot& root : roots_) {
      remove(root);
    }
  }
  DistanceFieldGrowth(const DistanceFieldGrowth&) = delete;
  DistanceFieldGrowth& operator=(const DistanceFieldGrowth&) = delete;

  /// @param cube of the coarsest cell with that number.
  /// @param p in the cube, with its place in it in cells.
  DistanceField::Place find(std::size_t index, const Cube& cube, Eigen::Array3f u) {
    const Grown* cell = get(roots_[index], cube, 0);
    float side = static_cast<float>(2.0 * cube.half);
    for (int depth = 0; cell->may_refine && depth < kDeepest; ++depth) {
      u *= static_cast<float>(DistanceField::kSplit);
      const Eigen::Array3i i = u.cast<int>().min(DistanceField::kSplit - 1);
      u -= i.cast<float>();
      side /= static_cast<float>(DistanceField::kSplit);
      cell = below(*cell, i);
    }
    return {&cell->cell, side * std::min(u.minCoeff(), 1.0F - u.maxCoeff())};
  }

 private:
  struct Grown;
  using Slot = std::atomic<const Grown*>;
  struct Grown {
    Grown(const Bound& bound, const Cube& around)
        : cell(bound.cell), cube(around), nearest(bound.nearest), may_refine(bound.worth > 0.0) {}

    DistanceField::Cell cell;
    Cube cube;
    std::uint32_t nearest;
    bool may_refine;
    mutable std::array<Slot, DistanceField::kChildren> below{};
  };

  const Grown* below(const Grown& cell, const Eigen::Array3i& i) const {
    const double half = cell.cube.half / DistanceField::kSplit;
    const Eigen::Vector3d offset =
        (2.0 * half * (i.cast<double>() - 0.5 * (DistanceField::kSplit - 1))).matrix();
    const int number = i.x() + DistanceField::kSplit * (i.y() + DistanceField::kSplit * i.z());
    return get(cell.below[static_cast<std::size_t>(number)], {cell.cube.centre + offset, half},
               cell.nearest);
  }

  const Grown* get(Slot& slot, const Cube& cube, std::uint32_t hint) const {
    if (const Grown* known = slot.load(std::memory_order_acquire)) {
      return known;
    }
    const Bound bound = CellMaker(*mesh_, *boxes_, *triangles_).bound_in(cube, hint);
    auto made = std::make_unique<const Grown>(bound, cube);
    const Grown* known = nullptr;
    return slot.compare_exchange_strong(known, made.get()) ? made.release() : known;
  }

  static void remove(const Slot& slot) {
    const std::unique_ptr<const Grown> cell(slot.load(std::memory_order_acquire));
    if (cell) {
      for (const Slot& child : cell->below) {
        remove(child);
      }
    }
  }

  std::shared_ptr<const TriangleMesh> mesh_;
  OnDemand<BoxTree> boxes_;
  OnDemand<TriangleTree> triangles_;
  mutable std::vector<Slot> roots_;
};

void DistanceField::lay_out(const Aabb& box) {
  centre_ = box.centre().cast<float>();
  half_ = (0.5 * box.size()).cast<float>();
  const double longest = std::max(box.size().maxCoeff(), 1e-3);
  const double side = (1.0 + 2.0 * kMargin) * longest / kCoarsest;
  const Eigen::Array3d size = box.size().array() + 2.0 * kMargin * longest;
  side_ = static_cast<float>(side);
  per_cell_ = static_cast<float>(1.0 / side);
  counts_ = (size / side).ceil().cast<int>();
  origin_ = (box.centre() - 0.5 * side * counts_.cast<double>().matrix()).cast<float>();
}

DistanceField DistanceField::growing(std::shared_ptr<const TriangleMesh> mesh,
                                     OnDemand<TriangleTree> triangles) {
  DistanceField field;
  field.lay_out(bounding_box(*mesh));
  const auto cells = static_cast<std::size_t>(field.counts_.prod());
  field.growth_ =
      std::make_shared<DistanceFieldGrowth>(std::move(mesh), std::move(triangles), cells);
  return field;
}

DistanceField::Place DistanceField::find_grown(const Eigen::Array3i& i,
                                               const Eigen::Array3f& u) const {
  const double half = 0.5 / static_cast<double>(per_cell_);
  const Eigen::Vector3d centre =
      origin_.cast<double>() + (2.0 * half * (i.cast<double>() + 0.5)).matrix();
  return growth_->find(index_of(i), {centre, half}, u);
}

DistanceField::DistanceField(const TriangleMesh& mesh, const TriangleTree& triangles,
                             std::size_t budget, const std::stop_token& stop) {
  lay_out(bounding_box(mesh));
  DistanceFieldBuilder(*this, mesh, BoxTree(mesh), triangles).build(budget, stop);
}

DistanceField::DistanceField(const PrimitiveDistance& primitive)
    : centre_(primitive.box().centre().cast<float>()),
      half_((0.5 * primitive.box().size()).cast<float>()),
      primitive_(primitive) {}

float DistanceField::bound(const std::array<Eigen::Vector3f, 3>& triangle) const {
  if (primitive_) {
    const Eigen::Vector3f middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0F;
    const auto [distance, slope] = primitive_->tangent(middle);
    return distance <= 0.0F ? kNothing
                            : distance + std::min({slope.dot(triangle[0] - middle),
                                                   slope.dot(triangle[1] - middle),
                                                   slope.dot(triangle[2] - middle)});
  }
  if (growth_) {
    const Eigen::Vector3f middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0F;
    const Place place = find(middle);
    const float reach = std::max({(triangle[0] - middle).norm(), (triangle[1] - middle).norm(),
                                  (triangle[2] - middle).norm()});
    return place.cell != nullptr && reach <= place.room ? place.cell->bound(triangle) : kNothing;
  }
  std::array<Eigen::Array3f, 3> u;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = (triangle[k] - origin_).array() * per_cell_;
  }
  Eigen::Array3i i = u[0].floor().cast<int>();
  const auto apart = [&](const Eigen::Array3f& v) { return (v.floor().cast<int>() != i).any(); };
  if ((i < 0).any() || (i >= counts_).any() || apart(u[1]) || apart(u[2])) {
    return kNothing;
  }
  const Cell* cell = &cells_[index_of(i)];
  while (cell->refined()) {
    for (Eigen::Array3f& v : u) {
      v = (v - i.cast<float>()) * static_cast<float>(kSplit);
    }
    i = u[0].floor().cast<int>();
    if (apart(u[1]) || apart(u[2])) {
      return kNothing;
    }
    cell = &cells_[cell->index() +
                   static_cast<std::uint32_t>(i.x() + kSplit * (i.y() + kSplit * i.z()))];
  }
  return cell->listed() ? kNothing : cell->bound(triangle);
}

}  // namespace handway::geometric
