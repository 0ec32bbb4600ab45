#include "handway/geometric/collision/collision_checker.h"

#include "collision/volumes/solid.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace handway::geometric {
namespace {

// Describes the constraint's state in the configuration in place.
std::string description(const LinkConstraint& constraint, const CollisionChecker& checker) {
  return "constraint " + constraint.name() + ": " + constraint.description(checker.link_poses());
}

}  // namespace

CollisionChecker::CollisionChecker(std::shared_ptr<const CollisionWorld> world)
    : world_(std::move(world)),
      X_BL_(static_cast<std::size_t>(world_->model().link_count())),
      X_WBody_(world_->bodies().size()) {
  std::ranges::transform(world_->bodies(), X_WBody_.begin(), &CollisionBody::X_FB);
}

CollisionChecker::CollisionChecker(const CollisionChecker& other)
    : world_(other.world_), X_BL_(other.X_BL_.size()), X_WBody_(other.X_WBody_) {}

void CollisionChecker::place(const Configuration& q) {
  const int expected = world_->model().variable_count();
  if (q.size() != expected) {
    throw std::invalid_argument("configuration has " + std::to_string(q.size()) +
                                " values, the robot " + std::to_string(expected) + " variables");
  }
  if (!q.allFinite()) {
    throw std::invalid_argument("configuration holds a value that is not a finite number");
  }
  ++counts_.configurations;
  q_ = q;
  world_->place_moving(q, X_BL_, X_WBody_);
  do_place();
}

bool CollisionChecker::pair_is_contained(int pair) const {
  const auto& [a, b] = world_->pairs()[static_cast<std::size_t>(pair)];
  return contain_each_other(*world_->body(a).solids, X_WBody_[static_cast<std::size_t>(a)],
                            *world_->body(b).solids, X_WBody_[static_cast<std::size_t>(b)]);
}

std::vector<Enclosed> CollisionChecker::enclosed(const Configuration& q) {
  place(q);
  std::vector<Enclosed> list;
  const auto add = [&](int inner, int outer) {
    const BodySolids& around = *world_->body(outer).solids;
    if (around.shells.empty()) {
      return;
    }
    const BodySolids& within = *world_->body(inner).solids;
    const Pose X_OI = X_WBody_[static_cast<std::size_t>(outer)].inverse(Eigen::Isometry) *
                      X_WBody_[static_cast<std::size_t>(inner)];
    for (std::size_t piece = 0; piece < within.points.size(); ++piece) {
      for (std::size_t shell = 0; shell < around.shells.size(); ++shell) {
        const auto& [X_GB, solid] = around.shells[shell];
        if (solid->contains(X_GB * X_OI * within.points[piece])) {
          list.push_back({inner, outer, static_cast<int>(piece), static_cast<int>(shell)});
        }
      }
    }
  };
  for (const auto& [a, b] : world_->pairs()) {
    add(a, b);
    add(b, a);
  }
  std::ranges::sort(list, {}, &Enclosed::key);
  return list;
}

bool CollisionChecker::pair_collides(int pair) {
  if (const LinkConstraint* constraint = world_->constraint(pair)) {
    return constraint->slack(X_BL_) < 0.0;
  }
  ++counts_.pair_collisions;
  const double padding = world_->padding(pair);
  return padding > 0.0 ? do_pair_is_nearer_than(pair, padding) : do_pair_collides(pair);
}

double CollisionChecker::pair_distance(int pair, double enough) {
  if (const LinkConstraint* constraint = world_->constraint(pair)) {
    return std::clamp(constraint->slack(X_BL_), 0.0, enough);
  }
  ++counts_.pair_distances;
  const double padding = world_->padding(pair);
  return std::max(0.0, do_pair_distance(pair, enough + padding) - padding);
}

Proximity CollisionChecker::pair_proximity(int pair, double tolerance) {
  if (const LinkConstraint* constraint = world_->constraint(pair)) {
    const double slack = constraint->slack(X_BL_);
    return slack >= tolerance ? Proximity::kClear
           : slack < 0.0      ? Proximity::kCollision
                              : Proximity::kWithinTolerance;
  }
  ++counts_.pair_distances;
  const double padding = world_->padding(pair);
  const Proximity proximity = do_pair_proximity(pair, tolerance + padding);
  const bool is_within_padding = padding > 0.0 && proximity == Proximity::kWithinTolerance &&
                                 do_pair_is_nearer_than(pair, padding);
  return is_within_padding ? Proximity::kCollision : proximity;
}

bool CollisionChecker::pair_is_nearer_than(int pair, double tolerance) {
  if (const LinkConstraint* constraint = world_->constraint(pair)) {
    return constraint->slack(X_BL_) < tolerance;
  }
  ++counts_.pair_distances;
  return do_pair_is_nearer_than(pair, tolerance + world_->padding(pair));
}

