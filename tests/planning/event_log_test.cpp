#include "planners/portfolio.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Writes down what it is told.
class Scribe final : public Observer {
 public:
  void on_node(const NodeEvent& node) override {
    lines_.push_back(fmt::format("node {} of search {} at {} with {} PMDs, step {}, rho {}",
                                 node.id, node.search, node.q[0], node.pmd_count, node.step,
                                 node.rho_a));
  }
  void on_edge(int from, int to) override {
    lines_.push_back(fmt::format("edge {} to {}", from, to));
  }
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

TEST(EventLog, TellsLaterInTheSameOrder) {
  EventLog log;
  log.on_node({0, Eigen::VectorXd::Constant(1, 0.25), 2, 0.5, 0.125});
  log.on_node({1, Eigen::VectorXd::Constant(1, 0.75), 3, 1, 0.25});
  log.on_edge(0, 1);
  Scribe scribe;
  log.replay(scribe, 0, 1);
  EXPECT_THAT(
      scribe.lines(),
      ElementsAre("node 0 of search 0 at 0.25 with 2 PMDs, step 0.5, rho 0.125",
                  "node 1 of search 0 at 0.75 with 3 PMDs, step 1, rho 0.25", "edge 0 to 1"));
}

TEST(EventLog, TellsEverythingOnce) {
  EventLog log;
  log.on_edge(0, 1);
  Scribe first;
  log.replay(first, 0, 1);
  log.on_edge(1, 2);
  Scribe second;
  log.replay(second, 0, 1);
  EXPECT_THAT(second.lines(), ElementsAre("edge 1 to 2"));
  Scribe third;
  log.replay(third, 0, 1);
  EXPECT_THAT(third.lines(), IsEmpty());
}

TEST(EventLog, KeepsTheNodesOfSeveralSearchesApart) {
  EventLog one;
  EventLog other;
  one.on_edge(0, 1);
  other.on_node({0, Eigen::VectorXd::Constant(1, 0.5)});
  other.on_edge(0, 1);
  Scribe scribe;
  one.replay(scribe, 0, 2);
  other.replay(scribe, 1, 2);
  EXPECT_THAT(scribe.lines(),
              ElementsAre("edge 0 to 2", "node 1 of search 1 at 0.5 with 0 PMDs, step 0, rho 0",
                          "edge 1 to 3"));
}

}  // namespace
}  // namespace handway::planning
