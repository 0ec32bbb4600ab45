/// Campaign files: what they mean and how they are refused.
#include "handway/geometric/io/input_error.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class CampaignReader : public testing::Test {
 protected:
  fs::path write(const std::string& text) const {
    const fs::path file = folder_.path() / "study.yaml";
    std::ofstream(file) << text;
    return file;
  }
  Campaign read(const std::string& text) const { return read_campaign(write(text), registry_); }
  std::string refusal(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const geometric::InputError& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder folder_;
  PlannerRegistry registry_;
};

std::vector<std::string> labels(const Campaign& campaign) {
  std::vector<std::string> result;
  for (const CampaignPlanner& planner : campaign.planners) {
    result.push_back(planner.label);
  }
  return result;
}

TEST_F(CampaignReader, TakesPlainLists) {
  const Campaign campaign =
      read("campaign: 1\nproblems: [can_on_table, t_shape]\nplanners: [pmd-prm, auto]\nseeds: 3\n");
  EXPECT_EQ(campaign.name, "study");
  ASSERT_EQ(campaign.problems.size(), 2U);
  EXPECT_EQ(campaign.problems[1].name, "t_shape");
  EXPECT_TRUE(fs::is_regular_file(campaign.problems[1].file));
  EXPECT_THAT(labels(campaign), ElementsAre("pmd-prm", "auto"));
  EXPECT_THAT(campaign.seeds, ElementsAre(1U, 2U, 3U));
  EXPECT_EQ(campaign.threads, 1);
  const std::vector<RunSpec> runs = campaign.runs();
  ASSERT_EQ(runs.size(), 12U);
  EXPECT_EQ(runs[5], (RunSpec{0, 1, 2}));
}

TEST_F(CampaignReader, TakesTagsAndWhatToMeasure) {
  const Campaign campaign = read(
      "campaign: 1\nplanners: [auto]\nseeds: 1\ncheck_paths: true\nmeasure_motions: true\n"
      "problems:\n  - {name: p, file: can_on_table, tags: {set: shelf, level: 2}}\n  - t_shape\n");
  EXPECT_EQ(campaign.problems[0].tags, (ProblemTags{{"set", "shelf"}, {"level", "2"}}));
  EXPECT_EQ(campaign.problems[0].tag("level"), "2");
  EXPECT_EQ(campaign.problems[1].tag("level"), "");
  EXPECT_TRUE(campaign.check_paths);
  EXPECT_TRUE(campaign.measure_motions);
  EXPECT_FALSE(campaign.skip_unreadable);
}

TEST_F(CampaignReader, MakesAGridOfListsAndRanges) {
  const Campaign campaign = read(R"(
campaign: 1
problems: [can_on_table]
planners:
  - planner: pmd-prm
    label: prm
    parameters:
      n_a: [5, 10]
      rho_a: {from: 0.001, to: 0.1, steps: 3, scale: log}
      k: 7
seeds: {first: 10, count: 2}
)");
  EXPECT_THAT(labels(campaign), ElementsAre("prm n_a=5 rho_a=0.001", "prm n_a=5 rho_a=0.01",
                                            "prm n_a=5 rho_a=0.1", "prm n_a=10 rho_a=0.001",
                                            "prm n_a=10 rho_a=0.01", "prm n_a=10 rho_a=0.1"));
  EXPECT_THAT(campaign.planners[4].parameters,
              testing::IsSupersetOf(ParameterTexts{{"n_a", "10"}, {"rho_a", "0.01"}, {"k", "7"}}));
  EXPECT_THAT(campaign.seeds, ElementsAre(10U, 11U));
}

TEST_F(CampaignReader, VariesOneParameterAfterTheOther) {
  const Campaign campaign = read(
      "campaign: 1\nproblems: [can_on_table]\nseeds: [4, 2]\n"
      "planners:\n  - {planner: pmd-prm, vary: {n_a: [5, 10], max_pmds: {from: 1, to: 4, steps: "
      "4}}}\n");
  EXPECT_THAT(labels(campaign), ElementsAre("pmd-prm", "pmd-prm n_a=5", "pmd-prm max_pmds=1",
                                            "pmd-prm max_pmds=2", "pmd-prm max_pmds=3"))
      << "the defaults once";
}

TEST_F(CampaignReader, LeavesOutOptionalProblemsThatAreNotThere) {
  const Campaign campaign = read(R"(
campaign: 1
problems:
  - can_on_table
  - {file: "${HANDWAY_NO_SUCH_VARIABLE}/x.xml", optional: true}
  - {file: nowhere.yaml, optional: true}
planners: [pmd-prm]
seeds: 1
)");
  EXPECT_EQ(campaign.problems.size(), 1U);
}

