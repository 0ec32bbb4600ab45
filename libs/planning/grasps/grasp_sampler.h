#pragma once

#include "grasps/finger_closing.h"
#include "grasps/grasp_measurement.h"
#include "grasps/grasp_place.h"
#include "grasps/hand_closing.h"
#include "grasps/object_chords.h"
#include "grasps/pregrasp_candidates.h"
#include "handway/planning/grasps/given_grasps.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// Epsilon (N) from which a grasp gets full marks.
inline constexpr double kFullEpsilon = 0.15;

/// Tries places of the hand around an object; one per thread.
class GraspSampler {
 public:
  GraspSampler(const PlanningProblem& problem, const geometric::SceneObject& object,
               const PregraspOptions& options, const std::stop_token& stop);

  /// Returns why there is nothing to try; empty if there is.
  [[nodiscard]] std::string invalid_problem_reason() const;

  [[nodiscard]] int palm() const { return ik_.palm(); }

  /// Tries a place of the hand anywhere around the object.
  /// @param judges whether a rejected place is searched for what is in the way.
  [[nodiscard]] SampleResult sample(sampling::RandomStream random, bool judges);

  /// Tries a place beside that of a measured candidate; finds a better grasp or none.
  [[nodiscard]] SampleResult neighbour(const Candidate& candidate, sampling::RandomStream random);

  /// Tries the place of a given grasp: the fingers open off the object, and close onto it.
  [[nodiscard]] SampleResult given(const GivenGrasp& grasp);

  /// Closes the hand of a candidate up to contact, measures how the object is held, and sets its
  /// score.
  /// @param needed epsilon (N) without which it is not wanted.
  /// @returns false if it has less: then not all of it is set.
  bool measure(Candidate& candidate, double needed = -HUGE_VAL);

  /// Describes why a given grasp is not possible.
  [[nodiscard]] std::string why_not(const SampleResult& result) const;

  /// Explains why a search found no grasp.
  [[nodiscard]] std::string why_none(const SampleResults& results) const;

 private:
  using ArmPostures = std::function<std::vector<Configuration>()>;

  /// Closes the hand at a place and sets the result's end.
  /// @param reached a configuration with the opened hand there; none if the arm does not get there.
  /// @param others returns other postures of the arm, for the case that the first one collides.
  void try_place(const GraspPlace& place, const std::vector<Configuration>& reached,
                 const ArmPostures& others, bool judges, SampleResult& result);

  /// Returns the part of the object between the fingertips of a hand at that pose.
  [[nodiscard]] geometric::Aabb held_core(const geometric::Pose& X_OP,
                                          const Configuration& q) const;

  /// Returns `q` with the hand's joints of another configuration.
  [[nodiscard]] Configuration hand_in(Configuration q, const Configuration& other) const;

  /// Finds what is in the way of a configuration that is no grasp.
  void judge(const Configuration& q, SampleResult& result);

  /// Returns the first colliding check of `q`, if any.
  std::optional<int> colliding(const Configuration& q);

  /// Checks the gaps of the configuration that was placed last.
  bool keeps_gaps();

  /// Returns whether a check depends on the hand's place and posture alone.
  [[nodiscard]] bool is_of_hand(int pair) const;

  /// Opens fingers off the object step by step.
  struct Opening {
    double gap = 0.0;   ///< m to the object from which on a finger is open.
    double step = 0.0;  ///< Normalised joints.
    int most = 0;       ///< Steps.
  };

  /// Returns whether one of these links is nearer to the object than the gap.
  bool touches(const Configuration& q, const std::vector<int>& links, double gap);

  /// Opens the fingers that are in the object or too near to it.
  Configuration opened(Configuration q, const geometric::Aabb& core, const Opening& opening);

  /// Sets the score of a measured candidate.
  static void rate(Candidate& candidate);

  /// Returns the pose of the object in the palm's frame.
  [[nodiscard]] geometric::Pose object_in_palm(const Configuration& q) const;

  /// Returns the grasp of a closed hand, if two fingers are at different sides of the object.
  std::optional<Candidate> candidate_of(const Configuration& q, const GraspPlace& place);

  /// Scores a pre-grasp before it is measured.
  /// @param unopposed imbalance() of the fingers' sides: such a grasp slips off, as jaws do that
  /// close on a chord of what is round.
  [[nodiscard]] double promise(const Pregrasp& grasp, double unopposed) const;

  /// Scores a pre-grasp without regard to how its fingers oppose each other.
  [[nodiscard]] double plain_promise(const Pregrasp& grasp) const;

  /// Returns the finger's link that is nearest to the object, if it is near.
  std::optional<int> nearest_link(const HandClosing::Finger& finger);

  const PlanningProblem& problem_;
  PregraspOptions options_;
  std::stop_token stop_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  PalmIk ik_;
  HandClosing hand_;
  geometric::Aabb box_;
  ObjectChords chords_;
  bool is_too_large_ = false;
  geometric::Pose X_BO_;
  std::vector<int> with_object_;
  std::vector<int> with_others_;
  std::vector<int> of_hand_;  ///< Pairs of its links.
  std::unique_ptr<FingerClosing> closing_;
  std::unique_ptr<GraspMeasurement> measurement_;
  std::vector<std::vector<Eigen::Vector3d>>
      surfaces_;  ///< Points on every link of a finger, in its frame.
  std::string object_;
  int last_pair_ = 0;
};

}  // namespace handway::planning
