#include "handway/geometric/collision/checkers/fcl_checker.h"

#include "collision/narrow_phase/fcl_bodies.h"

#include <Eigen/Core>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace handway::geometric {
struct FclChecker::Trees {
  explicit Trees(const CollisionWorld& world) : bodies(world) {}
  FclBodies bodies;
};

FclChecker::FclChecker(std::shared_ptr<const CollisionWorld> world)
    : CollisionChecker(std::move(world)),
      trees_(std::make_shared<const Trees>(CollisionChecker::world())) {}

FclChecker::~FclChecker() = default;

FclChecker::FclChecker(const FclChecker& other) = default;

std::unique_ptr<CollisionChecker> FclChecker::clone() const {
  return std::unique_ptr<CollisionChecker>(new FclChecker(*this));
}

bool FclChecker::do_pair_collides(int pair) {
  const BodyPair& bodies = world().pairs()[static_cast<std::size_t>(pair)];
  count_exact_test();
  return trees_->bodies.collide(bodies.a, body_poses()[static_cast<std::size_t>(bodies.a)],
                                bodies.b, body_poses()[static_cast<std::size_t>(bodies.b)]) ||
         pair_is_contained(pair);
}

double FclChecker::do_pair_distance(int pair, double enough) {
  const BodyPair& bodies = world().pairs()[static_cast<std::size_t>(pair)];
  count_exact_test();
  const double distance =
      trees_->bodies.distance(bodies.a, body_poses()[static_cast<std::size_t>(bodies.a)], bodies.b,
                              body_poses()[static_cast<std::size_t>(bodies.b)], enough);
  return distance > 0.0 && pair_is_contained(pair) ? 0.0 : distance;
}

using Object = fcl::CollisionObjectd;

struct FclBroadphaseChecker::Models {
  explicit Models(const CollisionWorld& world) {
    const int count = static_cast<int>(world.bodies().size());
    FclTrees trees;
    for (const CollisionBody& body : world.bodies()) {
      of_body.push_back(trees.of(*body.mesh));
    }
    pair_of = Eigen::MatrixXi::Constant(count, count, -1);
    for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
      const BodyPair& bodies = world.pairs()[static_cast<std::size_t>(pair)];
      pair_of(bodies.a, bodies.b) = pair_of(bodies.b, bodies.a) = pair;
    }
  }

  std::vector<std::shared_ptr<FclTree>> of_body;
  Eigen::MatrixXi pair_of;  ///< Index of the pair of two bodies; -1: they may touch.
};

struct FclBroadphaseChecker::Managers {
  Managers(const CollisionWorld& world, const Models& models) {
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
      const CollisionBody& body = world.bodies()[i];
      auto object = std::make_unique<Object>(models.of_body[i], body.X_FB);
      object->setUserData(reinterpret_cast<void*>(i));
      object->computeAABB();
      (body.moves() ? moving : still).registerObject(object.get());
      objects.push_back(std::move(object));
    }
    moving.setup();
    still.setup();
  }

  std::vector<std::unique_ptr<Object>> objects;  ///< One a body.
  fcl::DynamicAABBTreeCollisionManagerd moving;
  fcl::DynamicAABBTreeCollisionManagerd still;
};

namespace {

// Data of the managers' callback.
struct Search {
  const Eigen::MatrixXi& pair_of;
  std::function<bool(int)> is_contained;  ///< Tests whether a body contains the other.
  std::optional<int> found = std::nullopt;
  std::uint64_t tests = 0;
};

// @returns whether the search is over.
bool test_pair(Object* a, Object* b, void* data) {
  Search& search = *static_cast<Search*>(data);
  const int pair = search.pair_of(reinterpret_cast<std::ptrdiff_t>(a->getUserData()),
                                  reinterpret_cast<std::ptrdiff_t>(b->getUserData()));
  if (pair >= 0) {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    ++search.tests;
    if (fcl::collide(a, b, request, result) > 0 || search.is_contained(pair)) {
      search.found = pair;
    }
  }
  return search.found.has_value();
}

}  // namespace

FclBroadphaseChecker::FclBroadphaseChecker(std::shared_ptr<const CollisionWorld> world)
    : CollisionChecker(std::move(world)),
      models_(std::make_shared<const Models>(CollisionChecker::world())),
      managers_(std::make_unique<Managers>(CollisionChecker::world(), *models_)) {}

FclBroadphaseChecker::~FclBroadphaseChecker() = default;

FclBroadphaseChecker::FclBroadphaseChecker(const FclBroadphaseChecker& other)
    : CollisionChecker(other),
      models_(other.models_),
      managers_(std::make_unique<Managers>(world(), *models_)) {}

std::unique_ptr<CollisionChecker> FclBroadphaseChecker::clone() const {
  return std::unique_ptr<CollisionChecker>(new FclBroadphaseChecker(*this));
}

void FclBroadphaseChecker::do_place() {
  for (std::size_t i = 0; i < managers_->objects.size(); ++i) {
    if (world().bodies()[i].moves()) {
      managers_->objects[i]->setTransform(body_poses()[i]);
      managers_->objects[i]->computeAABB();
    }
  }
  managers_->moving.update();
}

bool FclBroadphaseChecker::do_pair_collides(int pair) {
  const BodyPair& bodies = world().pairs()[static_cast<std::size_t>(pair)];
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  count_exact_test();
  return fcl::collide(managers_->objects[static_cast<std::size_t>(bodies.a)].get(),
                      managers_->objects[static_cast<std::size_t>(bodies.b)].get(), request,
                      result) > 0 ||
         pair_is_contained(pair);
}

double FclBroadphaseChecker::do_pair_distance(int pair, double enough) {
  const BodyPair& bodies = world().pairs()[static_cast<std::size_t>(pair)];
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  result.min_distance = enough;  // FCL prunes whatever is not closer than this
  count_exact_test();
  fcl::distance(managers_->objects[static_cast<std::size_t>(bodies.a)].get(),
                managers_->objects[static_cast<std::size_t>(bodies.b)].get(), request, result);
  return result.min_distance <= 0.0 || pair_is_contained(pair) ? 0.0 : result.min_distance;
}

std::optional<int> FclBroadphaseChecker::do_first_collision(int hint) {
  if (world().has_padding()) {  // FCL's managers know boxes of bodies only as large as they are
    return CollisionChecker::do_first_collision(hint);
  }
  if (pair_collides(hint)) {
    return hint;
  }
  Search search{models_->pair_of, [this](int pair) { return pair_is_contained(pair); }};
  managers_->moving.collide(&search, test_pair);
  if (!search.found) {
    managers_->moving.collide(&managers_->still, &search, test_pair);
  }
  for (std::uint64_t i = 0; i < search.tests; ++i) {
    count_exact_test();
  }
  return search.found;
}

}  // namespace handway::geometric
