#include "handway/geometric/collision/bounded_checker.h"

#include "collision/box_tree.h"
#include "collision/distance_table.h"
#include "collision/fcl_bodies.h"
#include "collision/sphere_tree.h"
#include "collision/surface_distance.h"
#include "handway/geometric/collision/motion_bound.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kSmallestSphere = 0.012;  // m
constexpr double kSpheresAcross = 12.0;    // a body is covered by spheres of this share of its size
constexpr int kGlance = 40;            // steps through the spheres before the triangles are asked
constexpr double kHair = 1e-9;         // m
constexpr double kRemembered = 0.002;  // m: distances in tables are cut off here

}  // namespace

struct BoundedChecker::Volumes {
  explicit Volumes(const CollisionWorld& world) : exact(world) {
    const MotionBound motion(world);
    std::map<const TriangleMesh*, std::shared_ptr<const SphereTree>> built_spheres;
    std::map<const TriangleMesh*, std::shared_ptr<const BoxTree>> built_boxes;
    for (const CollisionBody& body : world.bodies()) {
      auto& tree = built_boxes[body.mesh.get()];
      if (!tree) {
        tree = std::make_shared<BoxTree>(*body.mesh);
      }
      boxes.push_back(tree);
      meshes.push_back(body.mesh);
      auto& cover = built_spheres[body.mesh.get()];
      if (!cover && body.moves()) {
        const double size = bounding_box(*body.mesh).size().norm();
        cover = std::make_shared<SphereTree>(*body.mesh,
                                             std::max(kSmallestSphere, size / kSpheresAcross));
      }
      spheres.push_back(cover);
    }
    for (const BodyPair& pair : world.pairs()) {
      tables.push_back(world.is_self_pair(pair)
                           ? DistanceTable::make(world.model(), world.body(pair.a).link,
                                                 world.body(pair.b).link,
                                                 static_cast<int>(pairs.size()), motion)
                           : nullptr);
      pairs.push_back(smaller_first(pair));
    }
  }

  // Spheres of the smaller body against boxes of the larger.
  [[nodiscard]] BodyPair smaller_first(const BodyPair& pair) const {
    const auto& a = spheres[static_cast<std::size_t>(pair.a)];
    const auto& b = spheres[static_cast<std::size_t>(pair.b)];
    return b && b->root().radius < a->root().radius ? BodyPair{pair.b, pair.a} : pair;
  }

  struct Exact {
    Surface a;
    Surface b;
    Pose X_BA;
  };
  [[nodiscard]] Exact exact_question(int pair, std::span<const Pose> X_WBody) const {
    const auto a = static_cast<std::size_t>(pairs[static_cast<std::size_t>(pair)].a);
    const auto b = static_cast<std::size_t>(pairs[static_cast<std::size_t>(pair)].b);
    return {{*meshes[a], *boxes[a]},
            {*meshes[b], *boxes[b]},
            X_WBody[b].inverse(Eigen::Isometry) * X_WBody[a]};
  }

  FclBodies exact;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
  std::vector<std::shared_ptr<const SphereTree>> spheres;  ///< Null for still bodies.
  std::vector<std::shared_ptr<const BoxTree>> boxes;
  std::vector<std::unique_ptr<DistanceTable>> tables;  ///< Null where a pair has none.
  std::vector<BodyPair> pairs;  ///< In the world's order; a gives the spheres.
};

BoundedChecker::BoundedChecker(std::shared_ptr<const CollisionWorld> world)
    : CollisionChecker(std::move(world)),
      volumes_(std::make_shared<const Volumes>(CollisionChecker::world())),
      witnesses_(volumes_->pairs.size()) {}

BoundedChecker::~BoundedChecker() = default;

BoundedChecker::BoundedChecker(const BoundedChecker& other) = default;

std::unique_ptr<CollisionChecker> BoundedChecker::clone() const {
  return std::unique_ptr<CollisionChecker>(new BoundedChecker(*this));
}

