#include "planners/portfolio.h"

#include "core/thread_pool.h"
#include "handway/planning/roadmap/roadmap_recorder.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stop_token>
#include <utility>

namespace handway::planning {
namespace {

constexpr std::uint64_t kFirstRound = 1000;  // configurations that a member checks in round 0
constexpr int kLeadRounds = 2;               // the first member goes first in these, then last
constexpr int kLongestRounds = 12;           // from this round on they grow no more

}  // namespace

/// A member and its results.
struct Portfolio::Run {
  /// Reports the new nodes and edges to `observer`. Node n gets the number `stride` * n + `index`,
  /// so that several searches' nodes differ.
  void publish(Observer& observer, int stride) {
    const RecordedRoadmap& all = found.roadmap();
    for (; nodes_published < std::ssize(all.nodes); ++nodes_published) {
      const auto& node = all.nodes[static_cast<std::size_t>(nodes_published)];
      observer.on_node(
          {stride * nodes_published + index, node.q, node.pmd_count, node.step, node.rho_a, index});
    }
    for (; edges_published < all.edges.size(); ++edges_published) {
      const auto& [from, to] = all.edges[edges_published];
      observer.on_edge(stride * from + index, stride * to + index);
    }
  }

  PortfolioMember member;
  int index = 0;
  RoadmapRecorder found{std::numeric_limits<std::size_t>::max()};
  int nodes_published = 0;
  std::size_t edges_published = 0;
  std::unique_ptr<PlanningContext> context;  ///< Null: it has not started.
  std::unique_ptr<Search> search;
  std::stop_source beaten;
  std::optional<PlanStatus> end;
  PlanStatistics counted;  ///< Up to the last round that counts.
};

Portfolio::Portfolio(PlanningContext& context, std::vector<PortfolioMember> members,
                     std::uint64_t samples)
    : context_(context), samples_(samples), before_(context.statistics()) {
  for (PortfolioMember& member : members) {
    auto run = std::make_unique<Run>();
    run->member = std::move(member);
    run->index = static_cast<int>(runs_.size());
    runs_.push_back(std::move(run));
  }
}

Portfolio::~Portfolio() = default;

const PortfolioMember& Portfolio::winner() const { return winner_->member; }

Path Portfolio::path() const { return winner_->search->path(); }

PlanStatus Portfolio::run() {
  for (int round = 0;; ++round) {
    if (const std::optional<PlanStatus> end = run_round(round)) {
      return *end;
    }
  }
}

std::optional<PlanStatus> Portfolio::run_round(int round) {
  std::vector<Run*> runs;
  for (const auto& run : runs_) {
    if (round >= run->member.first_round && !run->end) {
      runs.push_back(run.get());
    }
  }
  // A member that found nothing soon gives way to the others.
  if (round >= kLeadRounds && runs.size() > 1 && runs.front() == runs_.front().get()) {
    std::rotate(runs.begin(), runs.begin() + 1, runs.end());
  }
  const std::uint64_t drawn = context_.statistics().samples;
  if (runs.empty() || drawn >= samples_) {
    const bool more_to_come =
        std::ranges::any_of(runs_, [&](const auto& run) { return !run->end; });
    return drawn < samples_ && more_to_come ? std::nullopt
                                            : std::optional(PlanStatus::kSamplesSpent);
  }
  context_.observer().on_progress(static_cast<double>(drawn) / static_cast<double>(samples_),
                                  "searching");
  const std::uint64_t share = (samples_ - drawn + runs.size() - 1) / runs.size();
  advance(runs, {kFirstRound << std::min(round, kLongestRounds), share});
  const auto first =
      std::ranges::find_if(runs, [](const Run* run) { return run->end == PlanStatus::kSolved; });
  if (first != runs.end()) {
    winner_ = *first;
    runs.erase(first + 1, runs.end());
  }
  publish(runs);
  if (winner_) {
    context_.observer().on_winner(winner_->index);
  }
  return winner_ ? std::optional(PlanStatus::kSolved) : context_.interruption();
}

// Stops the members after the first that solves, and ignores their results.
void Portfolio::advance(const std::vector<Run*>& runs, const SearchBudget& budget) {
  for (Run* run : runs) {
    if (!run->context) {
      const PlanningProblem& problem =
          run->member.problem ? *run->member.problem : context_.problem();
      run->context = context_.make_child(problem, run->found, run->beaten.get_token());
    }
  }
  const int count = static_cast<int>(runs.size());
  LowestIndex first_solved(count);
  context_.run_on_threads(count, [&](int i) {
    Run& run = *runs[static_cast<std::size_t>(i)];
    if (i > first_solved.get()) {
      return;
    }
    if (!run.search) {
      run.search = run.member.make(*run.context);
    }
    run.end = run.search->advance(budget);
    if (run.end == PlanStatus::kSolved) {
      first_solved.offer(i);
      for (int other = i + 1; other < count; ++other) {
        runs[static_cast<std::size_t>(other)]->beaten.request_stop();
      }
    }
  });
}

void Portfolio::publish(const std::vector<Run*>& runs) {
  const int count = static_cast<int>(runs_.size());
  for (Run* run : runs) {
    run->counted = run->context->statistics();
    run->publish(context_.observer(), count);
  }
  PlanStatistics& sum = context_.statistics();
  sum = before_;
  for (const auto& run : runs_) {
    sum += run->counted;
  }
}

}  // namespace handway::planning
