#include "widgets/style/color_math.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QLabel>

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

TEST(Contrast, OfTextsIsThatOfTheThemeThatIsChosenLater) {
  auto& application = *qobject_cast<QApplication*>(QApplication::instance());
  const auto text_in = [](Theme theme) {
    return QStringLiteral("<b style=\"color:%1\">Path found</b>").arg(html(colors_of(theme).good));
  };
  apply_theme(application, Theme::kLight);
  QLabel label(text_in(Theme::kLight));
  apply_theme(application, Theme::kDark);
  EXPECT_EQ(label.text(), text_in(Theme::kDark));
  apply_theme(application, Theme::kLight);
  EXPECT_EQ(label.text(), text_in(Theme::kLight));
}

TEST(Contrast, ThatIsEnoughLeavesTheColour) {
  EXPECT_EQ(seen_on(Qt::white, QColor(200, 40, 30)), QColor(200, 40, 30));
}

}  // namespace
}  // namespace handway::gui
