#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/grasps/grasp_quality.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace handway::planning {

/// Options of the search for pre-grasps.
struct PregraspOptions {
  /// Palm poses to try at most: fewer once as many pre-grasps as are wanted are found and do not
  /// get better any more.
  int samples = 8000;
  double gap = 0.003;       ///< m that every finger keeps to the object.
  double own_gap = 0.0003;  ///< m that the hand's links keep to each other.
  int most = 8;             ///< Pre-grasps to give.
  /// Further ones to give, if there are, for which the search makes no effort.
  int spares = 0;
  /// The search ends as soon as `most` are found whose epsilon is at least this, N.
  double enough_epsilon = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 1;
  int threads = 2;            ///< That search; any number of them gives the same bits.
  ContactModel contact = {};  ///< Forces that links transmit to the object.
  double payload = 0.1;       ///< Mass of the object, kg, for Pregrasp::holding_force.
  /// Least depth that the links would go into the object in the squeeze posture, m: what a hand
  /// without force control pushes with. The squeeze is deeper where the payload needs more force.
  double squeeze = 0.01;
  double stiffness = 5.0;           ///< N·m/rad of a revolute joint's position control.
  double slide_stiffness = 1000.0;  ///< N/m of a prismatic joint's position control.
};

/// Describes the options that users choose, but seed and threads.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    PregraspOptions& options);

/// A place where the hand touches the object.
struct HandContact {
  int finger = -1;   ///< Index from the first finger of the model; -1 is the palm.
  std::string link;  ///< Its name.
  GraspContact contact;
  double distance = 0.0;  ///< m, what is left between the surfaces.
};

/// A grasp: a free configuration with the fingers around an object, just before they touch it, and
/// what closing them leads to.
struct Pregrasp {
  Configuration q;
  /// With the fingers closed from there until they touch the object or something else. Where one
  /// joint moves several fingers, the arm moves too, so that all of them touch.
  Configuration closed = {};
  /// Joint targets beyond `closed` that make the fingers push: with the joints' stiffness, the
  /// torques of contact forces that balance each other (internal_contact_forces()). Their normal
  /// forces sum up to three times the weight of the payload over the friction, or more.
  Configuration squeezed = {};
  std::vector<HandContact> contacts = {};  ///< Contacts in `closed`.
  /// Quality of `contacts`. Grasps are ranked by their epsilon above all.
  GraspQuality quality = {};
  /// The largest of the least contact forces that hold PregraspOptions::payload against gravity,
  /// N; nothing if friction cannot hold it.
  std::optional<double> holding_force = {};
  /// Why the grasp is not to be trusted; empty if it resists forces and torques from everywhere.
  std::string doubt = {};
  int fingers = 0;         ///< That are near the object.
  double enclosure = 0.0;  ///< 0: all on one side of the object; 1: two on opposite sides.
  double clearance = 0.0;  ///< From the robot to all fixed bodies but the object, m, at most 0.05.
  double subspace_distance =
      0.0;                  ///< From the hand's PMD subspace, normalised joints; 0 without one.
  double arm_travel = 0.0;  ///< From the start, normalised joints.
  std::string source = {};  ///< Origin of a given grasp (GivenGrasp); empty for a found one.
  /// In [0, 1]; what they are ranked by. 0.7 min(1, epsilon / 0.15) + 0.3 times the mean of what is
  /// above: 35 % fingers, 25 % enclosure, 15 % clearance (full at 30 mm), 15 % nearness to the PMD
  /// subspace, 10 % shortness of the arm's path; less where the fingers do not oppose each other.
  double score = 0.0;
};

/// Returns the number of fingers that touch the object in Pregrasp::closed; the palm counts as one.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::size_t touching_fingers(const Pregrasp& grasp);

/// Result of a search.
struct Pregrasps {
  std::vector<Pregrasp> found;  ///< The best first.
  /// Reason if nothing is found: what ruled out (nearly) all places of the hand that were tried,
  /// the object's size, the arm's reach, or what is in the way; and what to do.
  std::string why_none;
  int palm = -1;  ///< Link that is the palm of the hand that grasps.
};

/// Receives how far a search is, on the thread that searches: first when the first grasp is found
/// (or nothing is found for a while), then again and again, and once at the end with fraction 1.
/// `found` are the best until then, the best first, valid during the call; `fraction` of the search
/// is done, in [0, 1], and never falls. It may request a stop.
using PregraspProgress = std::function<void(const std::vector<Pregrasp>& found, double fraction)>;

/// Looks for pre-grasps. Each sample draws a chord of the object, from anywhere on its surface to a
/// side with an opposed normal; a preshape from the basis' box (of a hand without one: between
/// its neutral posture and any other) whose opening between the thumb and the fingers, or the two
/// jaws of a gripper, suits the chord's length; and a palm pose with the chord between them,
/// anywhere from the fingertips to the palm, and turned about the chord. Fingers that would be in
/// the object are opened; the arm's inverse kinematics is solved; and where that is free every
/// finger closes, its joints by the gradient of the tip's distance to the core of the object around
/// the chord, until near contact: joints stop from the palm outwards, so that outer links go on
/// around the object. Kept are those with two or more fingers on different sides of the object;
/// similar ones are left out, and fingers that would push it out of the hand, as jaws on a chord of
/// what is round, are ranked low. The most promising ones are closed up to contact and ranked by
/// how they hold the object (GraspQuality). After that every second sample, up to 96 for each
/// wanted grasp, moves and turns the palm of one of the best whose epsilon is below 0.15 N by up to
/// 15 mm and 15 degrees, and replaces it where that is better. Those that do not resist some force
/// or torque are given if there is nothing better, with the reason. Of a robot whose arms have a
/// hand each, the hand that is nearest to the object at the start grasps. Same arguments, same
/// bits.
/// @param object of the scene, that stands still.
/// @param stop ends the search within 100 ms. @param progress may be empty.
/// @returns after `stop` was requested what was found until then, without a reason if that is
/// nothing.
/// @throws InputError if there is no such object or the robot has no hand.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Pregrasps find_pregrasps(
    const PlanningProblem& problem, std::string_view object, const PregraspOptions& options = {},
    const std::stop_token& stop = {}, const PregraspProgress& progress = {});

}  // namespace handway::planning
