#include "handway/geometric/collision/checkers/exact_collision_checker.h"

#include "collision/broad_phase/broad_phase.h"
#include "collision/broad_phase/oriented_boxes.h"
#include "collision/cache/self_distance_cache.h"
#include "collision/narrow_phase/fcl_bodies.h"
#include "collision/narrow_phase/narrow_phase_query.h"
#include "collision/volumes/hull_gap.h"
#include "collision/volumes/solid.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kRemembered = 0.005;   // m: distances in tables are cut off here
constexpr double kFineEnough = 0.0005;  // m: spheres need not be finer than this
constexpr int kQuickNodes = 16;         // nodes of spheres that a bound is worth …
constexpr int kThorough = 1 << 20;      // … and that one to be remembered is
constexpr float kDeep = 0.6F;           // relative distance below which balls are looked at

}  // namespace

struct ExactCollisionChecker::Volumes {
  Volumes(const CollisionWorld& world, const Preparation& preparation)
      : exact(world), boxes(world) {
    std::vector<std::shared_ptr<const TriangleMesh>> meshes;
    for (const CollisionBody& body : world.bodies()) {
      meshes.push_back(body.mesh);
    }
    surfaces = make_surfaces(meshes, preparation);
    prepare_solids(world);
    for (const BodyPair& pair : world.pairs()) {
      pairs.push_back(spheres_first(pair));
    }
    broad_phase.emplace(world, root_spheres());
    distances.emplace(world, surfaces, preparation.keeps_volumes);
  }

  // Done before the first containment query, which would wait for it.
  static void prepare_solids(const CollisionWorld& world) {
    tbb::parallel_for(std::size_t{0}, world.bodies().size(), [&](std::size_t body) {
      for (const BodySolids::Part& part : world.bodies()[body].solids->parts) {
        part.solid->prepare();
      }
    });
  }

  [[nodiscard]] BodyPair spheres_first(const BodyPair& pair) const {
    const Surface& a = *surfaces[static_cast<std::size_t>(pair.a)];
    const Surface& b = *surfaces[static_cast<std::size_t>(pair.b)];
    return gives_spheres(a, b) ? pair : BodyPair{pair.b, pair.a};
  }

  [[nodiscard]] std::vector<BoundingSphere> root_spheres() const {
    std::vector<BoundingSphere> spheres;
    spheres.reserve(surfaces.size());
    for (const std::shared_ptr<const Surface>& surface : surfaces) {
      spheres.push_back(surface->cover.root());
    }
    return spheres;
  }

  FclBodies exact;
  OrientedBoxes boxes;
  std::optional<BroadPhase> broad_phase;
  std::optional<SelfDistanceCache> distances;
  std::vector<std::shared_ptr<const Surface>> surfaces;  ///< Per body.
  std::vector<BodyPair> pairs;  ///< In the world's order; a gives the spheres.
};

/// A pair that the quick test leaves undecided; deeper pairs are more likely to touch.
struct ExactCollisionChecker::UndecidedPair {
  float relative_distance;
  int pair;
};

struct ExactCollisionChecker::Scratch {
  explicit Scratch(const Volumes& volumes)
      : placement(volumes.broad_phase->placement()), axes(volumes.boxes.last_axes()) {}

  BroadPhase::Placement placement;
  OrientedBoxes::LastAxes axes;
  PairIndices near;
  std::vector<std::uint32_t> triangles;
  std::vector<UndecidedPair> undecided;
};

ExactCollisionChecker::ExactCollisionChecker(std::shared_ptr<const CollisionWorld> world,
                                             const Preparation& preparation)
    : CollisionChecker(std::move(world)),
      volumes_(std::make_shared<const Volumes>(CollisionChecker::world(), preparation)),
      scratch_(std::make_unique<Scratch>(*volumes_)) {}

ExactCollisionChecker::~ExactCollisionChecker() = default;

ExactCollisionChecker::ExactCollisionChecker(const ExactCollisionChecker& other)
    : CollisionChecker(other),
      volumes_(other.volumes_),
      scratch_(std::make_unique<Scratch>(*volumes_)) {}

std::unique_ptr<CollisionChecker> ExactCollisionChecker::clone() const {
  return std::unique_ptr<CollisionChecker>(new ExactCollisionChecker(*this));
}

void ExactCollisionChecker::do_place() {
  volumes_->broad_phase->place(body_poses(), scratch_->placement);
}

void ExactCollisionChecker::do_near_pairs(double distance, PairIndices& pairs) {
  volumes_->broad_phase->find_near(scratch_->placement, distance, pairs);
}

void ExactCollisionChecker::do_closest_first(double distance, PairIndices& pairs) {
  std::vector<std::pair<double, int>> bounds;
  bounds.reserve(pairs.size());
  for (const int pair : pairs) {
    bounds.emplace_back(pair_bound(pair, distance), pair);
  }
  std::ranges::sort(bounds);
  std::ranges::transform(bounds, pairs.begin(), &std::pair<double, int>::second);
}

