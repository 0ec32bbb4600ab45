#include "planners/portfolio.h"

#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kPlenty = 1'000'000'000;  // samples

/// Draws a sample and counts ten checks a step, each a node that hangs on the one before; solves
/// once it counted `enough`.
class Counting final : public Search {
 public:
  Counting(PlanningContext& context, std::uint64_t enough) : Search(context), enough_(enough) {}
  [[nodiscard]] Path path() const override {
    return {{context().problem().start, context().problem().goal}};
  }

 protected:
  [[nodiscard]] std::optional<PlanStatus> step() override {
    const int node = static_cast<int>(statistics().samples++);
    context().observer().on_node({node, context().problem().start});
    if (node > 0) {
      context().observer().on_edge(node - 1, node);
    }
    statistics().node_checks += 10;
    return statistics().node_checks >= enough_ ? std::optional(PlanStatus::kSolved) : std::nullopt;
  }

 private:
  std::uint64_t enough_;
};

PortfolioMember member(std::string name, std::uint64_t enough, int first_round = 0) {
  return {std::move(name), first_round,
          [enough](PlanningContext& context) -> std::unique_ptr<Search> {
            return std::make_unique<Counting>(context, enough);
          }};
}

class ARace : public testing::TestWithParam<int> {
 protected:
  ARace() { request_.threads = GetParam(); }

  struct Outcome {
    PlanStatus status;
    std::string winner;
    PlanStatistics statistics;
  };
  Outcome run(std::vector<PortfolioMember> members, std::uint64_t samples = kPlenty) {
    PlanningContext context(problem_, request_, stop_.get_token(), observer_);
    Portfolio portfolio(context, std::move(members), samples);
    const PlanStatus status = portfolio.run();
    return {status, status == PlanStatus::kSolved ? portfolio.winner().name : "",
            context.statistics()};
  }

  PlanningProblem problem_ = test::open_problem();
  PlanRequest request_;
  std::stop_source stop_;
  Observer observer_;
};

TEST_P(ARace, IsWonByTheOnlyOneThatSolves) {
  const Outcome outcome = run({member("hare", kNever), member("tortoise", 200'000)});
  EXPECT_EQ(outcome.status, PlanStatus::kSolved);
  EXPECT_EQ(outcome.winner, "tortoise");
}

TEST_P(ARace, IsWonByTheFirstInOrderWhenBothSolveInTheSameRound) {
  EXPECT_EQ(run({member("first", 400), member("second", 20)}).winner, "first");
}

TEST_P(ARace, IsWonByTheOneThatNeedsFewerRounds) {
  EXPECT_EQ(run({member("slow", 100'000), member("quick", 20)}).winner, "quick");
}

TEST_P(ARace, LetsARacerStartLater) {
  EXPECT_EQ(run({member("slow", 200'000), member("late", 20, 3)}).winner, "late");
  EXPECT_EQ(run({member("prompt", 400), member("late", 20, 3)}).winner, "prompt");
}

TEST_P(ARace, CountsOnlyWhatTheWinnerHadToWaitFor) {
  const Outcome alone = run({member("first", 400)});
  const Outcome both = run({member("first", 400), member("second", 20)});
  EXPECT_EQ(both.statistics.node_checks, alone.statistics.node_checks);
  EXPECT_EQ(both.statistics.samples, 40U);
}

/// Records the nodes (search and number) and edges that a race reports.
struct Listener final : Observer {
  void on_node(const NodeEvent& node) override { nodes.emplace_back(node.search, node.id); }
  void on_edge(int from, int to) override { edges.emplace_back(from, to); }

  std::vector<std::pair<int, int>> nodes;
  std::vector<std::pair<int, int>> edges;
};

TEST_P(ARace, TellsEverythingOnceAndTheNodesOfItsMembersApart) {
  Listener listener;
  PlanningContext context(problem_, request_, stop_.get_token(), listener);
  Portfolio portfolio(context, {member("slow", kNever), member("late", 20, 1)}, kPlenty);
  ASSERT_EQ(portfolio.run(), PlanStatus::kSolved);
  EXPECT_EQ(listener.nodes.size(), context.statistics().samples);
  EXPECT_EQ(listener.edges.size(), listener.nodes.size() - 2);
  std::set<int> numbers;
  for (const auto& [search, number] : listener.nodes) {
    EXPECT_EQ(number % 2, search);
    EXPECT_TRUE(numbers.insert(number).second) << number;
  }
  for (const auto& [from, to] : listener.edges) {
    EXPECT_EQ(to - from, 2) << "of the same search";
    EXPECT_TRUE(numbers.contains(from) && numbers.contains(to));
  }
}

TEST_P(ARace, EndsWhenTheSamplesAreSpent) {
  const Outcome outcome = run({member("one", kNever), member("other", kNever, 1)}, 1000);
  EXPECT_EQ(outcome.status, PlanStatus::kSamplesSpent);
  EXPECT_GE(outcome.statistics.samples, 1000U);
  EXPECT_LE(outcome.statistics.samples, 1002U);
}

TEST_P(ARace, EndsWhenItIsCancelled) {
  stop_.request_stop();
  EXPECT_EQ(run({member("one", kNever), member("other", kNever)}).status, PlanStatus::kCancelled);
}

TEST_P(ARace, EndsWithTheTime) {
  request_.time_limit_s = 0.02;
  EXPECT_EQ(run({member("one", kNever), member("other", kNever)}).status, PlanStatus::kTimeLimit);
}

INSTANTIATE_TEST_SUITE_P(Threads, ARace, testing::Values(1, 2, 5));

}  // namespace
}  // namespace handway::planning
