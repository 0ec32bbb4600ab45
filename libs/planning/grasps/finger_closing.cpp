#include "grasps/finger_closing.h"

#include <algorithm>
#include <utility>

namespace handway::planning {
namespace {

constexpr int kMostClosingSteps = 40;
constexpr double kLeastRate = 1e-3;    // gradient of the tip's distance that still closes it
constexpr double kClosingStep = 0.03;  // normalised
constexpr int kStepsOfDirection = 4;   // that a finger goes on in one direction of its joints

}  // namespace

FingerClosing::FingerClosing(const PlanningProblem& problem, const HandClosing& hand,
                             geometric::CollisionChecker& checker,
                             const std::vector<int>& with_object, const std::vector<int>& of_hand)
    : problem_(problem), hand_(hand), checker_(checker) {
  for (const HandClosing::Finger& finger : hand.fingers()) {
    checks_.push_back(checks_of(finger, with_object, of_hand));
  }
}

Configuration FingerClosing::closed(Configuration q, std::size_t which, const geometric::Aabb& core,
                                    const geometric::Pose& X_PO, const Limits& limits,
                                    const std::stop_token& stop) {
  const HandClosing::Finger& finger = hand_.fingers()[which];
  Eigen::VectorXd posture = hand_.hand_of(q);
  Eigen::VectorXd rates;
  double size = kClosingStep;
  const double least = kClosingStep / (1 << limits.halvings);
  const auto joints = static_cast<Eigen::Index>(finger.joints.size());
  Eigen::Index first = 0;  // joint that does not stand
  double travel = 0.0;     // normalised
  for (int step = 0; travel < kMostClosingSteps * kClosingStep && !stop.stop_requested();) {
    if (step % kStepsOfDirection == 0 || rates.size() == 0) {
      rates = hand_.towards(finger, posture, core, X_PO);
      const double left = rates.tail(joints - first).norm();
      rates = left > kLeastRate ? Eigen::VectorXd(rates / left) : Eigen::VectorXd::Zero(joints);
    }
    Eigen::VectorXd next = posture;
    for (Eigen::Index k = first; k < joints; ++k) {
      next[finger.joints[static_cast<std::size_t>(k)]] += size * rates[k];
    }
    next = next.cwiseMax(0.0).cwiseMin(1.0);
    const Configuration q_next = hand_.with_hand(q, next);
    const bool moves = next != posture;
    if (moves && keeps_gap(q_next, checks_[which], limits)) {
      posture = next;
      q = q_next;
      travel += size;
      ++step;
    } else if (moves && size > least) {
      size *= 0.5;
    } else if (++first == joints) {
      break;
    } else {
      size = kClosingStep;
      rates.resize(0);  // the outer joints go on at full pace
    }
  }
  return q;
}

Configuration FingerClosing::all_closed(Configuration q, const geometric::Aabb& core,
                                        const geometric::Pose& X_PO, const Limits& limits,
                                        const std::stop_token& stop) {
  for (std::size_t finger = 0; finger < hand_.fingers().size(); ++finger) {
    q = closed(std::move(q), finger, core, X_PO, limits, stop);
  }
  return q;
}

std::vector<FingerClosing::MovedCheck> FingerClosing::checks_of(
    const HandClosing::Finger& finger, const std::vector<int>& with_object,
    const std::vector<int>& of_hand) const {
  const geometric::RobotModel& model = problem_.model();
  std::vector<bool> moved(static_cast<std::size_t>(model.link_count()), false);
  for (int link = 1; link < model.link_count(); ++link) {
    const bool is_driven = std::ranges::any_of(finger.joints, [&](int joint) {
      return problem_.hand[static_cast<std::size_t>(joint)] == model.drive(link).variable;
    });
    moved[static_cast<std::size_t>(link)] =
        is_driven || moved[static_cast<std::size_t>(model.parent(link))];
  }
  const geometric::CollisionWorld& world = checker_.world();
  const auto moves = [&](int body) {
    const int link = world.body(body).link;
    return world.body(body).moves() && link >= 0 && moved[static_cast<std::size_t>(link)];
  };
  std::vector<MovedCheck> checks;
  for (int check = 0; check < world.check_count(); ++check) {
    if (const geometric::LinkConstraint* constraint = world.constraint(check)) {
      if (moved[static_cast<std::size_t>(constraint->link())]) {
        checks.push_back({check, Concern::kOther});
      }
      continue;
    }
    const auto& bodies = world.pairs()[static_cast<std::size_t>(check)];
    if (moves(bodies.a) || moves(bodies.b)) {
      checks.push_back({check, std::ranges::count(with_object, check) > 0 ? Concern::kObject
                               : std::ranges::count(of_hand, check) > 0   ? Concern::kHand
                                                                          : Concern::kOther});
    }
  }
  return checks;
}

bool FingerClosing::keeps_gap(const Configuration& q, const std::vector<MovedCheck>& checks,
                              const Limits& limits) {
  checker_.place(q);
  return std::ranges::all_of(checks, [&](const MovedCheck& moved) {
    const double gap = moved.concern == Concern::kObject ? limits.object_gap
                       : moved.concern == Concern::kHand ? limits.own_gap
                                                         : 0.0;
    return gap > 0.0 ? checker_.pair_closeness(moved.check, gap) == geometric::Closeness::kFarther
                     : !checker_.pair_collides(moved.check);
  });
}

}  // namespace handway::planning
