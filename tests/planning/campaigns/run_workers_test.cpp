/// Carrying out runs on threads.
#include "handway/planning/campaigns/run_workers.h"

#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway_test/paths.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace handway::planning {
namespace {

class ThreadWorkersTest : public testing::Test {
 protected:
  ThreadWorkersTest() {
    sampling::write_pmd_basis(test::planar_hand_basis(), folder_.path() / "basis.yaml");
    add_problem("post", test::post_problem(), "basis.yaml");
    add_problem("bare", test::post_problem(), "");
    campaign_.planners = {{"prm", "pmd-prm", {}}, {"rrt", "rrt-connect", {}}};
    campaign_.seeds = {1, 2, 3};
  }
  void add_problem(const std::string& name, const PlanningProblem& problem,
                   const std::string& basis) {
    geometric::Scene scene = *problem.scene;
    scene.hand_basis = basis;
    campaign_.problems.push_back({name, folder_.path() / (name + ".yaml")});
    geometric::write_scene(scene, campaign_.problems.back().file);
  }
  std::vector<RunRecord> run(int threads) const {
    const RunExecutor executor(campaign_, plugins_);
    std::vector<RunRecord> all;
    ThreadWorkers(threads).carry_out(executor, campaign_.runs(),
                                     [&](std::span<const RunRecord> records) {
                                       all.insert(all.end(), records.begin(), records.end());
                                     },
                                     {});
    std::ranges::sort(all, {}, &RunRecord::spec);
    return all;
  }

  test::ScratchFolder folder_;
  PluginManager plugins_;
  Campaign campaign_;
};

TEST_F(ThreadWorkersTest, GiveTheSameRunsOnAnyNumberOfThreads) {
  const std::vector<RunRecord> one = run(1);
  const std::vector<RunRecord> three = run(3);
  ASSERT_EQ(one.size(), campaign_.run_count());
  ASSERT_EQ(three.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].spec, three[i].spec);
    EXPECT_EQ(one[i].status, three[i].status);
    EXPECT_EQ(one[i].samples, three[i].samples);
    EXPECT_EQ(one[i].edge_checks, three[i].edge_checks);
    EXPECT_EQ(one[i].path, three[i].path);
  }
}

TEST_F(ThreadWorkersTest, NotePlannersThatNeedWhatAProblemHasNot) {
  const std::vector<RunRecord> records = run(2);
  for (const RunRecord& record : records) {
    const bool refused = record.spec.problem == 1 && record.spec.planner == 0;
    EXPECT_EQ(record.status, refused ? "refused" : "solved") << record.reason;
    EXPECT_EQ(record.path.empty(), refused);
  }
}

TEST_F(ThreadWorkersTest, EndWhenRecordsCannotBeKept) {
  const RunExecutor executor(campaign_, plugins_);
  EXPECT_THROW(ThreadWorkers(2).carry_out(
                   executor, campaign_.runs(),
                   [](std::span<const RunRecord>) { throw std::runtime_error("no room"); }, {}),
               std::runtime_error);
}

TEST_F(ThreadWorkersTest, EndWhenTheyAreStopped) {
  const RunExecutor executor(campaign_, plugins_);
  std::stop_source stop;
  std::size_t taken = 0;
  stop.request_stop();
  ThreadWorkers(2).carry_out(
      executor, campaign_.runs(),
      [&](std::span<const RunRecord> records) { taken += records.size(); }, stop.get_token());
  EXPECT_EQ(taken, 0U);
}

TEST_F(ThreadWorkersTest, RefuseProblemsThatCannotBeRead) {
  campaign_.problems.push_back({"gone", folder_.path() / "gone.yaml"});
  EXPECT_THROW(RunExecutor(campaign_, plugins_), geometric::InputError);
}

TEST_F(ThreadWorkersTest, LeaveOutProblemsThatCannotBeReadIfTheCampaignSaysSo) {
  campaign_.problems.insert(campaign_.problems.begin(), {"gone", folder_.path() / "gone.yaml"});
  campaign_.skip_unreadable = true;
  const RunExecutor executor(campaign_, plugins_);
  ASSERT_EQ(executor.left_out().size(), 1U);
  EXPECT_EQ(executor.left_out().front().problem.name, "gone");
  EXPECT_THAT(executor.left_out().front().reason, testing::HasSubstr("gone.yaml"));
  ASSERT_EQ(executor.campaign().problems.size(), 2U);
  EXPECT_EQ(executor.campaign().problems.front().name, "post");
  const auto record = executor.run({0, 1, 1});
  ASSERT_TRUE(record);
  EXPECT_TRUE(record->solved) << record->reason;
  campaign_.problems = {campaign_.problems.front()};
  EXPECT_THROW(RunExecutor(campaign_, plugins_), geometric::InputError);
}

TEST_F(ThreadWorkersTest, OpenProblemsAgainThatAreNotInMemoryAnyMore) {
  const CampaignProblem post = campaign_.problems.front();
  for (int i = 0; i < 100; ++i) {
    campaign_.problems.push_back({"copy " + std::to_string(i), post.file});
  }
  const RunExecutor executor(campaign_, plugins_);
  const auto first = executor.run({0, 1, 1});
  const auto last = executor.run({101, 1, 1});
  ASSERT_TRUE(first && last);
  EXPECT_EQ(first->path, last->path);
}

TEST_F(ThreadWorkersTest, MeasureTimeLengthAndMotion) {
  campaign_.check_paths = true;
  campaign_.measure_motions = true;
  const RunExecutor executor(campaign_, plugins_);
  const auto record = executor.run({0, 0, 1});
  ASSERT_TRUE(record && record->solved);
  EXPECT_GT(record->cpu_s, 0.0);
  EXPECT_GE(record->l2_length, 0.8) << "the shoulder alone moves by 0.8 rad";
  EXPECT_TRUE(record->is_checked);
  EXPECT_EQ(record->fault, "");
  EXPECT_GE(record->measures.to_subspace, 0.0);
  EXPECT_GE(record->measures.arm_deviation, 0.0);
  EXPECT_LT(record->measures.palm_sparc, 0.0);
}

}  // namespace
}  // namespace handway::planning