std::optional<int> ExactCollisionChecker::do_first_collision(int hint) {
  std::vector<UndecidedPair>& undecided = scratch_->undecided;
  undecided.clear();
  if (volumes_->broad_phase->bound(scratch_->placement, hint) < kTouch) {
    if (touches_quickly(hint) || (!undecided.empty() && touches_exactly(hint))) {
      return hint;
    }
    undecided.clear();
  }
  do_near_pairs(kTouch, scratch_->near);
  std::ranges::reverse(scratch_->near);  // what stands still came last, and is hit most often
  for (const int pair : scratch_->near) {
    if (pair != hint && touches_quickly(pair)) {
      return pair;
    }
  }
  std::ranges::sort(undecided, {}, [](const UndecidedPair& candidate) {
    return std::pair(candidate.relative_distance, candidate.pair);
  });
  const auto touching = std::ranges::find_if(
      undecided, [&](const UndecidedPair& candidate) { return touches_exactly(candidate.pair); });
  return touching == undecided.end() ? std::nullopt : std::optional(touching->pair);
}

bool ExactCollisionChecker::touches_exactly(int pair) {
  NarrowPhaseQuery surfaces = query(pair, body_poses());
  const Proximity proximity = exact_proximity(pair, collision_distance(pair), surfaces);
  return proximity == Proximity::kCollision ||
         (proximity == Proximity::kWithinTolerance && world().padding(pair) > 0.0);
}

bool ExactCollisionChecker::touches_quickly(int pair) {
  count_pair_collision();
  const double distance = collision_distance(pair);
  if (is_separated(pair, distance)) {
    return false;
  }
  NarrowPhaseQuery surfaces = query(pair, body_poses());
  if (surfaces.may_be_nearer_than(distance)) {
    if (surely_overlaps(pair, surfaces)) {
      return true;
    }
    scratch_->undecided.push_back({surfaces.relative_distance(), pair});
    return false;
  }
  return is_contained(pair, surfaces);
}

bool ExactCollisionChecker::surely_overlaps(int pair, const NarrowPhaseQuery& surfaces) const {
  if (surfaces.relative_distance() >= kDeep) {
    return false;
  }
  const int a = volumes_->pairs[static_cast<std::size_t>(pair)].a;
  const BodySolids& body = *world().body(a).solids;
  return !body.parts.empty() &&
         std::ranges::any_of(
             *volumes_->surfaces[static_cast<std::size_t>(a)]->balls, [&](const InnerBall& ball) {
               return surfaces.cuts(ball) && body.contains(ball.centre.cast<double>());
             });
}

double ExactCollisionChecker::root_bound(int pair) const {
  return volumes_->broad_phase->bound(scratch_->placement, pair) + world().padding(pair);
}

double ExactCollisionChecker::collision_distance(int pair) const {
  return std::max(kTouch, world().padding(pair));
}

NarrowPhaseQuery ExactCollisionChecker::query(int pair, std::span<const Pose> X_WBody) {
  const BodyPair& bodies = volumes_->pairs[static_cast<std::size_t>(pair)];
  const auto a = static_cast<std::size_t>(bodies.a);
  const auto b = static_cast<std::size_t>(bodies.b);
  return {*volumes_->surfaces[a], *volumes_->surfaces[b], X_WBody[a], X_WBody[b],
          scratch_->triangles};
}

double ExactCollisionChecker::cached_distance(int pair) {
  const PairDistanceCache* table = volumes_->distances->table(pair);
  if (!table) {
    return 0.0;
  }
  return table->bound(configuration(), [&](const Configuration& q) {
    const std::vector<Pose> X_BBody = poses_at_base(world(), q);
    const BodyPair& bodies = world().pairs()[static_cast<std::size_t>(pair)];
    if (contain_each_other(
            *world().body(bodies.a).solids, X_BBody[static_cast<std::size_t>(bodies.a)],
            *world().body(bodies.b).solids, X_BBody[static_cast<std::size_t>(bodies.b)])) {
      return 0.0;
    }
    const double bound = query(pair, X_BBody).bound(kRemembered, kThorough);
    return bound > kFineEnough
               ? bound
               : std::min(kRemembered, query(pair, X_BBody).distance(kRemembered).upper);
  });
}

bool ExactCollisionChecker::touches(int pair) const {
  const BodyPair& bodies = volumes_->pairs[static_cast<std::size_t>(pair)];
  return volumes_->exact.collide(bodies.a, body_poses()[static_cast<std::size_t>(bodies.a)],
                                 bodies.b, body_poses()[static_cast<std::size_t>(bodies.b)]);
}

bool ExactCollisionChecker::do_pair_collides(int pair) {
  return do_pair_proximity(pair, kTouch) == Proximity::kCollision;
}

Proximity ExactCollisionChecker::do_pair_proximity(int pair, double tolerance) {
  return root_bound(pair) >= tolerance ? Proximity::kClear : nearby_proximity(pair, tolerance);
}

