#include "planners/race.h"

#include "core/thread_pool.h"

#include <algorithm>
#include <stop_token>
#include <utility>

namespace handway::planning {
namespace {

constexpr std::uint64_t kFirstRound = 1000;  // configurations that a racer checks in round 0
constexpr int kLeadRounds = 2;               // the first racer goes first in these, then last
constexpr int kLongestRounds = 12;           // from this round on they grow no more

}  // namespace

void EventLog::on_node(const NodeEvent& node) {
  events_.emplace_back(Node{node.id, node.q, node.pmd_count, node.step, node.rho_a});
}

void EventLog::on_edge(int from, int to) { events_.emplace_back(Edge{from, to}); }

void EventLog::replay(Observer& observer, int offset, int stride) {
  for (const auto& event : events_) {
    if (const auto* node = std::get_if<Node>(&event)) {
      observer.on_node(
          {stride * node->id + offset, node->q, node->pmd_count, node->step, node->rho_a, offset});
    } else {
      const auto& [from, to] = std::get<Edge>(event);
      observer.on_edge(stride * from + offset, stride * to + offset);
    }
  }
  events_.clear();
}

/// A racer on its way.
struct Race::Lane {
  Racer racer;
  int index = 0;
  EventLog events;
  std::unique_ptr<PlanningContext> context;  ///< Null: it has not started.
  std::unique_ptr<Search> search;
  std::stop_source beaten;
  std::optional<PlanStatus> end;
  PlanStatistics counted;  ///< Up to the last round that counts.
};

Race::Race(PlanningContext& context, std::vector<Racer> racers, std::uint64_t samples)
    : context_(context), samples_(samples), before_(context.statistics()) {
  for (Racer& racer : racers) {
    auto lane = std::make_unique<Lane>();
    lane->racer = std::move(racer);
    lane->index = static_cast<int>(lanes_.size());
    lanes_.push_back(std::move(lane));
  }
}

Race::~Race() = default;

const std::string& Race::winner() const { return winner_->racer.name; }

const PlanningProblem* Race::winner_problem() const { return winner_->racer.problem; }

Path Race::path() const { return winner_->search->path(); }

PlanStatus Race::run() {
  for (int round = 0;; ++round) {
    if (const std::optional<PlanStatus> end = run_round(round)) {
      return *end;
    }
  }
}

std::optional<PlanStatus> Race::run_round(int round) {
  std::vector<Lane*> lanes;
  for (const auto& lane : lanes_) {
    if (round >= lane->racer.first_round && !lane->end) {
      lanes.push_back(lane.get());
    }
  }
  // What did not do soon is better not waited for.
  if (round >= kLeadRounds && lanes.size() > 1 && lanes.front() == lanes_.front().get()) {
    std::rotate(lanes.begin(), lanes.begin() + 1, lanes.end());
  }
  const std::uint64_t drawn = context_.statistics().samples;
  if (lanes.empty() || drawn >= samples_) {
    const bool more_to_come =
        std::ranges::any_of(lanes_, [&](const auto& lane) { return !lane->end; });
    return drawn < samples_ && more_to_come ? std::nullopt
                                            : std::optional(PlanStatus::kSamplesSpent);
  }
  context_.observer().on_progress(static_cast<double>(drawn) / static_cast<double>(samples_),
                                  "racing");
  const std::uint64_t share = (samples_ - drawn + lanes.size() - 1) / lanes.size();
  run_lanes(lanes, {kFirstRound << std::min(round, kLongestRounds), share});
  const auto first = std::ranges::find_if(
      lanes, [](const Lane* lane) { return lane->end == PlanStatus::kSolved; });
  if (first != lanes.end()) {
    winner_ = *first;
    lanes.erase(first + 1, lanes.end());
  }
  publish(lanes);
  if (winner_) {
    context_.observer().on_winner(winner_->index);
  }
  return winner_ ? std::optional(PlanStatus::kSolved) : context_.interruption();
}

// Those after the first that solves are stopped, and what they did does not count.
void Race::run_lanes(const std::vector<Lane*>& lanes, const SearchBudget& budget) {
  for (Lane* lane : lanes) {
    if (!lane->context) {
      const PlanningProblem& problem =
          lane->racer.problem ? *lane->racer.problem : context_.problem();
      lane->context = context_.make_child(problem, lane->events, lane->beaten.get_token());
    }
  }
  const int count = static_cast<int>(lanes.size());
  LowestIndex first_solved(count);
  context_.run_on_threads(count, [&](int i) {
    Lane& lane = *lanes[static_cast<std::size_t>(i)];
    if (i > first_solved.get()) {
      return;
    }
    if (!lane.search) {
      lane.search = lane.racer.make(*lane.context);
    }
    lane.end = lane.search->advance(budget);
    if (lane.end == PlanStatus::kSolved) {
      first_solved.offer(i);
      for (int other = i + 1; other < count; ++other) {
        lanes[static_cast<std::size_t>(other)]->beaten.request_stop();
      }
    }
  });
}

void Race::publish(const std::vector<Lane*>& lanes) {
  const int count = static_cast<int>(lanes_.size());
  for (Lane* lane : lanes) {
    lane->counted = lane->context->statistics();
    lane->events.replay(context_.observer(), lane->index, count);
  }
  PlanStatistics& sum = context_.statistics();
  sum = before_;
  for (const auto& lane : lanes_) {
    sum += lane->counted;
  }
}

}  // namespace handway::planning
