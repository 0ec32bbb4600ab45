#include "handway/geometric/collision/fcl_checker.h"

#include "collision/fcl_bodies.h"

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

}  // namespace handway::geometric
