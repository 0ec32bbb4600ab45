#include "scene_variants.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/narrow_phase/closest_points.h"
#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/sampling/sequences/random_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using geometric::CollisionChecker;
using geometric::CollisionWorld;
using geometric::Configuration;
using geometric::HandStructure;
using geometric::RobotModel;

constexpr double kFar = 0.3;             // m, a finger that is farther away does not close
constexpr double kFirstStep = 0.02;      // rad, or m of a sliding finger
constexpr double kLeastStep = 1e-6;      // step, rad or m
constexpr double kDifference = 1e-4;     // step of the gradient, rad or m
constexpr double kLeastGradient = 1e-4;  // m by rad
constexpr int kMostSteps = 300;

/// Joints and pairs of one finger.
struct Finger {
  geometric::JointIndices joints;
  std::vector<int> pairs;         ///< All pairs with its links.
  std::vector<int> object_pairs;  ///< Pairs with the objects.
};

std::vector<Finger> fingers_of(const CollisionWorld& world, const HandStructure& hand,
                               const std::vector<std::string>& objects) {
  std::vector<Finger> fingers;
  for (const geometric::HandFinger& found : hand.fingers) {
    Finger finger{found.joints, {}, {}};
    const auto is_of_finger = [&](int body) {
      return world.body(body).moves() && std::ranges::count(found.links, world.body(body).link) > 0;
    };
    for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
      const geometric::BodyPair& bodies = world.pairs()[static_cast<std::size_t>(pair)];
      if (is_of_finger(bodies.a) || is_of_finger(bodies.b)) {
        finger.pairs.push_back(pair);
        if (std::ranges::count(objects, world.body(bodies.b).name) > 0) {
          finger.object_pairs.push_back(pair);
        }
      }
    }
    fingers.push_back(std::move(finger));
  }
  return fingers;
}

class FingerClosing {
 public:
  FingerClosing(CollisionChecker& checker, const Finger& finger, double gap)
      : checker_(checker), model_(checker.world().model()), finger_(finger), gap_(gap) {}

  [[nodiscard]] Configuration closed(Configuration q) {
    double distance = distance_to_objects(q);
    double size = kFirstStep;
    for (int step = 0; step < kMostSteps && size > kLeastStep && distance < kFar; ++step) {
      const Configuration direction = closing_direction(q, distance);
      if (direction.norm() < kLeastGradient) {
        break;
      }
      for (; size > kLeastStep; size *= 0.5) {
        const Configuration next =
            (q + size * direction.normalized()).cwiseMax(model_.lower()).cwiseMin(model_.upper());
        const double closer = distance_to_objects(next);
        if (closer < distance && keeps_gap(next)) {
          q = next;
          distance = closer;
          break;
        }
      }
    }
    return q;
  }

 private:
  [[nodiscard]] double distance_to_objects(const Configuration& q) {
    checker_.place(q);
    double least = kFar;
    for (const int pair : finger_.object_pairs) {
      least = std::min(least, checker_.pair_distance(pair, least));
    }
    return least;
  }

  [[nodiscard]] bool keeps_gap(const Configuration& q) {
    checker_.place(q);
    return std::ranges::all_of(finger_.pairs,
                               [&](int pair) { return !checker_.pair_is_nearer_than(pair, gap_); });
  }

  // Direction against the gradient of the distance, of joints that are not at a limit.
  [[nodiscard]] Configuration closing_direction(const Configuration& q, double distance) {
    Configuration direction = Configuration::Zero(q.size());
    for (const int v : finger_.joints) {
      Configuration moved = q;
      const double step = q[v] + kDifference <= model_.upper()[v] ? kDifference : -kDifference;
      moved[v] += step;
      const double rate = (distance - distance_to_objects(moved)) / step;
      const bool stuck = rate > 0.0 ? q[v] >= model_.upper()[v] : q[v] <= model_.lower()[v];
      direction[v] = stuck ? 0.0 : rate;
    }
    return direction;
  }

  CollisionChecker& checker_;
  const RobotModel& model_;
  const Finger& finger_;
  double gap_;
};

