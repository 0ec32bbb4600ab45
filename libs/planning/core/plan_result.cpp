#include "handway/planning/core/plan_result.h"

#include "handway/geometric/io/plural.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace handway::planning {
namespace {

void add(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& other) {
  sum.resize(std::max(sum.size(), other.size()));
  for (std::size_t i = 0; i < other.size(); ++i) {
    sum[i] += other[i];
  }
}

constexpr double kMost = 0.6;  // share of the rejections that a stretch has to hold
constexpr int kNearEnd = 3;    // tenths of the motion
constexpr std::size_t kMostPairs = 3;
constexpr double kLeastShare = 0.1;  // share of the rejections, for a pair to be named
constexpr double kBoxedIn = 0.02;    // share of all nodes that connect to an end
constexpr std::uint64_t kManyNodes = 200;

int percent(double share) { return static_cast<int>(std::lround(100.0 * share)); }

struct Stretch {
  int from = 0;  ///< In tenths of the motion.
  int to = 10;

  [[nodiscard]] bool says_something() const { return to - from <= 5; }
};

// The shortest stretch of the motion with most of the rejections.
Stretch narrowest(const std::vector<std::uint64_t>& tenths, std::uint64_t all) {
  Stretch best{0, static_cast<int>(tenths.size())};
  for (int from = 0; from < static_cast<int>(tenths.size()); ++from) {
    std::uint64_t inside = 0;
    for (int to = from + 1; to <= static_cast<int>(tenths.size()); ++to) {
      inside += tenths[static_cast<std::size_t>(to - 1)];
      if (static_cast<double>(inside) >= kMost * static_cast<double>(all)) {
        if (to - from < best.to - best.from) {
          best = {from, to};
        }
        break;
      }
    }
  }
  return best;
}

struct Rejected {
  std::string a;
  std::string b;
  double share;
};

std::vector<Rejected> most_rejected(const PlanStatistics& statistics) {
  double all = 0.0;
  for (const auto& [pair, count] : statistics.rejections) {
    all += static_cast<double>(count);
  }
  std::vector<Rejected> pairs;
  for (const auto& [pair, count] : statistics.rejections) {
    pairs.push_back({pair.first, pair.second, static_cast<double>(count) / all});
  }
  std::ranges::stable_sort(pairs, std::ranges::greater{}, &Rejected::share);
  while (pairs.size() > kMostPairs || (pairs.size() > 1 && pairs.back().share < kLeastShare)) {
    pairs.pop_back();
  }
  return pairs;
}

std::string reach_sentence(const SearchReach& reach) {
  return fmt::format(
      "The search came {} % of the straight motion from the start ({} configurations) and {} % "
      "from the goal ({}).",
      percent(reach.from_start), reach.start_nodes, percent(1.0 - reach.from_goal),
      reach.goal_nodes);
}

bool boxed_in(std::uint64_t connected, const SearchReach& reach) {
  return reach.nodes >= kManyNodes &&
         static_cast<double>(connected) < kBoxedIn * static_cast<double>(reach.nodes);
}

std::string rejection_sentence(const std::vector<Rejected>& pairs, const Stretch& stretch) {
  std::string text = "Of the samples that were rejected";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    text += fmt::format("{} in {} % {}", i == 0 ? "," : " and", percent(pairs[i].share),
                        pairs[i].b.empty() ? "constraint " + pairs[i].a + " was violated"
                                           : pairs[i].a + " collided with " + pairs[i].b);
  }
  if (stretch.says_something()) {
    text += fmt::format("; most of them between {} and {} % of the motion", 10 * stretch.from,
                        10 * stretch.to);
  }
  return text + ".";
}

}  // namespace

std::string PlanStatistics::samples_text() const { return geometric::plural(samples, "sample"); }

PlanStatistics& PlanStatistics::operator+=(const PlanStatistics& other) {
  samples += other.samples;
  nodes += other.nodes;
  edges += other.edges;
  passes += other.passes;
  max_trials = std::max(max_trials, other.max_trials);
  final_rho_a = std::max(final_rho_a, other.final_rho_a);
  add(nodes_per_pmds, other.nodes_per_pmds);
  node_checks += other.node_checks;
  edge_checks += other.edge_checks;
  edges_tested += other.edges_tested;
  sampling_s += other.sampling_s;
  connection_s += other.connection_s;
  add(rejections_per_pair, other.rejections_per_pair);
  for (const auto& [pair, count] : other.rejections) {
    rejections[pair] += count;
  }
  add(rejections_per_tenth, other.rejections_per_tenth);
  return *this;
}

const char* to_string(PlanStatus status) {
  static constexpr std::array<const char*, 8> kWords = {
      "solved",     "start invalid", "goal invalid", "samples spent",
      "time limit", "cancelled",     "stalled",      "infeasible"};
  return kWords[static_cast<std::size_t>(status)];
}

std::vector<std::string> explain_failure(const PlanResult& result) {
  std::vector<std::string> sentences;
  if (result.solved() || result.status == PlanStatus::kStartInvalid ||
      result.status == PlanStatus::kGoalInvalid) {
    return sentences;
  }
  if (result.status == PlanStatus::kInfeasible) {
    return {"Move an end to the same side of the surface, or make an opening in it."};
  }
  const SearchReach reach = result.reach.value_or(SearchReach());
  const bool start_boxed_in = boxed_in(reach.start_nodes, reach);
  const bool goal_boxed_in = boxed_in(reach.goal_nodes, reach);
  if (result.reach) {
    sentences.push_back(reach_sentence(reach));
  }
  for (const auto& [is_boxed_in, end, nodes] :
       {std::tuple(start_boxed_in, "start", reach.start_nodes),
        std::tuple(goal_boxed_in, "goal", reach.goal_nodes)}) {
    if (is_boxed_in) {
      sentences.push_back(fmt::format(
          "The {} is enclosed by obstacles: {} of {} free configurations connect to it.", end,
          nodes, reach.nodes));
    }
  }
  const std::vector<Rejected> pairs = most_rejected(result.statistics);
  const auto& tenths = result.statistics.rejections_per_tenth;
  const std::uint64_t placed = std::accumulate(tenths.begin(), tenths.end(), std::uint64_t{0});
  const Stretch stretch = placed > 0 && tenths.size() == 10 ? narrowest(tenths, placed) : Stretch();
  if (!pairs.empty()) {
    sentences.push_back(rejection_sentence(pairs, stretch));
  }
  const std::string room = pairs.empty() ? ""
                           : pairs.front().b.empty()
                               ? " in constraint " + pairs.front().a
                               : " between " + pairs.front().a + " and " + pairs.front().b;
  if (start_boxed_in || stretch.to <= kNearEnd) {
    sentences.push_back(fmt::format("Try a start with more clearance{}.", room));
  } else if (goal_boxed_in || stretch.from >= 10 - kNearEnd) {
    sentences.push_back(fmt::format("Try a goal with more clearance{}.", room));
  } else {
    sentences.push_back(fmt::format(
        "Try more time, another seed or planner{}.",
        room.empty() ? "" : fmt::format(", or more clearance{} along the motion", room)));
  }
  return sentences;
}

}  // namespace handway::planning
