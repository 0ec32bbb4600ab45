#include "collision/volumes/solid.h"

#include "collision/volumes/box_tree.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "mesh/vertex_groups.h"

#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>
#include <utility>
#include <variant>

namespace handway::geometric {
namespace {

constexpr double kBoxRounding = 1e-14;        // share of the coordinates
constexpr std::size_t kSoonPrepared = 50000;  // triangles
constexpr int kGridCells = 64;                // along the longest edge of the box
constexpr double kGridHair = 1e-6;            // share of a cell's edge: cells this near are entered

bool is_in(const Aabb& box, const Eigen::Vector3d& p) {
  return (p.array() >= box.lower.array()).all() && (p.array() <= box.upper.array()).all();
}

// Returns whether, seen along z, the edge from a to b crosses the ray from p along x, upwards (1)
// or downwards (-1). Results of two triangles for a common edge differ in the sign at most, so that
// no ray passes between them.
int crossing(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) {
    return 0;
  }
  const bool rises = b.y() > a.y();
  const Eigen::Vector3d& low = rises ? a : b;
  const Eigen::Vector3d& high = rises ? b : a;
  const double left =
      (high.x() - low.x()) * (p.y() - low.y()) - (high.y() - low.y()) * (p.x() - low.x());
  return left > 0.0 ? (rises ? 1 : -1) : 0;
}

// Winding of a triangle above p around p, seen along z from above: -1, 0 or 1.
int winding_above(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c) {
  const int winding = crossing(p, a, b) + crossing(p, b, c) + crossing(p, c, a);
  if (winding == 0 || p.z() >= std::max({a.z(), b.z(), c.z()})) {
    return 0;
  }
  const bool below =
      p.z() < std::min({a.z(), b.z(), c.z()}) || winding * (b - a).cross(c - a).dot(p - a) < 0.0;
  return below ? winding : 0;
}

// Returns for each piece whether its triangles are wound consistently: every edge is used equally
// often in both directions.
std::vector<bool> find_oriented(const TriangleMesh& mesh,
                                const std::vector<std::uint32_t>& piece_of, std::size_t pieces) {
  struct DirectedEdge {  // from its lower vertex
    std::uint32_t high;
    std::uint32_t piece;
    int direction;
  };
  VertexGroups<DirectedEdge> edges(mesh.vertices.size(), [&](const auto& add) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = mesh.triangles[t][k];
        const std::uint32_t to = mesh.triangles[t][(k + 1) % 3];
        add(std::min(from, to), DirectedEdge{std::max(from, to), piece_of[t], from < to ? 1 : -1});
      }
    }
  });
  std::vector<bool> oriented(pieces, true);
  for (std::size_t vertex = 0; vertex < edges.size(); ++vertex) {
    const std::span<DirectedEdge> group = edges[vertex];
    std::ranges::sort(group, {}, &DirectedEdge::high);
    for (auto edge = group.begin(); edge != group.end();) {
      const auto next =
          std::ranges::upper_bound(edge, group.end(), edge->high, {}, &DirectedEdge::high);
      int sum = 0;
      for (auto same = edge; same != next; ++same) {
        sum += same->direction;
      }
      if (sum != 0) {
        oriented[edge->piece] = false;
      }
      edge = next;
    }
  }
  return oriented;
}

// Data of the triangles of one shape that make_body_solids() needs, in its frame.
struct ShapeSolid {
  explicit ShapeSolid(const TriangleMesh& mesh) {
    const TriangleMesh whole = welded(mesh);
    const std::vector<std::uint32_t> numbers = piece_numbers(whole);
    std::vector<bool> seen(whole.vertices.size());
    for (const auto& triangle : whole.triangles) {
      if (const std::uint32_t piece = numbers[triangle[0]]; !seen[piece]) {
        seen[piece] = true;
        points.push_back(whole.vertices[triangle[0]]);
      }
    }
    if (TriangleMesh surface = distinct_triangles(whole); is_closed(surface)) {
      solid = std::make_shared<const Solid>(std::move(surface));
    }
  }

  std::vector<Eigen::Vector3d> points;
  std::shared_ptr<const Solid> solid;
};