bool ExactCollisionChecker::do_pair_is_nearer_than(int pair, double tolerance) {
  if (tolerance < kTouch) {
    return do_pair_collides(pair);
  }
  if (root_bound(pair) >= tolerance || is_separated(pair, tolerance)) {
    return false;
  }
  NarrowPhaseQuery surfaces = query(pair, body_poses());
  if (surfaces.may_be_nearer_than(kTouch) && surely_overlaps(pair, surfaces)) {
    return true;
  }
  const bool is_nearer = surfaces.is_nearer_than(tolerance);
  if (surfaces.was_exact()) {
    count_exact_test();
  }
  return is_nearer || is_contained(pair, surfaces);
}

bool ExactCollisionChecker::boxes_are_apart(int pair, double distance) {
  return volumes_->broad_phase->both_move(pair) &&
         volumes_->boxes.are_apart(pair, body_poses(), distance, scratch_->axes);
}

bool ExactCollisionChecker::is_separated(int pair, double distance) {
  return cached_distance(pair) >= distance || boxes_are_apart(pair, distance);
}

Proximity ExactCollisionChecker::nearby_proximity(int pair, double tolerance) {
  if (is_separated(pair, std::max(tolerance, kTouch))) {
    return Proximity::kClear;
  }
  NarrowPhaseQuery surfaces = query(pair, body_poses());
  return surfaces.may_be_nearer_than(kTouch) && surely_overlaps(pair, surfaces)
             ? Proximity::kCollision
             : exact_proximity(pair, tolerance, surfaces);
}

Proximity ExactCollisionChecker::exact_proximity(int pair, double tolerance,
                                                 NarrowPhaseQuery& surfaces) {
  const Proximity proximity = surfaces.proximity(tolerance);
  if (surfaces.was_exact()) {
    count_exact_test();
  }
  const bool doubtful = proximity == Proximity::kCollision && !surfaces.surely_crosses();
  if (doubtful ? touches(pair) : proximity == Proximity::kCollision) {
    return Proximity::kCollision;
  }
  if (is_contained(pair, surfaces)) {
    return Proximity::kCollision;
  }
  return doubtful ? Proximity::kWithinTolerance : proximity;
}

bool ExactCollisionChecker::is_contained(int pair, const NarrowPhaseQuery& surfaces) const {
  if (surfaces.root_is_clear()) {
    const int around = volumes_->pairs[static_cast<std::size_t>(pair)].b;
    return world().body(around).solids->contains(surfaces.root_centre());
  }
  return !surfaces.hulls_are_apart() && pair_is_contained(pair);
}

double ExactCollisionChecker::do_pair_quick_bound(int pair) {
  return std::max(0.0, root_bound(pair));
}

double ExactCollisionChecker::do_pair_bound(int pair, double enough) {
  if (root_bound(pair) >= enough || boxes_are_apart(pair, enough)) {
    return enough;
  }
  NarrowPhaseQuery surfaces = query(pair, body_poses());
  const double least = surfaces.bound(enough, kQuickNodes);
  if (is_contained(pair, surfaces)) {
    return 0.0;
  }
  return least >= enough ? least : std::min(enough, std::max(least, cached_distance(pair)));
}

double ExactCollisionChecker::do_pair_bound_along(int pair, const PairMotion& motion, double half,
                                                  double enough) {
  const BodyPair& bodies = world().pairs()[static_cast<std::size_t>(pair)];
  const auto moving = [&](int body, const PointMotion& points) -> MovingHull {
    const auto i = static_cast<std::size_t>(body);
    return {*volumes_->surfaces[i]->hull, body_poses()[i], points.v, points.w, points.bend};
  };
  return hull_gap_along(moving(bodies.a, motion.a), moving(bodies.b, motion.b), half, enough);
}

double ExactCollisionChecker::do_pair_distance(int pair, double enough) {
  return std::min(enough, do_pair_distance_range(pair, enough, 0.0).upper);
}

DistanceRange ExactCollisionChecker::do_pair_distance_range(int pair, double enough, double share) {
  if (root_bound(pair) >= enough || boxes_are_apart(pair, enough)) {
    return {enough};
  }
  NarrowPhaseQuery surfaces = query(pair, body_poses());
  const DistanceRange distance = surfaces.distance(enough, share);
  return is_contained(pair, surfaces) ? DistanceRange{0.0, 0.0} : distance;
}

std::unique_ptr<CollisionChecker> make_collision_checker(
    std::shared_ptr<const CollisionWorld> world, CheckerKind kind, const Preparation& preparation) {
  switch (kind) {
    case CheckerKind::kFcl:
      return std::make_unique<FclChecker>(std::move(world));
    case CheckerKind::kFclBroadphase:
      return std::make_unique<FclBroadphaseChecker>(std::move(world));
    case CheckerKind::kFast:
      break;
  }
  return std::make_unique<ExactCollisionChecker>(std::move(world), preparation);
}

}  // namespace handway::geometric
