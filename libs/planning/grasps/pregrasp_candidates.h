#pragma once

#include "grasps/grasp_place.h"
#include "grasps/pregrasp_rejections.h"
#include "handway/planning/grasps/pregrasp_search.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

/// Pre-grasps that a search has found, and what became of its samples.

namespace handway::planning {

/// Stage at which a sample ended.
enum class SampleEnd {
  kTooWide,
  kTooThin,
  kOutOfReach,
  kInObject,
  kBlocked,
  kOneSided,
  kFound,
  kUnknown,  ///< Rejected, and not asked why.
};

/// A pre-grasp that was found, and what is known of it.
struct Candidate {
  Pregrasp grasp;
  GraspPlace place;      ///< The place that it was found at.
  double promise = 0.0;  ///< The score of the pre-grasp alone.
  geometric::Pose X_BP;  ///< Pose of the palm.

  [[nodiscard]] bool is_measured() const { return grasp.closed.size() > 0; }
  [[nodiscard]] bool is_good() const { return is_measured() && grasp.doubt.empty(); }
};

/// Result of trying one place of the hand.
struct SampleResult {
  SampleEnd end = SampleEnd::kUnknown;
  double width = HUGE_VAL;           ///< Width of the object between the fingers, m.
  std::set<std::string> in_the_way;  ///< If blocked.
  std::optional<Candidate> candidate;
};

using CandidateIndices = std::vector<std::size_t>;

/// Collects the results of the samples of a search, added in their order.
class SampleResults {
 public:
  /// @param most grasps that are wanted.
  explicit SampleResults(int most) : most_(most) {}

  void add(SampleResult result);

  [[nodiscard]] const PregraspRejections& rejections() const { return rejections_; }
  /// Least width of the object between the fingers of any sample, m.
  [[nodiscard]] double narrowest() const { return narrowest_; }
  [[nodiscard]] const std::vector<Candidate>& candidates() const { return candidates_; }
  [[nodiscard]] Candidate& candidate(std::size_t index) { return candidates_[index]; }
  /// Returns whether it helps to know why one more sample is rejected.
  [[nodiscard]] bool asks_why() const;

  /// Candidates that are measured at a time, in places that differ.
  [[nodiscard]] int pool_size() const;
  /// Returns indices of the measured candidates that differ, the best first; those in doubt if
  /// there are no others. @param spares more than are wanted.
  [[nodiscard]] CandidateIndices best(int spares = 0) const;
  /// Returns indices of those among the most promising candidates that are to be measured.
  [[nodiscard]] CandidateIndices to_be_measured() const;

 private:
  int most_;
  std::vector<Candidate> candidates_;
  PregraspRejections rejections_;
  double narrowest_ = HUGE_VAL;
};

}  // namespace handway::planning