/// The links of a hand: its palm and those of all fingers.
geometric::LinkIndices links_of(const HandStructure& hand) {
  geometric::LinkIndices links{hand.palm};
  for (const geometric::HandFinger& finger : hand.fingers) {
    links.insert(links.end(), finger.links.begin(), finger.links.end());
  }
  return links;
}

/// Returns `q` with the hand closed around objects: one finger after the other moves its joints
/// down the gradient of its distance to the nearest of them, until only `gap` to any body is left,
/// the hand's other links included, or its joints are at their limits. A finger that is already
/// closer stays. Same arguments, same bits.
/// @param objects names of fixed bodies. @param gap m, > 0.
Configuration close_hand(CollisionChecker& checker, const HandStructure& hand,
                         const std::vector<std::string>& objects, Configuration q, double gap) {
  for (const Finger& finger : fingers_of(checker.world(), hand, objects)) {
    q = FingerClosing(checker, finger, gap).closed(std::move(q));
  }
  return q;
}

using geometric::FclChecker;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;
using sampling::RandomStream;

constexpr int kMostDraws = 100;
constexpr double kGraspReach = 0.03;  // m, from the hand to what it grasps
constexpr double kDeeper = 1e-3;      // m, that contacts of objects are not distinguished
constexpr double kLowered = 5e-3;     // m, to feel what an object rests on
constexpr double kApproached = 5e-5;  // m
constexpr double kHorizontal = 0.2;   // least horizontal part of a direction
constexpr int kMostApproachSteps = 40;
constexpr double kLeastShare = 0.02;  // share of an approach

/// Objects that move together.
struct Unit {
  std::vector<std::size_t> objects;  ///< Indices in the scene.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  bool rests = false;                      ///< On something else.
  std::map<std::string, double> contacts;  ///< Depth in other objects in the original scene, m.
};

/// Motion of a unit: a rotation about its middle, then a shift.
struct Motion {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::AngleAxisd turn = Eigen::AngleAxisd::Identity();

  [[nodiscard]] Pose about(const Eigen::Vector3d& middle) const {
    return Pose(Eigen::Translation3d(shift + middle) * turn * Eigen::Translation3d(-middle));
  }
};

bool is_movable(const Scene& scene, const SceneObject& object) {
  return !object.attachment && !scene.display.of(object.name).locked &&
         bounding_box(*tessellate(object.shape)).size().maxCoeff() <= kLongestMovable;
}

Eigen::Vector3d middle_of(const Scene& scene, const std::vector<std::size_t>& objects) {
  geometric::TriangleMesh all;
  for (const std::size_t i : objects) {
    append(all, transformed(*tessellate(scene.objects[i].shape), scene.objects[i].X_PO));
  }
  return bounding_box(all).centre();
}

std::vector<Unit> movable_units(const Scene& scene) {
  std::vector<Unit> units;
  std::map<std::string, std::size_t> of_group;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::string& group = scene.display.of(scene.objects[i].name).group;
    const auto [known, is_new] = of_group.emplace(group, units.size());
    if (group.empty() || is_new) {
      units.emplace_back();
    }
    units[group.empty() ? units.size() - 1 : known->second].objects.push_back(i);
  }
  std::erase_if(units, [&](const Unit& unit) {
    return !std::ranges::all_of(unit.objects,
                                [&](std::size_t i) { return is_movable(scene, scene.objects[i]); });
  });
  for (Unit& unit : units) {
    unit.middle = middle_of(scene, unit.objects);
  }
  return units;
}

// A robot that can only lower its attached objects.
geometric::RobotInstance lift() {
  geometric::RobotDescription robot;
  robot.name = "lift";
  robot.links = {{"mast", {}, {}}, {"fork", {}, {}}};
  geometric::Joint joint;
  joint.name = "height";
  joint.type = geometric::JointType::kPrismatic;
  joint.parent = "mast";
  joint.child = "fork";
  joint.limits.lower = -1.0;
  joint.limits.upper = 1.0;
  robot.joints = {joint};
  return {robot.name,
          {},
          std::make_shared<const geometric::RobotModel>(robot),
          Pose::Identity(),
          Configuration::Zero(1)};
}

