#pragma once

#include "grasps/hand_closing.h"
#include "handway/geometric/collision/collision_checker.h"

#include <stop_token>
#include <vector>

namespace handway::planning {

/// Closes the fingers of a hand around an object, step by step, until something is in the way.
/// For one thread.
class FingerClosing {
 public:
  /// Distances that a closing finger keeps, and how near it gets to them.
  struct Limits {
    double object_gap = 0.0;  ///< m, to the object.
    double own_gap = 0.0;     ///< m, between the hand's links.
    int halvings = 0;         ///< Times that a blocked step is halved before a joint stops.
    double touch = 0.0;       ///< m: fingers that are nearer to the object at first stay.
  };

  /// @param problem, hand, checker outlive this object.
  /// @param with_object pairs of the checker's world with the object.
  /// @param of_hand pairs of the hand's links.
  FingerClosing(const PlanningProblem& problem, const HandClosing& hand,
                geometric::CollisionChecker& checker, const std::vector<int>& with_object,
                const std::vector<int>& of_hand);

  /// Closes all fingers around a box, which stands for the object's core, one after the other.
  /// Where something is in the way, a finger's joints stop one after the other, the one at the palm
  /// first, so that the outer links go on. Joints that mimic or are coupled follow.
  /// @param q keeps the gaps. @param core m, in a frame O. @param X_PO that frame in the palm's.
  [[nodiscard]] Configuration all_closed(Configuration q, const geometric::Aabb& core,
                                         const geometric::Pose& X_PO, const Limits& limits,
                                         const std::stop_token& stop);

 private:
  [[nodiscard]] Configuration closed(Configuration q, std::size_t finger,
                                     const geometric::Aabb& core, const geometric::Pose& X_PO,
                                     const Limits& limits, const std::stop_token& stop);
  /// Kinds of pairs and constraints that are checked when a finger moves.
  enum class Concern { kObject, kHand, kOther };
  struct MovedCheck {
    int check = 0;
    Concern concern = Concern::kOther;
    Eigen::Index last = 0;  ///< Outermost joint of the finger that moves one of its bodies.
  };

  [[nodiscard]] std::vector<MovedCheck> checks_of(const HandClosing::Finger& finger,
                                                  const std::vector<int>& with_object,
                                                  const std::vector<int>& of_hand) const;
  /// Returns whether a finger is nearer to the object than that, m.
  [[nodiscard]] bool is_near(const Configuration& q, std::size_t finger, double distance);
  /// @param first joint of the finger that moves; what only joints before it move keeps its gap.
  [[nodiscard]] bool keeps_gap(const Configuration& q, std::vector<MovedCheck>& checks,
                               Eigen::Index first, const Limits& limits);

  const PlanningProblem& problem_;
  const HandClosing& hand_;
  geometric::CollisionChecker& checker_;
  std::vector<std::vector<MovedCheck>> checks_;  ///< One list for each finger.
};

}  // namespace handway::planning
