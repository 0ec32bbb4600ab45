#include "handway/geometric/collision/bounded_checker.h"

#include "collision/fcl_bodies.h"
#include "collision/sphere_tree.h"
#include "collision/triangle_tree.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace handway::geometric {
namespace {

// Smaller leaves decide more pairs without FCL but take longer to reach.
constexpr double kLeafRadius = 0.004;
constexpr int kFullEffort = 1 << 20;
constexpr int kGlance = 24;  // spheres for a cheap bound

}  // namespace

struct BoundedChecker::Volumes {
  explicit Volumes(const CollisionWorld& world) : exact(world) {
    std::map<const TriangleMesh*, std::shared_ptr<const SphereTree>> built_spheres;
    std::map<const TriangleMesh*, std::shared_ptr<const TriangleTree>> built_triangles;
    for (const CollisionBody& body : world.bodies()) {
      auto& tree = built_triangles[body.mesh.get()];
      if (!tree) {
        tree = std::make_shared<TriangleTree>(*body.mesh);
      }
      triangles.push_back(tree);
      auto& cover = built_spheres[body.mesh.get()];
      if (!cover && body.moves()) {
        const double size = bounding_box(*body.mesh).size().norm();
        cover = std::make_shared<SphereTree>(*body.mesh, std::max(kLeafRadius, size / 100.0));
      }
      spheres.push_back(cover);
    }
    for (const BodyPair& pair : world.pairs()) {
      pairs.push_back(smaller_first(pair));
    }
  }

  // Spheres of the smaller body against triangles of the larger.
  [[nodiscard]] BodyPair smaller_first(const BodyPair& pair) const {
    const auto& a = spheres[static_cast<std::size_t>(pair.a)];
    const auto& b = spheres[static_cast<std::size_t>(pair.b)];
    return b && b->root().radius < a->root().radius ? BodyPair{pair.b, pair.a} : pair;
  }

  FclBodies exact;
  std::vector<std::shared_ptr<const SphereTree>> spheres;  ///< Null for still bodies.
  std::vector<std::shared_ptr<const TriangleTree>> triangles;
  std::vector<BodyPair> pairs;  ///< In the world's order; a gives the spheres.
};

BoundedChecker::BoundedChecker(std::shared_ptr<const CollisionWorld> world)
    : CollisionChecker(std::move(world)),
      volumes_(std::make_shared<const Volumes>(CollisionChecker::world())) {}

BoundedChecker::~BoundedChecker() = default;

BoundedChecker::BoundedChecker(const BoundedChecker& other) = default;

std::unique_ptr<CollisionChecker> BoundedChecker::clone() const {
  return std::unique_ptr<CollisionChecker>(new BoundedChecker(*this));
}

double BoundedChecker::bound(int pair, double enough, int effort) const {
  const BodyPair& bodies = volumes_->pairs[static_cast<std::size_t>(pair)];
  const Pose X_BA = body_poses()[static_cast<std::size_t>(bodies.b)].inverse(Eigen::Isometry) *
                    body_poses()[static_cast<std::size_t>(bodies.a)];
  const auto& nodes = volumes_->spheres[static_cast<std::size_t>(bodies.a)]->nodes();
  const TriangleTree& surface = *volumes_->triangles[static_cast<std::size_t>(bodies.b)];
  const auto clearance = [&](const SphereTree::Node& node, double least) {
    return surface.distance_within(X_BA * node.centre, least + node.radius) - node.radius;
  };

  struct Waiting {
    std::uint32_t node;
    double clearance;
  };
  std::array<Waiting, 64> stack;
  std::size_t waiting = 0;
  double least = enough;
  const double whole = clearance(nodes[0], least);
  if (whole < least) {
    stack[waiting++] = {0, whole};
  }
  while (waiting > 0) {
    const Waiting top = stack[--waiting];
    if (top.clearance >= least) {
      continue;
    }
    const std::uint32_t right = nodes[top.node].right;
    if (right == 0 || --effort < 0) {
      least = top.clearance;
      if (least <= 0.0) {
        return 0.0;
      }
      continue;
    }
    Waiting near{top.node + 1, clearance(nodes[top.node + 1], least)};
    Waiting far{right, clearance(nodes[right], least)};
    if (far.clearance < near.clearance) {
      std::swap(near, far);
    }
    if (far.clearance < least) {
      stack[waiting++] = far;
    }
    if (near.clearance < least) {
      stack[waiting++] = near;
    }
  }
  return least;
}

bool BoundedChecker::do_pair_collides(int pair) {
  // A hair's width of clearance, so that roundings can't hide a touch.
  if (bound(pair, 1e-9, kFullEffort) > 0.0) {
    return false;
  }
  const BodyPair& bodies = volumes_->pairs[static_cast<std::size_t>(pair)];
  count_exact_test();
  return volumes_->exact.collide(bodies.a, body_poses()[static_cast<std::size_t>(bodies.a)],
                                 bodies.b, body_poses()[static_cast<std::size_t>(bodies.b)]);
}

double BoundedChecker::do_pair_bound(int pair, double enough) {
  return bound(pair, enough, kGlance);
}

double BoundedChecker::do_pair_distance(int pair, double enough) {
  const double least = bound(pair, enough, kFullEffort);
  if (least >= enough) {
    return least;
  }
  const BodyPair& bodies = volumes_->pairs[static_cast<std::size_t>(pair)];
  count_exact_test();
  return volumes_->exact.distance(bodies.a, body_poses()[static_cast<std::size_t>(bodies.a)],
                                  bodies.b, body_poses()[static_cast<std::size_t>(bodies.b)],
                                  enough);
}

}  // namespace handway::geometric
