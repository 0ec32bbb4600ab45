#include "handway/planning/grasps/pregrasp_search.h"

#include "grasps/grasp_sampler.h"
#include "grasps/grasping_hand.h"
#include "grasps/pregrasp_candidates.h"
#include "grasps/sampler_pool.h"
#include "handway/sampling/sequences/random_stream.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

constexpr int kLeastSamples = 1024;       // before a search ends early …
constexpr int kSamplesWithoutGain = 384;  // … since so many samples made a full list no better, …
constexpr int kGoodPatience = 192;        // … or so many one whose mean score is …
constexpr double kGoodScore = 0.85;       // … at least this, …
constexpr int kMorePatience = 2048;       // … or so many a shorter one
constexpr double kScoreGain = 0.01;       // of a score
constexpr int kMostMeasured = 3;          // times that, with those that turn out bad
constexpr std::size_t kMeasuredEach = 8;  // at a time
constexpr int kBatch = 32;                // samples between two reports of progress
constexpr int kFirstNeighbour = 512;      // sample, and …
constexpr int kNeighbourEach = 2;         // … then each of so many, …
constexpr int kNeighbours = 96;           // … and that for each grasp

/// When a search has found enough: as many as are wanted, and none better for a while.
class Patience {
 public:
  explicit Patience(const PregraspOptions& options)
      : most_(options.most), enough_(options.enough_epsilon) {}

  void note(const std::vector<Pregrasp>& found, int samples) {
    double sum = 0.0;
    for (const Pregrasp& grasp : found) {
      sum += grasp.score;
    }
    if (sum > sum_ + kScoreGain * most_ ||
        (!found.empty() && found.front().score > best_ + kScoreGain)) {
      sum_ = sum;
      best_ = found.front().score;
      since_ = samples;
    }
    const bool is_long =
        !found.empty() && samples >= kLeastSamples && samples - since_ >= patience(found, sum);
    ended_ = is_long || is_enough(found);
  }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  [[nodiscard]] bool is_enough(const std::vector<Pregrasp>& found) const {
    return std::ssize(found) >= most_ && std::ranges::all_of(found, [this](const Pregrasp& grasp) {
             return grasp.quality.epsilon >= enough_;
           });
  }
  /// Samples without gain that end the search. @param sum of the scores.
  [[nodiscard]] int patience(const std::vector<Pregrasp>& found, double sum) const {
    if (static_cast<int>(found.size()) < most_) {
      return kMorePatience;
    }
    return sum >= kGoodScore * most_ ? kGoodPatience : kSamplesWithoutGain;
  }

  int most_;
  double enough_;  ///< N
  double sum_ = 0.0;
  double best_ = 0.0;
  int since_ = 0;
  bool ended_ = false;
};

/// Runs the samples of a search on several threads, in batches that are added in their order: the
/// number of threads changes nothing.
class SampleRunner {
 public:
  SampleRunner(const PlanningProblem& problem, const geometric::SceneObject& object,
               const PregraspOptions& options, const std::stop_token& stop)
      : stop_(stop),
        results_(options.most),
        measurements_left_(static_cast<std::size_t>(kMostMeasured * results_.pool_size())),
        wanted_(options.most),
        random_(options.seed),
        samplers_(problem, object, options, stop) {}

  [[nodiscard]] const GraspSampler& sampler() const { return samplers_.front(); }
  [[nodiscard]] const SampleResults& results() const { return results_; }

  /// Runs samples first, first + 1, …, last - 1.
  /// @returns false, and adds none of them, if a stop was requested.
  [[nodiscard]] bool run(int first, int last) {
    std::vector<SampleResult> batch(static_cast<std::size_t>(last - first));
    samplers_.run(
        batch.size(), [&, asks_why = results_.asks_why()](GraspSampler& sampler, std::size_t k) {
          const int i = first + static_cast<int>(k);
          const sampling::RandomStream random = random_.fork(static_cast<std::uint64_t>(i));
          const Candidate* parent = improvable(i);
          batch[k] = parent ? sampler.neighbour(*parent, random) : sampler.sample(random, asks_why);
        });
    if (stop_.stop_requested()) {
      return false;
    }
    for (SampleResult& result : batch) {
      results_.add(std::move(result));
    }
    measure();
    best_ = results_.best();
    improvable_ = best_;
    std::erase_if(improvable_, [this](std::size_t i) {
      return results_.candidates()[i].grasp.quality.epsilon >= kFullEpsilon;
    });
    return true;
  }

  /// The grasps that differ, the best first; see SampleResults::best().
  [[nodiscard]] std::vector<Pregrasp> best() const { return grasps_of(best_); }
  [[nodiscard]] std::vector<Pregrasp> best_and_spares(int spares) const {
    return grasps_of(results_.best(spares));
  }

 private:
  [[nodiscard]] std::vector<Pregrasp> grasps_of(const CandidateIndices& indices) const {
    std::vector<Pregrasp> grasps;
    for (const std::size_t i : indices) {
      grasps.push_back(results_.candidates()[i].grasp);
    }
    return grasps;
  }

  /// The grasp that a sample is to be taken beside; null for one anywhere.
  [[nodiscard]] const Candidate* improvable(int sample) const {
    const int since = sample - kFirstNeighbour;
    if (improvable_.empty() || since < 0 || since % kNeighbourEach != 0 ||
        since / kNeighbourEach >= kNeighbours * wanted_) {
      return nullptr;
    }
    const auto turn = static_cast<std::size_t>(since / kNeighbourEach);
    return &results_.candidates()[improvable_[turn % improvable_.size()]];
  }

  /// Measures the most promising candidates, a few at a time.
  void measure() {
    CandidateIndices next = results_.to_be_measured();
    next.resize(std::min<std::size_t>({next.size(), kMeasuredEach, measurements_left_}));
    measurements_left_ -= next.size();
    samplers_.run(next.size(), [&](GraspSampler& sampler, std::size_t i) {
      sampler.measure(results_.candidate(next[i]));
    });
  }

  std::stop_token stop_;
  SampleResults results_;
  std::size_t measurements_left_;
  int wanted_;
  sampling::RandomStream random_;
  SamplerPool samplers_;
  CandidateIndices best_;        ///< Indices of candidates, …
  CandidateIndices improvable_;  ///< … and of those that more epsilon makes better.
};

}  // namespace

Pregrasps find_pregrasps(const PlanningProblem& problem, std::string_view object,
                         const PregraspOptions& options, const std::stop_token& stop,
                         const PregraspProgress& progress) {
  const geometric::SceneObject& needed = graspable_object(problem, object);
  const PlanningProblem of_hand = with_nearest_hand(problem, needed);
  SampleRunner runner(of_hand, needed, options, stop);
  if (std::string reason = runner.sampler().invalid_problem_reason(); !reason.empty()) {
    return {{}, std::move(reason), runner.sampler().palm()};
  }
  Pregrasps grasps;
  grasps.palm = runner.sampler().palm();
  Patience patience(options);
  for (int done = 0; done < options.samples && !stop.stop_requested() && !patience.ended();) {
    const int last = std::min(done + kBatch, options.samples);
    if (!runner.run(done, last)) {
      break;
    }
    done = last;
    grasps.found = runner.best();
    patience.note(grasps.found, done);
    if (progress) {
      progress(grasps.found, patience.ended() ? 1.0 : static_cast<double>(done) / options.samples);
    }
  }
  grasps.found = runner.best_and_spares(options.spares);
  if (grasps.found.empty() && !stop.stop_requested()) {
    grasps.why_none = runner.sampler().why_none(runner.results());
  }
  return grasps;
}

}  // namespace handway::planning