double BoundedChecker::bound(int pair, double enough) const {
  int effort = kGlance;
  const BodyPair& bodies = volumes_->pairs[static_cast<std::size_t>(pair)];
  const Pose X_BA = body_poses()[static_cast<std::size_t>(bodies.b)].inverse(Eigen::Isometry) *
                    body_poses()[static_cast<std::size_t>(bodies.a)];
  const auto& spheres = volumes_->spheres[static_cast<std::size_t>(bodies.a)]->nodes();
  const auto& boxes = volumes_->boxes[static_cast<std::size_t>(bodies.b)]->nodes();

  struct Waiting {
    std::uint32_t sphere;
    std::uint32_t box;
    double clearance;
    Eigen::Vector3d centre;  // of the sphere, in B
  };
  std::array<Waiting, 128> stack;
  std::size_t waiting = 0;
  double least = enough;
  const auto wait_for = [&](std::uint32_t sphere, std::uint32_t box,
                            const Eigen::Vector3d& centre) {
    const double clearance = BoxTree::distance(boxes[box], centre) - spheres[sphere].radius;
    if (clearance < least) {
      stack[waiting++] = {sphere, box, clearance, centre};
    }
  };
  wait_for(0, 0, X_BA * spheres[0].centre);
  while (waiting > 0) {
    const Waiting top = stack[--waiting];
    if (top.clearance >= least) {
      continue;
    }
    const SphereTree::Node& sphere = spheres[top.sphere];
    const BoxTree::Node& box = boxes[top.box];
    const bool at_leaves = sphere.right == 0 && box.right == 0;
    if (at_leaves || --effort < 0 || waiting + 2 > stack.size()) {
      least = top.clearance;
      if (least <= 0.0) {
        return 0.0;
      }
      continue;
    }
    if (sphere.right == 0 || (box.right != 0 && box.size > sphere.radius)) {
      wait_for(top.sphere, top.box + 1, top.centre);
      wait_for(top.sphere, box.right, top.centre);
    } else {
      wait_for(top.sphere + 1, top.box, X_BA * spheres[top.sphere + 1].centre);
      wait_for(sphere.right, top.box, X_BA * spheres[sphere.right].centre);
    }
    if (waiting >= 2 && stack[waiting - 2].clearance < stack[waiting - 1].clearance) {
      std::swap(stack[waiting - 2], stack[waiting - 1]);  // the nearer one first
    }
  }
  return least;
}

double BoundedChecker::remembered(int pair) {
  const DistanceTable* table = volumes_->tables[static_cast<std::size_t>(pair)].get();
  if (!table) {
    return 0.0;
  }
  return table->bound(configuration(), [&](const Configuration& q) {
    std::vector<Pose> X_BL(static_cast<std::size_t>(world().model().link_count()));
    std::vector<Pose> X_WBody(world().bodies().size());
    world().place(q, X_BL, X_WBody);
    return exact_distance(pair, X_WBody, kRemembered);
  });
}

double BoundedChecker::exact_distance(int pair, std::span<const Pose> X_WBody, double enough) {
  count_exact_test();
  const Volumes::Exact question = volumes_->exact_question(pair, X_WBody);
  return surface_distance(question.a, question.b, question.X_BA, enough);
}

Closeness BoundedChecker::exact_closeness(int pair, double tolerance) {
  count_exact_test();
  const Volumes::Exact question = volumes_->exact_question(pair, body_poses());
  return surface_closeness(question.a, question.b, question.X_BA, tolerance,
                           witnesses_[static_cast<std::size_t>(pair)]);
}

bool BoundedChecker::do_pair_collides(int pair) {
  // A hair's width of clearance, so that roundings can't hide a touch.
  if (bound(pair, kHair) > 0.0 || remembered(pair) > kHair ||
      exact_closeness(pair, kHair) == Closeness::kFarther) {
    return false;
  }
  const BodyPair& bodies = volumes_->pairs[static_cast<std::size_t>(pair)];
  return volumes_->exact.collide(bodies.a, body_poses()[static_cast<std::size_t>(bodies.a)],
                                 bodies.b, body_poses()[static_cast<std::size_t>(bodies.b)]);
}

Closeness BoundedChecker::do_pair_closeness(int pair, double tolerance) {
  if (do_pair_bound(pair, tolerance) >= tolerance) {
    return Closeness::kFarther;
  }
  const Closeness closeness = exact_closeness(pair, tolerance);
  return closeness == Closeness::kTouching && !do_pair_collides(pair) ? Closeness::kCloser
                                                                      : closeness;
}

double BoundedChecker::do_pair_bound(int pair, double enough) {
  const double least = bound(pair, enough);
  return least >= enough ? least : std::min(enough, std::max(least, remembered(pair)));
}

double BoundedChecker::do_pair_distance(int pair, double enough) {
  const double least = do_pair_bound(pair, enough);
  return least >= enough ? least : exact_distance(pair, body_poses(), enough);
}

}  // namespace handway::geometric
