#include "handway/planning/campaigns/campaign_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class CampaignGroups : public testing::Test {
 protected:
  CampaignGroups() {
    campaign_.problems = {{"p", "", {}, {{"set", "shelf"}, {"robot", "arm"}}},
                          {"q", "", {}, {{"set", "box"}, {"robot", "arm"}}},
                          {"r", "", {}, {{"set", "shelf"}, {"robot", "crane"}}}};
    campaign_.planners = {{"a", "auto", {}}, {"b", "pmd-prm", {}}};
    campaign_.seeds = {1, 2};
  }
  static RunRecord run(int problem, int planner, std::uint64_t seed, double length) {
    RunRecord record;
    record.spec = {problem, planner, seed};
    record.solved = length > 0.0;
    record.l2_length = length;
    record.cpu_s = 0.5;
    record.resolution = record.solved ? 5e-5 : 0.0;
    return record;
  }
  [[nodiscard]] std::vector<CampaignGroup> groups() const {
    return campaign_groups(campaign_, campaign_cells(campaign_, records_));
  }

  Campaign campaign_;
  std::vector<RunRecord> records_;
};

TEST_F(CampaignGroups, HaveTheRunsOfProblemsWithTheSameTag) {
  records_ = {run(0, 0, 1, 2.0), run(0, 1, 1, 3.0), run(1, 0, 1, 4.0), run(2, 0, 1, 0.0)};
  const std::vector<CampaignGroup> all = groups();
  std::vector<std::string> names;
  for (const CampaignGroup& group : all) {
    names.push_back(group.key + " " + group.value + " " + std::to_string(group.cell.planner));
  }
  EXPECT_THAT(names, ElementsAre("set box 0", "set shelf 0", "set shelf 1", "robot arm 0",
                                 "robot arm 1", "robot crane 0", "  0", "  1"));
  EXPECT_EQ(all[1].problems, 2U);
  EXPECT_EQ(all[1].cell.solved(), 1U);
  EXPECT_EQ(all[1].certified(), 1U);
  EXPECT_THAT(all[1].processor_times(), ElementsAre(0.5, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(all[6].cell.runs.size(), 3U);
}

TEST_F(CampaignGroups, CompareLengthsOfTheSameProblemAndSeed) {
  records_ = {run(0, 0, 1, 2.0), run(0, 0, 2, 5.0), run(2, 0, 1, 0.0),
              run(0, 1, 1, 3.0), run(0, 1, 2, 0.0), run(2, 1, 1, 9.0)};
  const std::vector<CampaignGroup> all = groups();
  EXPECT_EQ(all[1].value + all[1].key, "shelfset");
  EXPECT_THAT(all[0].length_ratios, ElementsAre(1.0, 1.0));
  EXPECT_THAT(all[1].length_ratios, ElementsAre(1.5));
}

// A planner that can't plan a problem at all, as one with PMDs for an arm alone, has no run of it.
TEST_F(CampaignGroups, LeaveOutPlannersThatRefuseAProblem) {
  RunRecord refused = run(0, 1, 1, 0.0);
  refused.status = kRefused;
  records_ = {run(0, 0, 1, 2.0), refused, run(2, 1, 1, 3.0)};
  const std::vector<CampaignGroup> all = groups();
  EXPECT_EQ(all[1].problems, 1U);
  EXPECT_EQ(all[1].cell.runs.size(), 1U);
}

TEST_F(CampaignGroups, AreNoneWithoutTags) {
  campaign_.problems = {{"p", ""}};
  records_ = {run(0, 0, 1, 2.0)};
  EXPECT_THAT(groups(), IsEmpty());
}

TEST_F(CampaignGroups, CountPathsThatWereCheckedAgain) {
  RunRecord good = run(0, 0, 1, 2.0);
  good.is_checked = true;
  RunRecord bad = good;
  bad.spec.seed = 2;
  bad.fault = "post and arm collide";
  bad.cpu_s = std::numeric_limits<double>::quiet_NaN();
  records_ = {good, bad};
  const CampaignGroup group = groups().front();
  EXPECT_EQ(group.checked(), 2U);
  EXPECT_EQ(group.valid(), 1U);
  EXPECT_THAT(group.processor_times(), ElementsAre(0.5));
}

}  // namespace
}  // namespace handway::planning