// Cache of shapes: the meshes of files are shared by scenes, worlds and robots.
class KnownShapes {
 public:
  std::shared_ptr<const ShapeSolid> get(const std::shared_ptr<const TriangleMesh>& mesh) {
    {
      const std::scoped_lock lock(mutex_);
      if (const auto found = known_.find(mesh); found != known_.end()) {
        return found->second;
      }
    }
    auto made = std::make_shared<const ShapeSolid>(*mesh);
    const std::scoped_lock lock(mutex_);
    std::erase_if(known_, [](const auto& entry) { return entry.first.expired(); });
    return known_.try_emplace(mesh, std::move(made)).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::weak_ptr<const TriangleMesh>, std::shared_ptr<const ShapeSolid>, std::owner_less<>>
      known_;
};

std::shared_ptr<const ShapeSolid> solid_of(const Shape& shape) {
  static KnownShapes known;
  const bool is_shared =
      std::holds_alternative<Mesh>(shape) || std::holds_alternative<Cloud>(shape);
  const std::shared_ptr<const TriangleMesh> surface = tessellate(shape);
  return is_shared ? known.get(surface) : std::make_shared<const ShapeSolid>(*surface);
}

void extend(Aabb& box, const Aabb& part, const Pose& X_BG) {
  const Eigen::Vector3d centre = X_BG * part.centre();
  const Eigen::Vector3d half = X_BG.linear().cwiseAbs() * (0.5 * part.size());
  const Eigen::Vector3d rounding =
      Eigen::Vector3d::Constant(kBoxRounding * (centre.lpNorm<1>() + half.lpNorm<1>()));
  box.lower = box.lower.cwiseMin(centre - half - rounding);
  box.upper = box.upper.cwiseMax(centre + half + rounding);
}

}  // namespace

SideGrid::SideGrid(const TriangleMesh& surface, const Aabb& box)
    : lower_(box.lower),
      edge_(std::max(box.size().maxCoeff() / kGridCells, std::numeric_limits<double>::min())),
      count_((box.size() / edge_).array().ceil().cast<int>().max(1).min(kGridCells)),
      sides_(static_cast<std::size_t>(count_.prod())) {
  const double hair = kGridHair * edge_;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = corners(surface, t);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double reach = 0.5 * edge_ * normal.lpNorm<1>() + hair * normal.norm();
    const Eigen::Vector3d beside = Eigen::Vector3d::Constant(hair);
    const Index first = index_of(a.cwiseMin(b).cwiseMin(c) - beside);
    const Index last = index_of(a.cwiseMax(b).cwiseMax(c) + beside);
    for (int z = first.z(); z <= last.z(); ++z) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int x = first.x(); x <= last.x(); ++x) {
          const Index cell(x, y, z);
          const Eigen::Vector3d centre = lower_ + edge_ * (cell.cast<double>() + 0.5).matrix();
          if (std::abs(normal.dot(centre - a)) <= reach) {
            sides_[number_of(cell)].store(Side::kBoth, std::memory_order_relaxed);
          }
        }
      }
    }
  }
}

SideGrid::Index SideGrid::index_of(const Eigen::Vector3d& p) const {
  return ((p - lower_) / edge_).array().floor().cast<int>().max(0).min(count_ - 1);
}

std::size_t SideGrid::number_of(const Index& cell) const {
  const Eigen::Array<std::size_t, 3, 1> at = cell.cast<std::size_t>();
  const Eigen::Array<std::size_t, 3, 1> count = count_.cast<std::size_t>();
  return at.x() + count.x() * (at.y() + count.y() * at.z());
}

bool SideGrid::is_inside(const Eigen::Vector3d& p,
                         const std::function<bool(const Eigen::Vector3d&)>& find) const {
  std::atomic<Side>& side = sides_[number_of(index_of(p))];
  const Side known = side.load(std::memory_order_relaxed);
  if (known == Side::kInside || known == Side::kOutside) {
    return known == Side::kInside;
  }
  const bool inside = find(p);
  if (known == Side::kUnknown) {
    side.store(inside ? Side::kInside : Side::kOutside, std::memory_order_relaxed);
  }
  return inside;
}

Solid::Pieces::Pieces(const TriangleMesh& surface, const Aabb& box)
    : sides(surface, box), tree(surface) {
  const std::vector<std::uint32_t> numbers = piece_numbers(surface);
  piece_of.reserve(surface.triangles.size());
  std::uint32_t pieces = 0;
  for (const auto& triangle : surface.triangles) {
    piece_of.push_back(numbers[triangle[0]]);
    pieces = std::max(pieces, piece_of.back() + 1);
  }
  is_oriented = find_oriented(surface, piece_of, pieces);
}

