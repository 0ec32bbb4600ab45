#include "widgets/panels/result_text.h"

#include "model/planning/path_history.h"

#include <gmock/gmock.h>

namespace handway::gui {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ResultText, TellsAPathWithItsFigures) {
  planning::PlanResult result;
  result.status = planning::PlanStatus::kSolved;
  result.time_s = 0.25;
  result.statistics.samples = 1234567;
  result.certificate.min_clearance = 0.0025;
  result.path.waypoints.resize(4);
  const std::string text = result_text(result).toStdString();
  EXPECT_THAT(text, HasSubstr("Path found"));
  EXPECT_THAT(text, HasSubstr("250 ms"));
  EXPECT_THAT(text, HasSubstr("1,234,567"));
  EXPECT_THAT(text, HasSubstr("2.50 mm"));
  EXPECT_EQ(result_line(result), "Path found in 250 ms, 4 waypoints");
  EXPECT_THAT(
      result_tip(result).toStdString(),
      AllOf(StartsWith("Path found\nClearance: ≥ 2.50 mm\n"), HasSubstr("Planning: 250 ms")));
}

TEST(ResultText, BeginsWithTheFiguresOfTheMotionOnceTheyAreKnown) {
  planning::PlanResult result;
  result.status = planning::PlanStatus::kSolved;
  PathFigures figures;
  figures.duration = 1.24;
  figures.to_subspace = planning::DistanceAlong{0.0312, 0.05};
  const QString text = result_text(result, {}, figures);
  EXPECT_LT(text.indexOf("1.24 s"), text.indexOf("Clearance"));
  EXPECT_LT(text.indexOf("0.031"), text.indexOf("Clearance"));
}

TEST(ResultText, NamesWhatDoesNotKeepTheMargin) {
  planning::PlanResult result;
  result.status = planning::PlanStatus::kSolved;
  result.out_of_margin.push_back({true, {"thumb", "can", 0.0035}});
  EXPECT_THAT(result_text(result).toStdString(),
              HasSubstr("thumb and can are 3.50 mm apart at the goal"));
}

TEST(ResultText, GivesTheReasonWhyThereIsNone) {
  planning::PlanResult result;
  result.status = planning::PlanStatus::kStartInvalid;
  result.reason = "The start is in collision: palm <and> wall.";
  EXPECT_THAT(result_text(result).toStdString(), HasSubstr("palm &lt;and&gt; wall"));
  EXPECT_EQ(result_line(result).toStdString(), result.reason);
  EXPECT_THAT(result_tip(result).toStdString(), HasSubstr("palm <and> wall"));
}

TEST(ResultText, SaysOnceThatNoPathWasFound) {
  planning::PlanResult result;
  result.status = planning::PlanStatus::kSamplesSpent;
  result.reason = "No path found: all 500 samples are used.";
  const std::string text = result_text(result).toStdString();
  EXPECT_THAT(text, HasSubstr(">No path found<"));
  EXPECT_THAT(text, HasSubstr(">All 500 samples are used.<"));
}

TEST(ResultText, ExplainsWhyNoPathWasFound) {
  planning::PlanResult result;
  result.status = planning::PlanStatus::kTimeLimit;
  result.statistics.rejections[{"thumb", "can"}] = 100;
  EXPECT_THAT(result_text(result).toStdString(), HasSubstr("thumb collided with can"));
}

}  // namespace
}  // namespace handway::gui
