#include "handway/planning/grasps/pregrasp_search.h"

#include "grasps/hand_closing.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>

namespace handway::planning {
namespace {

using geometric::Pose;

constexpr double kNear = 0.015;     // m, of a finger at the object
constexpr double kEnclosure = 0.5;  // at least: thumb and a finger at right angles
constexpr double kClear = 0.05;     // m: more is not distinguished
constexpr double kMost = 0.16;      // m, of the object's second longest side
constexpr double kRoom = 0.06;      // m, that an opened hand may be wider than that
constexpr double kAside = 0.015;    // m
constexpr double kDeepest = 0.4;    // of the way from the fingertips to the palm
constexpr double kTilt = geometric::radians(25.0);
constexpr int kClosingSteps = 40;
constexpr int kOpeningSteps = 12;
constexpr double kOpeningStep = 0.06;  // normalised
constexpr double kClosingStep = 0.03;  // normalised
constexpr double kSameTurn = geometric::radians(30.0);
constexpr double kSamePlace = 0.03;  // m

const geometric::SceneObject& needed_object(const PlanningProblem& problem, std::string_view name) {
  const std::string file = problem.scene->file.string();
  const geometric::SceneObject* object = geometric::find_object(*problem.scene, name);
  if (!object || object->attachment) {
    throw geometric::InputError({file, "object", std::string(name), "an object that stands still",
                                 "Choose another one to grasp"});
  }
  if (problem.hand.empty() || !problem.basis || problem.basis->directions.empty()) {
    throw geometric::InputError({file, "hand_basis", "nothing",
                                 "a hand with principal motion directions",
                                 "Name a basis in the scene"});
  }
  return *object;
}

class PregraspSearch {
 public:
  PregraspSearch(const PlanningProblem& problem, const geometric::SceneObject& object,
                 const PregraspOptions& options)
      : problem_(problem),
        options_(options),
        checker_(problem.checker->clone()),
        ik_(problem.scene->robots.front().model,
            palm_link(problem.model(), problem.arm, problem.hand), problem.arm),
        hand_(problem, ik_.palm()),
        box_(geometric::bounding_box(*geometric::tessellate(object.shape))),
        X_WO_(object.X_PO),
        X_BW_(problem.scene->robots.front().X_WB.inverse()),
        with_object_(checker_->world().pairs_with(object.name)),
        middles_(static_cast<std::size_t>(problem.model().link_count()), Eigen::Vector3d::Zero()) {
    find_middles();
    box_.size().maxCoeff(&longest_);
    Eigen::Vector3d sides = box_.size();
    std::ranges::sort(sides);
    middle_side_ = sides[1];
    const geometric::CollisionWorld& world = checker_->world();
    for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
      if (!world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]) &&
          std::ranges::count(with_object_, pair) == 0) {
        with_others_.push_back(pair);
      }
      if (world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]) && is_of_hand(pair)) {
        of_hand_.push_back(pair);
      }
    }
  }

  [[nodiscard]] bool fits() const { return middle_side_ < kMost && !hand_.preshapes().empty(); }

  void try_sample(sampling::RandomStream random) {
    const auto& preshape = hand_.preshapes()[random.below(hand_.preshapes().size())];
    const Pose X_OP = palm_at(preshape, random);
    const double width = width_along(X_OP.linear() * preshape.opposition);
    if (preshape.opening < width || preshape.opening > width + kRoom) {
      return;  // it does not fit, or the hand would close on from too far
    }
    const Configuration opened = hand_.with_hand(problem_.start, preshape.open);
    const std::vector<Configuration> ways = ik_.all(opened, X_BW_ * X_WO_ * X_OP);
    if (ways.empty()) {
      return;
    }
    const Configuration wider = opened_wider(ways.front());
    for (Configuration q : ways) {  // the hand is at the same place in all of them
      q(problem_.hand) = wider(problem_.hand);
      const std::optional<int> pair = colliding(q);
      if (!pair && keeps_gaps()) {
        take(closed(q));
        return;
      }
      if (!pair || is_of_hand(*pair)) {
        return;
      }
    }
  }

  [[nodiscard]] std::vector<Pregrasp> best() {
    std::ranges::stable_sort(found_, std::greater(), &Pregrasp::score);
    std::vector<Pregrasp> chosen;
    std::vector<Pose> palms;
    for (Pregrasp& grasp : found_) {
      const Pose X_BP = ik_.pose(grasp.q);
      const bool known = std::ranges::any_of(palms, [&](const Pose& other) {
        return Eigen::AngleAxisd(X_BP.linear().transpose() * other.linear()).angle() < kSameTurn &&
               (X_BP.translation() - other.translation()).norm() < kSamePlace;
      });
      if (!known) {
        palms.push_back(X_BP);
        chosen.push_back(std::move(grasp));
      }
      if (static_cast<int>(chosen.size()) >= options_.most) {
        break;
      }
    }
    return chosen;
  }

 private:
  void find_middles() {
    for (const geometric::CollisionBody& body : checker_->world().bodies()) {
      if (body.moves() && !body.is_carried) {
        middles_[static_cast<std::size_t>(body.link)] =
            geometric::bounding_box(*body.mesh).centre();
      }
    }
  }

  /// The fingers side by side along one of the object's edges, more or less, and the object
  /// between them and the thumb.
  [[nodiscard]] Pose palm_at(const HandClosing::Preshape& preshape,
                             sampling::RandomStream& random) const {
    const auto signed_uniform = [&] { return 2.0 * random.uniform() - 1.0; };
    Eigen::Matrix3d of_hand;  // row, opposition and what is square to both
    of_hand << preshape.row, preshape.opposition, preshape.row.cross(preshape.opposition);
    const auto edge = static_cast<int>(random.below(3));
    const Eigen::Vector3d row = (random.below(2) == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(edge);
    const Eigen::Vector3d across = Eigen::AngleAxisd(std::numbers::pi * signed_uniform(), row) *
                                   Eigen::Vector3d::Unit((edge + 1) % 3);
    Eigen::Matrix3d of_object;
    of_object << row, across, row.cross(across);
    const Eigen::Vector3d tilt =
        kTilt * Eigen::Vector3d(signed_uniform(), signed_uniform(), signed_uniform());
    const Eigen::Matrix3d tilted =
        Eigen::AngleAxisd(tilt.norm(), tilt.norm() > 0.0 ? Eigen::Vector3d(tilt.normalized())
                                                         : Eigen::Vector3d::UnitX().eval())
            .toRotationMatrix();
    Pose X_OP = Pose::Identity();
    X_OP.linear() = of_object * tilted * of_hand.transpose();
    Eigen::Vector3d p_O = box_.centre();  // its longest side has room to choose
    p_O[longest_] += 0.35 * signed_uniform() * box_.size()[longest_];
    // Somewhere between the fingertips and the palm.
    const Eigen::Vector3d aside =
        kAside * Eigen::Vector3d(signed_uniform(), signed_uniform(), signed_uniform());
    const double depth = 1.0 - kDeepest * random.uniform();
    X_OP.translation() = p_O - X_OP.linear() * (depth * preshape.grip + aside);
    return X_OP;
  }

  /// Of the box around the object, along a direction of its frame, m.
  [[nodiscard]] double width_along(const Eigen::Vector3d& direction) const {
    return direction.cwiseAbs().dot(box_.size());
  }

  std::optional<int> colliding(const Configuration& q) {
    const std::optional<int> pair = checker_->first_collision(q, last_pair_);
    last_pair_ = pair.value_or(last_pair_);
    return pair;
  }

  /// As it was placed last.
  bool keeps_gaps() {
    const auto keep = [this](const std::vector<int>& pairs, double gap) {
      return std::ranges::all_of(pairs, [&](int pair) {
        return checker_->pair_closeness(pair, gap) == geometric::Closeness::kFarther;
      });
    };
    return keep(with_object_, options_.gap) && keep(of_hand_, options_.own_gap);
  }

  bool keeps_gap(const Configuration& q) { return !colliding(q) && keeps_gaps(); }

  /// Does it only depend on where the hand is?
  [[nodiscard]] bool is_of_hand(int pair) const {
    const geometric::CollisionWorld& world = checker_->world();
    const auto is_hand_link = [&](int link) {
      return link == ik_.palm() ||
             std::ranges::any_of(hand_.fingers(), [&](const HandClosing::Finger& finger) {
               return std::ranges::count(finger.links, link) > 0;
             });
    };
    if (const geometric::LinkConstraint* constraint = world.constraint(pair)) {
      return is_hand_link(constraint->link());
    }
    const auto is_hand = [&](int body) {
      return !world.body(body).moves() || is_hand_link(world.body(body).link);
    };
    const auto& bodies = world.pairs()[static_cast<std::size_t>(pair)];
    return is_hand(bodies.a) && is_hand(bodies.b);
  }

  /// Closes one finger around the object's longest axis. Where something is in the way, its joints
  /// stop one after the other, the one at the palm first, so that the outer links go on.
  Configuration closed_finger(Configuration q, const HandClosing::Finger& finger) {
    const auto [a, b] = axis_in_palm(q);
    Eigen::VectorXd posture = hand_.hand_of(q);
    Eigen::VectorXd rates;
    for (int step = 0, first = 0; step < kClosingSteps;) {
      if (step % 4 == 0 || rates.size() == 0) {
        rates = hand_.towards(finger, posture, a, b);
      }
      Eigen::VectorXd next = posture;
      for (auto k = static_cast<Eigen::Index>(first); k < rates.size(); ++k) {
        next[finger.joints[static_cast<std::size_t>(k)]] += kClosingStep * rates[k];
      }
      next = next.cwiseMax(0.0).cwiseMin(1.0);
      const Configuration q_next = hand_.with_hand(q, next);
      if (next != posture && keeps_gap(q_next)) {
        posture = next;
        q = q_next;
        ++step;
      } else if (++first == static_cast<int>(finger.joints.size())) {
        break;
      }
    }
    return q;
  }

  /// Is one of these links at the object?
  bool touches(const Configuration& q, const std::vector<int>& links) {
    checker_->place(q);
    const geometric::CollisionWorld& world = checker_->world();
    return std::ranges::any_of(with_object_, [&](int pair) {
      const int link = world.body(world.pairs()[static_cast<std::size_t>(pair)].a).link;
      return std::ranges::count(links, link) > 0 &&
             checker_->pair_closeness(pair, options_.gap) != geometric::Closeness::kFarther;
    });
  }

  /// Opens the fingers that are in the object.
  Configuration opened_wider(Configuration q) {
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      if (!touches(q, finger.links)) {
        continue;
      }
      const auto [a, b] = axis_in_palm(q);
      Eigen::VectorXd posture = hand_.hand_of(q);
      const Eigen::VectorXd rates = hand_.towards(finger, posture, a, b);
      for (int step = 0; step < kOpeningSteps && touches(q, finger.links); ++step) {
        for (Eigen::Index k = 0; k < rates.size(); ++k) {
          posture[finger.joints[static_cast<std::size_t>(k)]] -= kOpeningStep * rates[k];
        }
        posture = posture.cwiseMax(0.0).cwiseMin(1.0);
        q = hand_.with_hand(q, posture);
      }
    }
    return q;
  }

  /// The object's longest axis, as far as fingers go to it.
  [[nodiscard]] std::pair<Eigen::Vector3d, Eigen::Vector3d> axis_in_palm(
      const Configuration& q) const {
    const Pose X_PO = (X_WO_.inverse() * X_BW_.inverse() * ik_.pose(q)).inverse();
    Eigen::Vector3d along = Eigen::Vector3d::Zero();
    along[longest_] = 0.5 * std::max(0.0, box_.size()[longest_] - middle_side_);
    return {X_PO * (box_.centre() - along), X_PO * (box_.centre() + along)};
  }

  Configuration closed(Configuration q) {
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      q = closed_finger(std::move(q), finger);
    }
    return q;
  }

  void take(const Configuration& q) {
    Pregrasp grasp{q};
    checker_->place(q);
    const auto [a, b] = axis_in_palm(q);
    const Pose X_PB = ik_.pose(q).inverse();
    std::vector<Eigen::Vector3d> sides;  // of the object, on which the fingers are
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      if (const auto nearest = nearest_link(finger)) {
        const Eigen::Vector3d p_P = X_PB *
                                    checker_->link_poses()[static_cast<std::size_t>(*nearest)] *
                                    middles_[static_cast<std::size_t>(*nearest)];
        sides.push_back((p_P - nearest_on_segment(p_P, a, b)).normalized());
      }
    }
    grasp.fingers = static_cast<int>(sides.size());
    for (const Eigen::Vector3d& one : sides) {
      for (const Eigen::Vector3d& other : sides) {
        grasp.enclosure = std::max(grasp.enclosure, 0.5 * (1.0 - one.dot(other)));
      }
    }
    if (grasp.fingers < 2 || grasp.enclosure < kEnclosure) {
      return;
    }
    grasp.clearance = kClear;
    for (const int pair : with_others_) {
      grasp.clearance = std::min(grasp.clearance, checker_->pair_distance(pair, grasp.clearance));
    }
    grasp.subspace_distance = sampling::distance_to_subspace(*problem_.basis, hand_.hand_of(q));
    Configuration arm_only = problem_.start;
    arm_only(problem_.arm) = q(problem_.arm);
    grasp.arm_travel = normalised_distance(problem_.model(), problem_.start, arm_only);
    grasp.score = score(grasp);
    found_.push_back(std::move(grasp));
  }

  [[nodiscard]] double score(const Pregrasp& grasp) const {
    const auto full = [](double value, double most) { return std::min(value / most, 1.0); };
    return 0.35 * grasp.fingers / static_cast<double>(hand_.fingers().size()) +
           0.25 * grasp.enclosure + 0.15 * full(grasp.clearance, 0.03) +
           0.15 * (1.0 - full(grasp.subspace_distance, 1.0)) +
           0.1 * (1.0 - full(grasp.arm_travel, 1.0));
  }

  /// The finger's link that is nearest to the object, if it is near.
  std::optional<int> nearest_link(const HandClosing::Finger& finger) {
    std::optional<int> nearest;
    double least = kNear;
    const geometric::CollisionWorld& world = checker_->world();
    for (const int pair : with_object_) {
      const int link = world.body(world.pairs()[static_cast<std::size_t>(pair)].a).link;
      if (std::ranges::count(finger.links, link) == 0) {
        continue;
      }
      if (const double distance = checker_->pair_distance(pair, least); distance < least) {
        least = distance;
        nearest = link;
      }
    }
    return nearest;
  }

  const PlanningProblem& problem_;
  PregraspOptions options_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  PalmIk ik_;
  HandClosing hand_;
  geometric::Aabb box_;
  Eigen::Index longest_ = 0;
  double middle_side_ = 0.0;
  Pose X_WO_;
  Pose X_BW_;
  std::vector<int> with_object_;
  std::vector<int> with_others_;
  std::vector<int> of_hand_;              ///< Pairs of its links.
  std::vector<Eigen::Vector3d> middles_;  ///< Of every link, in its frame.
  std::vector<Pregrasp> found_;
  int last_pair_ = 0;
};

}  // namespace

std::vector<Pregrasp> find_pregrasps(const PlanningProblem& problem, std::string_view object,
                                     const PregraspOptions& options, const std::stop_token& stop) {
  PregraspSearch search(problem, needed_object(problem, object), options);
  if (!search.fits()) {
    return {};
  }
  const sampling::RandomStream random(options.seed);
  for (int i = 0; i < options.samples; ++i) {
    if (stop.stop_requested()) {
      return {};
    }
    search.try_sample(random.fork(static_cast<std::uint64_t>(i)));
  }
  return search.best();
}

}  // namespace handway::planning