DistanceRange CollisionChecker::do_pair_distance_range(int pair, double enough, double /*share*/) {
  const double distance = do_pair_distance(pair, enough);
  return distance < enough ? DistanceRange{distance, distance} : DistanceRange{enough};
}

Proximity CollisionChecker::do_pair_proximity(int pair, double tolerance) {
  const double distance = do_pair_distance(pair, tolerance);
  if (distance >= tolerance) {
    return Proximity::kClear;
  }
  return distance <= 0.0 && do_pair_collides(pair) ? Proximity::kCollision
                                                   : Proximity::kWithinTolerance;
}

std::optional<int> CollisionChecker::first_collision(const Configuration& q) {
  const std::optional<int> pair = first_collision(q, last_collision_);
  last_collision_ = pair.value_or(last_collision_);
  return pair;
}

std::optional<int> CollisionChecker::first_collision(const Configuration& q, int hint) {
  place(q);
  const int pairs = static_cast<int>(world_->pairs().size());
  for (int check = pairs; check < world_->check_count(); ++check) {
    if (pair_collides(check)) {
      return check;
    }
  }
  return pairs == 0 ? std::nullopt : do_first_collision(hint < pairs ? hint : 0);
}

std::optional<int> CollisionChecker::first_collision_among(std::span<const int> pairs,
                                                           const Configuration& q) {
  place(q);
  const auto found = std::ranges::find_if(pairs, [&](int pair) { return pair_collides(pair); });
  return found == pairs.end() ? std::nullopt : std::optional(*found);
}

void CollisionChecker::do_near_pairs(double /*distance*/, PairIndices& pairs) {
  pairs.resize(world_->pairs().size());
  std::iota(pairs.begin(), pairs.end(), 0);
}

std::optional<int> CollisionChecker::do_first_collision(int hint) {
  if (pair_collides(hint)) {
    return hint;
  }
  for (int pair = 0; pair < static_cast<int>(world_->pairs().size()); ++pair) {
    if (pair_collides(pair)) {
      return pair;
    }
  }
  return std::nullopt;
}

NamedPair named_pair(const CollisionWorld& world, int pair, double distance) {
  if (const LinkConstraint* constraint = world.constraint(pair)) {
    return {constraint->name(), "", distance};
  }
  const BodyPair& bodies = world.pairs()[static_cast<std::size_t>(pair)];
  return {world.body(bodies.a).name, world.body(bodies.b).name, distance};
}

std::string to_string(const NamedPair& pair) {
  return pair.b.empty() ? "constraint " + pair.a : pair.a + " with " + pair.b;
}

std::string describe_conflict(CollisionChecker& checker, int pair, const Configuration& q) {
  if (const LinkConstraint* constraint = checker.world().constraint(pair)) {
    checker.place(q);
    return "violates " + description(*constraint, checker);
  }
  return "is in collision: " + to_string(named_pair(checker.world(), pair, 0.0));
}

std::vector<std::string> violated_constraints(CollisionChecker& checker, const Configuration& q) {
  checker.place(q);
  std::vector<std::string> violated;
  for (const LinkConstraint& constraint : checker.world().constraints()) {
    if (constraint.slack(checker.link_poses()) < 0.0) {
      violated.push_back(description(constraint, checker));
    }
  }
  return violated;
}

PairIndices touching_pairs(CollisionChecker& checker, const Configuration& q) {
  checker.place(q);
  PairIndices touching;
  for (int pair = 0; pair < static_cast<int>(checker.world().pairs().size()); ++pair) {
    if (checker.pair_collides(pair)) {
      touching.push_back(pair);
    }
  }
  return touching;
}

std::vector<NamedPair> find_collisions(CollisionChecker& checker, const Configuration& q) {
  std::vector<NamedPair> collisions;
  for (const int pair : touching_pairs(checker, q)) {
    collisions.push_back(named_pair(checker.world(), pair, 0.0));
  }
  return collisions;
}

NamedPair find_clearance(CollisionChecker& checker, const Configuration& q, double enough) {
  checker.place(q);
  NamedPair closest{"", "", enough};
  PairIndices near;
  checker.near_pairs_closest_first(enough, near);
  for (const int pair : near) {
    const double distance = checker.pair_distance(pair, closest.distance);
    if (distance < closest.distance) {
      closest = named_pair(checker.world(), pair, distance);
    }
  }
  return closest;
}

bool is_closer_than(CollisionChecker& checker, const Configuration& q, double distance) {
  checker.place(q);
  PairIndices near;
  checker.near_pairs(distance, near);
  return std::ranges::any_of(near,
                             [&](int pair) { return checker.pair_is_nearer_than(pair, distance); });
}

}  // namespace handway::geometric
