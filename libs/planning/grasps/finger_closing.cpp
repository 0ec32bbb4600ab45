#include "grasps/finger_closing.h"

#include <algorithm>
#include <utility>

namespace handway::planning {
namespace {

constexpr int kMostClosingSteps = 40;  // of full size
constexpr int kMostSteps = 60;         // a finger that slides along something takes small ones
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
  bool grows = false;      // steps, until one is blocked
  for (int step = 0;
       step < kMostSteps && travel < kMostClosingSteps * kClosingStep && !stop.stop_requested();) {
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
    if (moves && keeps_gap(q_next, checks_[which], first, limits)) {
      posture = next;
      q = q_next;
      travel += size;
      ++step;
      size = grows ? std::min(2.0 * size, kClosingStep) : size;
    } else if (moves && size > least) {
      size *= 0.5;
      grows = false;
    } else if (++first == joints) {
      break;
    } else {  // what is in the way mostly stops the outer joints, too: the least step tells
      size = least;
      grows = true;
      rates.resize(0);  // the outer joints go on at full pace
    }
  }
  return q;
}

Configuration FingerClosing::all_closed(Configuration q, const geometric::Aabb& core,
                                        const geometric::Pose& X_PO, const Limits& limits,
                                        const std::stop_token& stop) {
  for (std::size_t finger = 0; finger < hand_.fingers().size(); ++finger) {
    if (!is_near(q, finger, limits.touch)) {
      q = closed(std::move(q), finger, core, X_PO, limits, stop);
    }
  }
  return q;
}

std::vector<FingerClosing::MovedCheck> FingerClosing::checks_of(
    const HandClosing::Finger& finger, const std::vector<int>& with_object,
    const std::vector<int>& of_hand) const {
  constexpr Eigen::Index kNone = -1;
  const geometric::RobotModel& model = problem_.model();
  // For each link, the outermost joint of the finger that moves it.
  std::vector<Eigen::Index> last(static_cast<std::size_t>(model.link_count()), kNone);
  for (int link = 1; link < model.link_count(); ++link) {
    Eigen::Index& joint = last[static_cast<std::size_t>(link)];
    joint = last[static_cast<std::size_t>(model.parent(link))];
    for (std::size_t k = 0; k < finger.joints.size(); ++k) {
      if (problem_.joints.hand[static_cast<std::size_t>(finger.joints[k])] ==
          model.mimic_mapping(link).variable) {
        joint = std::max(joint, static_cast<Eigen::Index>(k));
      }
    }
  }
  const geometric::CollisionWorld& world = checker_.world();
  const auto last_of = [&](int body) {
    const int link = world.body(body).link;
    return world.body(body).moves() && link >= 0 ? last[static_cast<std::size_t>(link)] : kNone;
  };
  std::vector<MovedCheck> checks;
  for (int check = 0; check < world.check_count(); ++check) {
    if (const geometric::LinkConstraint* constraint = world.constraint(check)) {
      if (const Eigen::Index joint = last[static_cast<std::size_t>(constraint->link())];
          joint != kNone) {
        checks.push_back({check, Concern::kOther, joint});
      }
      continue;
    }
    const auto& bodies = world.pairs()[static_cast<std::size_t>(check)];
    if (const Eigen::Index joint = std::max(last_of(bodies.a), last_of(bodies.b)); joint != kNone) {
      const Concern concern = std::ranges::count(with_object, check) > 0 ? Concern::kObject
                              : std::ranges::count(of_hand, check) > 0   ? Concern::kHand
                                                                         : Concern::kOther;
      checks.push_back({check, concern, joint});
    }
  }
  return checks;
}

bool FingerClosing::is_near(const Configuration& q, std::size_t finger, double distance) {
  if (distance <= 0.0) {
    return false;
  }
  checker_.place(q);
  return std::ranges::any_of(checks_[finger], [&](const MovedCheck& moved) {
    return moved.concern == Concern::kObject && checker_.pair_is_nearer_than(moved.check, distance);
  });
}

bool FingerClosing::keeps_gap(const Configuration& q, std::vector<MovedCheck>& checks,
                              Eigen::Index first, const Limits& limits) {
  checker_.place(q);
  const auto keeps = [&](const MovedCheck& moved) {
    if (moved.last < first) {
      return true;
    }
    const double gap = moved.concern == Concern::kObject ? limits.object_gap
                       : moved.concern == Concern::kHand ? limits.own_gap
                                                         : 0.0;
    return gap > 0.0 ? !checker_.pair_is_nearer_than(moved.check, gap)
                     : !checker_.pair_collides(moved.check);
  };
  const auto broken = std::ranges::find_if_not(checks, keeps);
  if (broken == checks.end()) {
    return true;
  }
  std::rotate(checks.begin(), broken, broken + 1);  // it is the likeliest one to be broken next
  return false;
}

}  // namespace handway::planning
