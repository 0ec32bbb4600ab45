#include "widgets/style/theme.h"

#include <gtest/gtest.h>

namespace handway::gui {
namespace {

TEST(Contrast, IsThatOfTheGuidelines) {
  EXPECT_NEAR(contrast(Qt::black, Qt::white), 21.0, 1e-6);
  EXPECT_NEAR(contrast(Qt::white, QColor(0x77, 0x77, 0x77)), 4.48, 0.01);
  EXPECT_DOUBLE_EQ(contrast(Qt::red, Qt::red), 1.0);
}

TEST(Contrast, IsEnoughForAnyColourOnAnyTheme) {
  for (const QColor& paper : {QColor(Qt::white), QColor(0x24, 0x2a, 0x33)}) {
    for (int hue = 0; hue < 360; hue += 30) {
      for (int value = 0; value <= 255; value += 51) {
        EXPECT_GE(contrast(seen_on(paper, QColor::fromHsv(hue, 120, value)), paper), 2.5);
      }
    }
  }
}

TEST(Contrast, ThatIsEnoughLeavesTheColour) {
  EXPECT_EQ(seen_on(Qt::white, QColor(200, 40, 30)), QColor(200, 40, 30));
}

}  // namespace
}  // namespace handway::gui