Solid::Solid(TriangleMesh surface)
    : surface_(std::make_shared<const TriangleMesh>(std::move(surface))),
      box_(bounding_box(*surface_)),
      primitive_(PrimitiveDistance::of(*surface_)),
      pieces_([mesh = surface_, box = box_] { return Pieces(*mesh, box); }) {}

bool Solid::contains(const Eigen::Vector3d& p) const {
  if (!is_in(box_, p)) {
    return false;
  }
  const std::optional<bool> known = primitive_ ? primitive_->contains(p) : std::nullopt;
  return known ? *known : pieces_->sides.is_inside(p, [this](const Eigen::Vector3d& q) {
    return is_within_windings(q);
  });
}

void Solid::prepare() const {
  if (!primitive_ && surface_->triangles.size() <= kSoonPrepared) {
    pieces_.make();
  }
}

bool Solid::is_within_windings(const Eigen::Vector3d& p) const {
  const auto& [sides, tree, piece_of, is_oriented] = *pieces_;
  struct Passage {
    std::uint32_t piece;
    int winding;
  };
  boost::container::small_vector<Passage, 32> above;
  boost::container::small_vector<std::uint32_t, 64> waiting{0};
  const double rounding = kBoxRounding * (box_.lower.lpNorm<1>() + box_.upper.lpNorm<1>());
  while (!waiting.empty()) {
    const std::uint32_t index = waiting.back();
    waiting.pop_back();
    const BoxTree::Node& node = tree.nodes()[index];
    const Eigen::Vector3d beyond = p - node.centre;
    if (std::abs(beyond.x()) > node.half.x() + rounding ||
        std::abs(beyond.y()) > node.half.y() + rounding || beyond.z() > node.half.z() + rounding) {
      continue;
    }
    if (node.right != 0) {
      waiting.push_back(index + 1);
      waiting.push_back(node.right);
      continue;
    }
    const auto& [a, b, c] = surface_->triangles[node.triangle];
    const auto& vertices = surface_->vertices;
    if (const int winding = winding_above(p, vertices[a], vertices[b], vertices[c]); winding != 0) {
      above.push_back({piece_of[node.triangle], winding});
    }
  }
  std::ranges::sort(above, {}, &Passage::piece);
  for (auto passage = above.begin(); passage != above.end();) {
    const std::uint32_t piece = passage->piece;
    int count = 0;
    int winding = 0;
    for (; passage != above.end() && passage->piece == piece; ++passage) {
      ++count;
      winding += passage->winding;
    }
    if (is_oriented[piece] ? winding != 0 : count % 2 != 0) {
      return true;
    }
  }
  return false;
}

bool BodySolids::contains(const Eigen::Vector3d& p) const {
  return is_in(box, p) && std::ranges::any_of(parts, [&](const Part& part) {
           return part.solid->contains(part.X_GB * p);
         });
}

std::shared_ptr<const BodySolids> make_body_solids(std::span<const LinkGeometry> shapes,
                                                   bool solid) {
  auto solids = std::make_shared<BodySolids>();
  solids->box = {Eigen::Vector3d::Constant(1e300), Eigen::Vector3d::Constant(-1e300)};
  for (const LinkGeometry& geometry : shapes) {
    const std::shared_ptr<const ShapeSolid> shape = solid_of(geometry.shape);
    for (const Eigen::Vector3d& point : shape->points) {
      solids->points.push_back(geometry.X_LG * point);
    }
    if (!shape->solid) {
      continue;
    }
    BodySolids::Part part{geometry.X_LG.inverse(Eigen::Isometry), shape->solid};
    if (!solid) {
      solids->shells.push_back(std::move(part));
    } else {
      solids->parts.push_back(std::move(part));
      extend(solids->box, shape->solid->box(), geometry.X_LG);
    }
  }
  return solids;
}

bool is_inside(const BodySolids& inner, const BodySolids& outer, const Pose& X_OI) {
  return std::ranges::any_of(
      inner.points, [&](const Eigen::Vector3d& point) { return outer.contains(X_OI * point); });
}

bool contain_each_other(const BodySolids& a, const Pose& X_WA, const BodySolids& b,
                        const Pose& X_WB) {
  return (!b.parts.empty() && is_inside(a, b, X_WB.inverse(Eigen::Isometry) * X_WA)) ||
         (!a.parts.empty() && is_inside(b, a, X_WA.inverse(Eigen::Isometry) * X_WB));
}

}  // namespace handway::geometric
