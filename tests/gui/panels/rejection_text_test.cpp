#include "panels/rejection_text.h"

#include <gtest/gtest.h>

namespace handway::test {
namespace {

TEST(RejectionText, NamesThePairAndTheStretch) {
  planning::PlanStatistics statistics;
  statistics.rejections[{"thumb", "can"}] = 78;
  statistics.rejections[{"palm", "table"}] = 22;
  statistics.rejections_per_tenth = {1, 1, 2, 2, 2, 2, 70, 10, 5, 5};
  EXPECT_EQ(
      gui::rejection_text(statistics).toStdString(),
      "In 78 % of the samples that were refused, thumb touched can; most of them between "
      "60 and 70 % of the way. Try more time, another planner or preset, or more room between "
      "thumb and can on the way.");
}

TEST(RejectionText, LeavesOutAStretchThatTellsNothing) {
  planning::PlanStatistics statistics;
  statistics.rejections[{"thumb", "can"}] = 100;
  statistics.rejections_per_tenth.assign(10, 10);
  EXPECT_EQ(gui::rejection_text(statistics).toStdString(),
            "In 100 % of the samples that were refused, thumb touched can. Try more time, another "
            "planner or preset, or more room between thumb and can on the way.");
}

TEST(RejectionText, SendsToTheEndThatIsTooTight) {
  planning::PlanStatistics statistics;
  statistics.rejections[{"thumb", "can"}] = 100;
  statistics.rejections_per_tenth = {0, 0, 0, 0, 0, 0, 0, 10, 40, 50};
  EXPECT_TRUE(gui::rejection_text(statistics)
                  .endsWith(QStringLiteral("Try a goal with more room between thumb and can.")));
  statistics.rejections_per_tenth = {50, 40, 10, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(gui::rejection_text(statistics)
                  .endsWith(QStringLiteral("Try a start with more room between thumb and can.")));
}

TEST(RejectionText, IsEmptyWithoutRejections) { EXPECT_TRUE(gui::rejection_text({}).isEmpty()); }

}  // namespace
}  // namespace handway::test
