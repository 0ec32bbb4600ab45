#include "handway/planning/core/plan_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::test {
namespace {

using planning::explain_failure;
using planning::PlanResult;
using planning::PlanStatus;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

PlanResult failed() {
  PlanResult result;
  result.status = PlanStatus::kTimeLimit;
  result.statistics.rejections[{"thumb", "can"}] = 78;
  result.statistics.rejections[{"palm", "table"}] = 22;
  return result;
}

TEST(FailureExplanation, SaysHowFarTheSearchCameFromBothEnds) {
  PlanResult result = failed();
  result.reach = {
      .from_start = 0.4, .from_goal = 0.9, .start_nodes = 30, .goal_nodes = 12, .nodes = 42};
  EXPECT_EQ(explain_failure(result).front(),
            "The search came 40 % of the straight motion from the start (30 configurations) and "
            "10 % from the goal (12).");
}

TEST(FailureExplanation, NamesThePairsAndTheStretchOfTheMotion) {
  PlanResult result = failed();
  result.statistics.rejections_per_tenth = {1, 1, 2, 2, 2, 2, 70, 10, 5, 5};
  EXPECT_THAT(explain_failure(result),
              testing::ElementsAre(
                  "Of the samples that were rejected, in 78 % thumb collided with can and in 22 % "
                  "palm collided with table; most of them between 60 and 70 % of the motion.",
                  "Try more time, another seed or planner, or more clearance between thumb and can "
                  "along the motion."));
}

TEST(FailureExplanation, LeavesOutAStretchThatIsMostOfTheMotion) {
  PlanResult result = failed();
  result.statistics.rejections_per_tenth.assign(10, 10);
  EXPECT_THAT(explain_failure(result), Not(Contains(HasSubstr("most of them"))));
}

TEST(FailureExplanation, AdvisesTheEndThatIsTooTight) {
  PlanResult result = failed();
  result.statistics.rejections_per_tenth = {0, 0, 0, 0, 0, 0, 0, 10, 40, 50};
  EXPECT_EQ(explain_failure(result).back(),
            "Try a goal with more clearance between thumb and can.");
  result.statistics.rejections_per_tenth = {50, 40, 10, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(explain_failure(result).back(),
            "Try a start with more clearance between thumb and can.");
}

TEST(FailureExplanation, RecognisesAnEndThatIsBoxedIn) {
  PlanResult result = failed();
  result.reach = {
      .from_start = 0.9, .from_goal = 1.0, .start_nodes = 995, .goal_nodes = 5, .nodes = 1000};
  EXPECT_THAT(
      explain_failure(result),
      Contains("The goal is enclosed by obstacles: 5 of 1000 free configurations connect to it."));
  EXPECT_EQ(explain_failure(result).back(),
            "Try a goal with more clearance between thumb and can.");
}

TEST(FailureExplanation, HasSomethingToTryWithoutRejections) {
  PlanResult result;
  result.status = PlanStatus::kSamplesSpent;
  EXPECT_THAT(explain_failure(result),
              testing::ElementsAre("Try more time, another seed or planner."));
}

TEST(FailureExplanation, IsEmptyForAPathAndForAnInvalidEnd) {
  PlanResult result = failed();
  result.status = PlanStatus::kSolved;
  EXPECT_THAT(explain_failure(result), IsEmpty());
  result.status = PlanStatus::kGoalInvalid;
  EXPECT_THAT(explain_failure(result), IsEmpty());
}

}  // namespace
}  // namespace handway::test