// Depth of a lowered unit in each other object, m. The planned robot is left out.
std::map<std::string, double> contact_depths(Scene scene, const Unit& unit, double lowered) {
  for (const std::size_t i : unit.objects) {
    scene.objects[i].attachment = geometric::Attachment{"lift", "fork", {}};
  }
  std::erase_if(scene.objects, [robot = scene.robots.front().name](const SceneObject& object) {
    return object.attachment && object.attachment->robot == robot;
  });
  scene.robots.front() = lift();
  FclChecker checker(std::make_shared<const CollisionWorld>(scene));
  std::map<std::string, double> depths;
  for (const auto& contact : find_contacts(checker, Configuration::Constant(1, -lowered))) {
    depths.emplace(contact.b, contact.depth);
  }
  return depths;
}

bool is_deeper(const std::map<std::string, double>& depths,
               const std::map<std::string, double>& allowed) {
  return std::ranges::any_of(depths, [&](const auto& contact) {
    const auto known = allowed.find(contact.first);
    return contact.second > kDeeper + (known == allowed.end() ? 0.0 : known->second);
  });
}

Eigen::Vector3d direction_in_space(RandomStream& random) {
  Eigen::Vector3d direction;
  do {
    direction = 2.0 * random.uniform(3) - Eigen::Vector3d::Ones();
  } while (direction.norm() > 1.0 || direction.norm() < 1e-3);
  return direction.normalized();
}

// Uniform in a disc (for a supported unit) or a ball; the rotation uniform in its range.
Motion drawn_motion(const Unit& unit, RandomStream& random) {
  Motion motion;
  const double share = random.uniform();
  const double turn = kMostVariantTurn * (2.0 * random.uniform() - 1.0);
  if (unit.rests) {
    const double angle = 2.0 * std::numbers::pi * random.uniform();
    motion.shift = kMostVariantShift * std::sqrt(share) *
                   Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    motion.turn = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  } else {
    motion.shift = kMostVariantShift * std::cbrt(share) * direction_in_space(random);
    motion.turn = Eigen::AngleAxisd(turn, direction_in_space(random));
  }
  return motion;
}

Eigen::Vector3d within_shift(const Eigen::Vector3d& shift) {
  return shift * std::min(1.0, kMostVariantShift / std::max(shift.norm(), 1e-12));
}

/// The nearest pair of the robot and some objects.
struct NearestPair {
  int pair = -1;
  double distance = std::numeric_limits<double>::infinity();
};

}  // namespace

double variant_gap(int number) { return geometric::metres(24.0) / number; }

class VariantGenerator::Parts {
 public:
  explicit Parts(const planning::PlanningProblem& problem)
      : problem_(problem),
        scene_(*problem.scene),
        hand_links_(links_of(problem.hand)),
        units_(movable_units(scene_)) {
    for (Unit& unit : units_) {
      unit.contacts = contact_depths(scene_, unit, 0.0);
      unit.rests = is_deeper(contact_depths(scene_, unit, kLowered), unit.contacts);
    }
    find_target();
  }

  [[nodiscard]] const std::vector<std::string>& target() const { return target_names_; }

  /// Returns the placed scene; nothing if that placement is not free.
  [[nodiscard]] std::shared_ptr<const Scene> placed(int number, std::uint64_t seed,
                                                    RandomStream random) const {
    Placement placement{scene_, problem_.checker->shared_world(), nullptr, {}, scene_.goal.value()};
    for (const Unit& unit : units_) {
      placement.motions.push_back(drawn_motion(unit, random));
    }
    for (std::size_t u = 0; u < units_.size(); ++u) {
      move(placement, u);
    }
    placement.checker = make_collision_checker(placement.world);
    if (!objects_fit(placement) || !is_free(*placement.checker, *scene_.start) ||
        !solve_goal(placement)) {
      return nullptr;
    }
    for (std::size_t u = 0; u < units_.size(); ++u) {
      if (u != target_) {
        approach(placement, u, variant_gap(number));
      }
    }
    if (target_) {
      placement.goal = close_hand(*placement.checker, problem_.hand, target_names_, placement.goal,
                                  kVariantHandGap);
    }
    FclChecker reference(placement.world);
    if (!is_free(reference, *scene_.start) || !is_free(reference, placement.goal)) {
      return nullptr;
    }
    return named(std::move(placement), number, seed);
  }

