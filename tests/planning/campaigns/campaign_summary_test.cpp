#include "handway/planning/campaigns/campaign_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace handway::planning {
namespace {

using testing::ElementsAre;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class CampaignSummary : public testing::Test {
 protected:
  CampaignSummary() {
    campaign_.problems = {{"p", ""}, {"q", ""}};
    campaign_.planners = {{"a", "pmd-prm", {}}, {"b", "auto", {}}, {"c", "pmd-lazy", {}}};
    campaign_.seeds = {1, 2, 3};
  }
  static RunRecord run(int problem, int planner, std::uint64_t seed, double time_s) {
    RunRecord record;
    record.spec = {problem, planner, seed};
    record.solved = time_s < 10.0;
    record.time_s = time_s;
    return record;
  }
  Campaign campaign_;
};

TEST_F(CampaignSummary, SortsRunsByProblemAndPlanner) {
  const std::vector<CampaignCell> cells = campaign_cells(
      campaign_, std::vector{run(1, 0, 1, 0.5), run(0, 1, 1, 0.1), run(1, 0, 2, 20.0)});
  ASSERT_EQ(cells.size(), 6U);
  EXPECT_TRUE(cells[0].runs.empty());
  EXPECT_EQ(cells[1].runs.size(), 1U);
  EXPECT_EQ(cells[3].runs.size(), 2U);
  EXPECT_EQ(cells[3].solved(), 1U);
  EXPECT_THAT(cells[3].times(), ElementsAre(0.5, kInfinity));
  EXPECT_THAT(cells[3].of_solved(run_measures().front()), ElementsAre(0.5));
}

TEST_F(CampaignSummary, ComparesPlannersOnEachProblemThatTheyRanOn) {
  std::vector<RunRecord> records;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto time = static_cast<double>(seed);
    records.push_back(run(0, 0, seed, time));
    records.push_back(run(0, 1, seed, time + 3.0));
    records.push_back(run(0, 2, seed, time + 20.0));
    records.push_back(run(1, 0, seed, time));
  }
  const auto comparisons = compare_planners(campaign_cells(campaign_, records));
  ASSERT_EQ(comparisons.size(), 3U);
  EXPECT_EQ(comparisons[0].first, 0);
  EXPECT_EQ(comparisons[0].second, 1);
  EXPECT_DOUBLE_EQ(comparisons[0].test.effect, 1.0);
  EXPECT_DOUBLE_EQ(comparisons[0].test.p, 0.1);  // 2 / C(6, 3)
  EXPECT_GT(comparisons[0].adjusted_p, comparisons[0].test.p);
}

}  // namespace
}  // namespace handway::planning
