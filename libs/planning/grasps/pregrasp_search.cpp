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

constexpr double kNear = 0.02;       // m, of a finger at the object
constexpr double kEnclosure = 0.25;  // at least
constexpr double kClear = 0.05;      // m that is not told apart
constexpr double kMost = 0.16;       // m, of the object's second longest side
constexpr double kAside = 0.02;      // m
constexpr int kClosingSteps = 40;
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

// Uniform on SO(3): Shoemake, "Uniform random rotations", Graphics Gems III, 1992.
Eigen::Quaterniond random_turn(sampling::RandomStream& random) {
  const Eigen::VectorXd u = random.uniform(3);
  const double a = 2.0 * std::numbers::pi * u[1];
  const double b = 2.0 * std::numbers::pi * u[2];
  const double r = std::sqrt(1.0 - u[0]);
  const double s = std::sqrt(u[0]);
  return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
}

class Search {
 public:
  Search(const PlanningProblem& problem, const geometric::SceneObject& object,
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
    const geometric::CollisionWorld& world = checker_->world();
    for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
      if (!world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]) &&
          std::ranges::count(with_object_, pair) == 0) {
        with_others_.push_back(pair);
      }
    }
  }

  void find_middles() {
    for (const geometric::CollisionBody& body : checker_->world().bodies()) {
      if (body.moves() && !body.is_carried) {
        middles_[static_cast<std::size_t>(body.link)] =
            geometric::bounding_box(*body.mesh).centre();
      }
    }
  }

  [[nodiscard]] bool fits() const {
    Eigen::Vector3d size = box_.size();
    std::ranges::sort(size);
    return size[1] < kMost;
  }

  void try_sample(sampling::RandomStream random) {
    const auto& preshape = hand_.preshapes()[random.below(hand_.preshapes().size())];
    const Eigen::Quaterniond turn = random_turn(random);
    // Where on the object: its longest side has room to choose.
    Eigen::Index longest = 0;
    box_.size().maxCoeff(&longest);
    Eigen::Vector3d p_O = box_.centre();
    p_O[longest] += 0.5 * (random.uniform() - 0.5) * box_.size()[longest];
    const Eigen::Vector3d aside =
        2.0 * kAside * (random.uniform(3) - Eigen::Vector3d::Constant(0.5));
    Pose X_WP = Pose::Identity();
    X_WP.linear() = turn.toRotationMatrix();
    X_WP.translation() = X_WO_ * p_O - X_WP.linear() * (preshape.grip + aside);
    const Configuration opened = hand_.with_hand(problem_.start, preshape.open);
    for (const Configuration& q : ik_.all(opened, X_BW_ * X_WP)) {
      if (keeps_gap(q)) {
        take(closed(q, preshape));
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
  bool keeps_gap(const Configuration& q) {
    if (const auto pair = checker_->first_collision(q, last_pair_)) {
      last_pair_ = *pair;
      return false;
    }
    return std::ranges::all_of(with_object_, [&](int pair) {
      return checker_->pair_closeness(pair, options_.gap) == geometric::Closeness::kFarther;
    });
  }

  /// `q` with `part` of the hand as far along `closing` as it goes.
  Configuration closed_along(const Configuration& q, const Eigen::VectorXd& closing) {
    const Eigen::VectorXd open = hand_.hand_of(q);
    Configuration last = q;
    for (int step = 1; step <= kClosingSteps; ++step) {
      const Configuration next =
          hand_.with_hand(q, open + (static_cast<double>(step) / kClosingSteps) * closing);
      if (!keeps_gap(next)) {
        break;
      }
      last = next;
    }
    return last;
  }

  Configuration closed(Configuration q, const HandClosing::Preshape& preshape) {
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      Eigen::VectorXd part = Eigen::VectorXd::Zero(preshape.closing.size());
      part(finger.joints) = preshape.closing(finger.joints);
      q = closed_along(q, part);
    }
    return q;
  }

  void take(const Configuration& q) {
    Pregrasp grasp{q};
    checker_->place(q);
    const Eigen::Vector3d centre = X_WO_ * box_.centre();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      if (const auto nearest = nearest_link(finger)) {
        const Eigen::Vector3d p_W =
            X_BW_.inverse() * (checker_->link_poses()[static_cast<std::size_t>(*nearest)] *
                               middles_[static_cast<std::size_t>(*nearest)]);
        sum += (p_W - centre).normalized();
        ++grasp.fingers;
      }
    }
    if (grasp.fingers < 2) {
      return;
    }
    grasp.enclosure = 1.0 - sum.norm() / grasp.fingers;
    if (grasp.enclosure < kEnclosure) {
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
    return 0.3 * full(grasp.enclosure, 0.8) +
           0.2 * grasp.fingers / static_cast<double>(hand_.fingers().size()) +
           0.2 * full(grasp.clearance, 0.03) + 0.15 * (1.0 - full(grasp.subspace_distance, 0.5)) +
           0.15 * (1.0 - full(grasp.arm_travel, 1.0));
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
  Pose X_WO_;
  Pose X_BW_;
  std::vector<int> with_object_;
  std::vector<int> with_others_;
  std::vector<Eigen::Vector3d> middles_;  ///< Of every link, in its frame.
  std::vector<Pregrasp> found_;
  int last_pair_ = 0;
};

}  // namespace

std::vector<Pregrasp> find_pregrasps(const PlanningProblem& problem, std::string_view object,
                                     const PregraspOptions& options, const std::stop_token& stop) {
  Search search(problem, needed_object(problem, object), options);
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
