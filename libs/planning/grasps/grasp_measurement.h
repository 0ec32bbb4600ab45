#pragma once

#include "grasps/contact_finder.h"
#include "grasps/finger_closing.h"
#include "grasps/hand_closing.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/queries/palm_ik.h"

#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// Closes the hand of pre-grasps up to contact, and measures how the object is held. For one
/// thread.
class GraspMeasurement {
 public:
  /// The hand of a search and what moves it; outlives this object.
  struct Hand {
    const PlanningProblem& problem;
    const PalmIk& ik;
    const HandClosing& hand;
    geometric::CollisionChecker& checker;
    FingerClosing& closing;
  };

  /// @param pairs of the checker's world, of the hand's links with the object.
  GraspMeasurement(const Hand& hand, const geometric::SceneObject& object, std::vector<int> pairs,
                   const PregraspOptions& options, const std::stop_token& stop);

  /// Sets all of `grasp` that follows from closing it, but for its score. After a stop was
  /// requested it may leave the grasp as it is.
  /// @param core what the fingers close around, m, in the object's frame.
  /// @param needed epsilon (N) without which nobody wants the grasp.
  /// @returns false if it has less: then not all of it is set.
  bool measure(Pregrasp& grasp, const geometric::Aabb& core,
               double needed = -std::numeric_limits<double>::infinity());

  /// Like measure(), for a hand that is at the object already: fingers that touch it stay, the
  /// others close until they do. @param start posture of the hand, free.
  void measure_held(Pregrasp& grasp, const Configuration& start, const geometric::Aabb& core);

 private:
  bool set_closed(Configuration closed, double needed, Pregrasp& grasp);
  [[nodiscard]] int finger_of(int link) const;
  /// @param touch fingers that are nearer to the object, m, stay.
  [[nodiscard]] Configuration closed_to_contact(Configuration q, const geometric::Aabb& core,
                                                double touch);
  [[nodiscard]] Configuration closed_once(Configuration q, const geometric::Aabb& core,
                                          double touch);
  [[nodiscard]] std::optional<Eigen::Vector3d> centring(const Configuration& q);
  [[nodiscard]] std::optional<double> holding_force(
      const std::vector<GraspContact>& contacts) const;
  [[nodiscard]] Configuration squeezed(const Configuration& closed,
                                       const std::vector<LinkContact>& found,
                                       const std::vector<GraspContact>& contacts) const;
  [[nodiscard]] std::string doubt_of(const Pregrasp& grasp) const;

  Hand of_;
  PregraspOptions options_;
  std::stop_token stop_;
  geometric::Pose X_WB_;
  geometric::Pose X_BO_;
  ContactFinder contacts_;
  TorqueScale scale_;
};

}  // namespace handway::planning