 private:
  /// A variant under construction.
  struct Placement {
    Scene scene;
    std::shared_ptr<const CollisionWorld> world;
    std::unique_ptr<geometric::CollisionChecker> checker;  ///< Checker of `world`.
    std::vector<Motion> motions;                           ///< Motions of the units.
    Configuration goal;
  };

  void find_target() {
    if (problem_.joints.arm.empty()) {
      return;
    }
    const auto checker = problem_.checker->clone();
    double least = kGraspReach;
    for (std::size_t u = 0; u < units_.size(); ++u) {
      const NearestPair nearest = nearest_pair(*checker, names(u), *scene_.goal, true);
      if (nearest.distance < least) {
        least = nearest.distance;
        target_ = u;
      }
    }
    if (target_) {
      target_names_ = names(*target_);
    }
  }

  [[nodiscard]] std::vector<std::string> names(std::size_t unit) const {
    std::vector<std::string> names;
    for (const std::size_t i : units_[unit].objects) {
      names.push_back(scene_.objects[i].name);
    }
    return names;
  }

  [[nodiscard]] NearestPair nearest_pair(geometric::CollisionChecker& checker,
                                         const std::vector<std::string>& objects,
                                         const Configuration& q, bool hand_only) const {
    const CollisionWorld& world = checker.world();
    checker.place(q);
    NearestPair nearest;
    for (const std::string& object : objects) {
      for (const int pair : world.pairs_with(object)) {
        const int link = world.body(world.pairs()[static_cast<std::size_t>(pair)].a).link;
        if (hand_only && std::ranges::count(hand_links_, link) == 0) {
          continue;
        }
        if (const double d = checker.pair_distance(pair, nearest.distance); d < nearest.distance) {
          nearest = {pair, d};
        }
      }
    }
    return nearest;
  }

  /// Moves a unit by its motion.
  void move(Placement& placement, std::size_t u) const {
    const Unit& unit = units_[u];
    for (const std::size_t i : unit.objects) {
      SceneObject& object = placement.scene.objects[i];
      object.X_PO = placement.motions[u].about(unit.middle) * scene_.objects[i].X_PO;
      placement.world = std::make_shared<const CollisionWorld>(
          placement.world->with_object_at(object.name, object.X_PO));
    }
  }

  [[nodiscard]] bool objects_fit(const Placement& placement) const {
    return std::ranges::all_of(units_, [&](const Unit& unit) {
      return !is_deeper(contact_depths(placement.scene, unit, 0.0), unit.contacts);
    });
  }

  [[nodiscard]] bool is_free(geometric::CollisionChecker& checker, const Configuration& q) const {
    return limit_violations(problem_.model(), q).empty() && !checker.first_collision(q);
  }

  /// Finds the free arm posture nearest to the scene's goal that keeps the palm at the target.
  /// @returns whether one was found.
  [[nodiscard]] bool solve_goal(Placement& placement) const {
    std::vector<Configuration> goals{*scene_.goal};
    if (target_) {
      const planning::PalmIk ik(scene_.robots.front().model, problem_.hand.palm,
                                problem_.joints.arm);
      const Pose& X_WB = scene_.robots.front().X_WB;
      const Pose moved = placement.motions[*target_].about(units_[*target_].middle);
      goals = ik.all(*scene_.goal, X_WB.inverse() * moved * X_WB * ik.pose(*scene_.goal));
    }
    const auto free = std::ranges::find_if(
        goals, [&](const Configuration& q) { return is_free(*placement.checker, q); });
    if (free == goals.end()) {
      return false;
    }
    placement.goal = *free;
    return true;
  }

