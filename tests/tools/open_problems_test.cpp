/// `handway problems`: the open benchmark for hands on arms.
#include "command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;

TEST(HandwayProblems, AreTheSameForASeedAndHaveFreeEnds) {
  const CommandLine line;
  const Outcome run = line.run("problems --out a --count 4 --seed 3");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("4 problems in a"));
  const std::string campaign = line.read("a/CAMPAIGN.yaml");
  EXPECT_THAT(campaign,
              AllOf(HasSubstr("seed 3"), HasSubstr("file: problem0004.yaml, tags: {task: ")));
  EXPECT_EQ(std::ranges::count(campaign, '{'), 8) << campaign;
  for (const char* model : {"tx90", "iiwa14_class", "panda_class", "ur5e_class", "sah_right",
                            "allegro_class_right", "leap_class_right", "shadow_class_right"}) {
    EXPECT_THAT(campaign, HasSubstr(model)) << "each arm and hand once";
  }

  // More problems of the seed begin with these; what is there is kept.
  ASSERT_EQ(line.run("problems --out b --count 2 --seed 3").exit_code, 0);
  line.write("b/problem0002.yaml", "name: another one\n");
  ASSERT_EQ(line.run("problems --out b --count 4 --seed 3 --resume").exit_code, 0);
  ASSERT_EQ(line.run("problems --out c --count 1 --seed 4").exit_code, 0);
  EXPECT_NE(line.read("c/problem0001.yaml"), line.read("a/problem0001.yaml"));
  for (const char* name : {"problem0001.yaml", "problem0002.yaml", "problem0003.yaml",
                           "problem0004.yaml", "CAMPAIGN.yaml"}) {
    EXPECT_EQ(line.read(std::string("a/") + name), line.read(std::string("b/") + name)) << name;
  }
  for (int number = 1; number <= 4; ++number) {
    const std::string problem = "a/problem000" + std::to_string(number) + ".yaml";
    const Outcome plan = line.run("plan " + problem + " --time-limit 2");
    EXPECT_THAT(plan.exit_code, AnyOf(Eq(0), Eq(1))) << problem << ": " << plan.err;
  }
}

TEST(HandwayProblems, HaveACampaignThatRunsThem) {
  const CommandLine line;
  ASSERT_EQ(line.run("problems --out a --count 1 --time-limit 2").exit_code, 0);
  const Outcome run = line.run("bench a/CAMPAIGN.yaml --out runs");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("5 of 5 runs done"));
  EXPECT_THAT(line.read("runs/report.md"), AllOf(HasSubstr("## By family"), HasSubstr("## By hand"),
                                                 HasSubstr("SPARC hand"), HasSubstr("to PMDs")));
}

TEST(HandwayProblems, RefuseAFolderThatCannotBeWritten) {
  const CommandLine line;
  line.write("file", "in the way");
  const Outcome run = line.run("problems --out file/a --count 1");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("file/a"));
  EXPECT_EQ(line.run("problems --count 1").exit_code, 2);
}

}  // namespace
}  // namespace handway::test
