#include "grasps/pregrasp_candidates.h"

#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Pose;

constexpr double kSameTurn = geometric::radians(30.0);
constexpr double kSamePlace = 0.03;  // m
constexpr int kMostJudged = 400;     // rejected places of the hand, to say what was in the way
constexpr int kPoolFactor = 2;       // candidates that are measured, times those wanted, …
constexpr int kLeastPool = 16;       // … and at least

// Returns indices of the `most` admitted candidates with the highest value that have the palm at
// different places, the highest first.
template <typename Value, typename Admits>
CandidateIndices distinct(const std::vector<Candidate>& candidates, const Value& value,
                          const Admits& admits, int most) {
  CandidateIndices ranked;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (admits(candidates[i])) {
      ranked.push_back(i);
    }
  }
  std::ranges::stable_sort(ranked, std::greater(),
                           [&](std::size_t i) { return value(candidates[i]); });
  CandidateIndices chosen;
  for (const std::size_t i : ranked) {
    const Pose& X_BP = candidates[i].X_BP;
    const bool is_known = std::ranges::any_of(chosen, [&](std::size_t other_index) {
      const Pose& other = candidates[other_index].X_BP;
      return (X_BP.translation() - other.translation()).norm() < kSamePlace &&
             Eigen::AngleAxisd(X_BP.linear().transpose() * other.linear()).angle() < kSameTurn;
    });
    if (!is_known) {
      chosen.push_back(i);
    }
    if (static_cast<int>(chosen.size()) >= most) {
      break;
    }
  }
  return chosen;
}

}  // namespace

void SampleResults::add(SampleResult result) {
  ++rejections_.tried;
  narrowest_ = std::min(narrowest_, result.width);
  rejections_.too_wide += result.end == SampleEnd::kTooWide ? 1 : 0;
  rejections_.too_thin += result.end == SampleEnd::kTooThin ? 1 : 0;
  rejections_.out_of_reach += result.end == SampleEnd::kOutOfReach ? 1 : 0;
  rejections_.in_object += result.end == SampleEnd::kInObject ? 1 : 0;
  rejections_.one_sided += result.end == SampleEnd::kOneSided ? 1 : 0;
  if (result.end == SampleEnd::kBlocked) {
    rejections_.block(result.in_the_way);
  }
  if (result.candidate) {
    candidates_.push_back(std::move(*result.candidate));
  }
}

bool SampleResults::asks_why() const {
  return candidates_.empty() && rejections_.judged() < kMostJudged;
}

int SampleResults::pool_size() const { return std::max(kLeastPool, kPoolFactor * most_); }

CandidateIndices SampleResults::best(int spares) const {
  const bool has_good = std::ranges::any_of(candidates_, &Candidate::is_good);
  return distinct(
      candidates_, [](const Candidate& candidate) { return candidate.grasp.score; },
      [&](const Candidate& candidate) {
        return has_good ? candidate.is_good() : candidate.is_measured();
      },
      most_ + spares);
}

CandidateIndices SampleResults::to_be_measured() const {
  CandidateIndices promising = distinct(
      candidates_, [](const Candidate& candidate) { return candidate.promise; },
      [](const Candidate& candidate) { return !candidate.is_measured() || candidate.is_good(); },
      pool_size());
  std::erase_if(promising, [&](std::size_t i) { return candidates_[i].is_measured(); });
  return promising;
}

}  // namespace handway::planning