  /// Unit vector along which a unit gets nearer to the robot at the goal; zero: it can't.
  [[nodiscard]] Eigen::Vector3d approach_direction(const Placement& placement, std::size_t u,
                                                   int nearest_pair) const {
    const auto& bodies = placement.world->pairs()[static_cast<std::size_t>(nearest_pair)];
    const auto points = geometric::ClosestPointFinder(placement.world)
                            .between(placement.world->body(bodies.a).name,
                                     placement.world->body(bodies.b).name, placement.goal);
    if (!points) {
      return Eigen::Vector3d::Zero();
    }
    Eigen::Vector3d direction = (points->p_WA - points->p_WB).normalized();
    if (units_[u].rests) {
      direction.z() = 0.0;
    }
    return direction.norm() < kHorizontal ? Eigen::Vector3d::Zero().eval() : direction.normalized();
  }

  void shift_to(Placement& placement, std::size_t u, const Eigen::Vector3d& shift) const {
    placement.motions[u].shift = shift;
    move(placement, u);
    placement.checker = make_collision_checker(placement.world);
  }

  /// Shifts a unit towards the robot at the goal, or away from it, until `gap` is left, or as far
  /// as it may move; then back to a free place. A step by the gap's excess can't overshoot.
  void approach(Placement& placement, std::size_t u, double gap) const {
    const Eigen::Vector3d from = placement.motions[u].shift;
    for (int step = 0; step < kMostApproachSteps; ++step) {
      const NearestPair nearest = nearest_pair(*placement.checker, names(u), placement.goal, false);
      if (nearest.pair < 0 || std::abs(nearest.distance - gap) < kApproached) {
        break;
      }
      const Eigen::Vector3d shift = placement.motions[u].shift;
      const Eigen::Vector3d next = within_shift(
          shift + (nearest.distance - gap) * approach_direction(placement, u, nearest.pair));
      if ((next - shift).norm() < kApproached) {
        break;
      }
      shift_to(placement, u, next);
    }
    const Eigen::Vector3d approached = placement.motions[u].shift - from;
    const auto fits = [&] {
      return is_free(*placement.checker, *scene_.start) &&
             !is_deeper(contact_depths(placement.scene, units_[u], 0.0), units_[u].contacts);
    };
    double share = approached.isZero() ? 0.0 : 1.0;
    while (share > 0.0 && !fits()) {
      share = share > kLeastShare ? 0.5 * share : 0.0;
      shift_to(placement, u, from + share * approached);
    }
  }

  [[nodiscard]] std::shared_ptr<const Scene> named(Placement placement, int number,
                                                   std::uint64_t seed) const {
    Scene& scene = placement.scene;
    scene.description = fmt::format("Variant {} of \"{}\", seed {}.", number, scene.name, seed);
    scene.name = fmt::format("{}, variant {}, seed {}", scene.name, number, seed);
    scene.goal = placement.goal;
    return std::make_shared<const Scene>(std::move(scene));
  }

  const planning::PlanningProblem& problem_;
  const Scene& scene_;
  geometric::LinkIndices hand_links_;
  std::vector<Unit> units_;
  std::optional<std::size_t> target_;  ///< Empty: the goal stays.
  std::vector<std::string> target_names_;
};

VariantGenerator::VariantGenerator(const planning::PlanningProblem& problem)
    : parts_(std::make_unique<Parts>(problem)) {}

VariantGenerator::~VariantGenerator() = default;

SceneVariant VariantGenerator::make(int number, std::uint64_t seed) const {
  SceneVariant variant{number, seed, 0, nullptr};
  const RandomStream random = RandomStream(seed).fork(static_cast<std::uint64_t>(number));
  while (!variant.scene && variant.draws < kMostDraws) {
    variant.scene =
        parts_->placed(number, seed, random.fork(static_cast<std::uint64_t>(variant.draws)));
    ++variant.draws;
  }
  return variant;
}

const std::vector<std::string>& VariantGenerator::target() const { return parts_->target(); }

}  // namespace handway::tools