TEST_F(CampaignReader, TakesVariablesInNames) {
  std::ofstream(folder_.path() / "mine.yaml") << "x";
  setenv("HANDWAY_TEST_FOLDER", folder_.path().c_str(), 1);
  const Campaign campaign = read(
      "campaign: 1\nproblems: [{name: own, file: \"${HANDWAY_TEST_FOLDER}/mine.yaml\"}]\n"
      "planners: [pmd-prm]\nseeds: 1\n");
  EXPECT_EQ(campaign.problems.front().name, "own");
  EXPECT_EQ(campaign.problems.front().file, folder_.path() / "mine.yaml");
}

TEST_F(CampaignReader, NamesWhatIsWrongAndWhere) {
  struct Case {
    std::string text;
    std::vector<std::string> said;
  };
  const std::string head = "campaign: 1\nproblems: [can_on_table]\n";
  for (const Case& bad : std::vector<Case>{
           {"campaign: 2\nproblems: [can_on_table]\nplanners: [pmd-prm]\nseeds: 1\n",
            {"study.yaml:1", "campaign", "version"}},
           {head + "planers: [pmd-prm]\nseeds: 1\n", {":3", "planers", "planners"}},
           {head + "seeds: 1\n", {"no \"planners\""}},
           {head + "planners: [pmd-prn]\nseeds: 1\n", {":3", "planners[0]", "pmd-prm"}},
           {head + "planners: [{planner: pmd-prm, parameters: {n_b: 3}}]\nseeds: 1\n",
            {":3", "parameters.n_b", "no parameter of pmd-prm"}},
           {head + "planners: [{planner: pmd-prm, parameters: {n_a: [3, 0]}}]\nseeds: 1\n",
            {"n_a[1]", "\"0\"", "1 to 1000"}},
           {head + "planners: [{planner: pmd-prm, parameters: {rho_a: {from: 0, to: 1, steps: 3, "
                   "scale: log}}}]\nseeds: 1\n",
            {"rho_a", "above 0"}},
           {head + "planners: [{planner: pmd-prm, parameters: {rho_a: {from: 0.1, to: 9, steps: "
                   "3}}}]\nseeds: 1\n",
            {"rho_a", "0.5"}},
           {head + "planners: [pmd-prm]\nseeds: many\n", {":4", "seeds", "\"many\""}},
           {head + "planners: [pmd-prm]\nseeds: [1, 2, 1]\n", {"seeds[2]", "second time"}},
           {head + "planners: [pmd-prm]\nseeds: 0\n", {"seeds", "from 1"}},
           {head + "planners: [pmd-prm]\nseeds: 1\ntime_limit_s: -3\n", {"time_limit_s"}},
           {head + "planners: []\nseeds: 1\n", {"planners", "at least one"}},
           {head + "planners: [{planner: pmd-prm, label: a}, {planner: auto, label: "
                   "a}]\nseeds: 1\n",
            {"second planner called \"a\""}},
           {"campaign: 1\nproblems: [no_such]\nplanners: [pmd-prm]\nseeds: 1\n",
            {":2", "problems[0]", "no_such", "Looked in"}},
           {"campaign: 1\nproblems: [\"${HANDWAY_NO_SUCH_VARIABLE}/a\"]\nplanners: "
            "[pmd-prm]\nseeds: 1\n",
            {"HANDWAY_NO_SUCH_VARIABLE", "not set"}},
           {"campaign: 1\nproblems: [t_shape, t_shape]\nplanners: [pmd-prm]\nseeds: 1\n",
            {"second problem called \"t_shape\""}},
           {"campaign: [\n", {"study.yaml"}},
       }) {
    const std::string message = refusal(bad.text);
    for (const std::string& said : bad.said) {
      EXPECT_THAT(message, HasSubstr(said)) << bad.text;
    }
  }
}

TEST_F(CampaignReader, TellsACampaignFromAScene) {
  EXPECT_TRUE(is_campaign(write("# study\ncampaign : 1\n")));
  EXPECT_FALSE(is_campaign(write("handway: 1\ndescription: >\n  campaign: no\n")));
  EXPECT_FALSE(is_campaign(folder_.path() / "none.yaml"));
  EXPECT_FALSE(is_campaign(folder_.path()));
}

TEST_F(CampaignReader, ReadsThoseThatShip) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(test::source_dir() / "resources/campaigns")) {
    EXPECT_TRUE(is_campaign(entry.path())) << entry.path();
    const auto read = [&] { return read_campaign(entry.path(), registry_); };
    const bool published = entry.path().stem().string().starts_with("file_");
    if (published && std::getenv("HANDWAY_REFERENCE_DIR") == nullptr) {
      EXPECT_THAT(test::refusal_of(read), HasSubstr("Set the variable HANDWAY_REFERENCE_DIR"));
    } else {
      EXPECT_NO_THROW(static_cast<void>(read())) << entry.path();
    }
    ++count;
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace handway::planning
