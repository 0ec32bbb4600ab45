/// Plots on screen have the paper of the theme, and ink that is seen on it.
#include "features/campaigns/campaigns_panel.h"
#include "patience.h"
#include "widgets/plots/cursor_plot.h"
#include "widgets/plots/screen_colors.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"
#include "window_test.h"

#include <algorithm>
#include <map>

namespace handway::test {
namespace {

QWidgetList visible_parts(const QWidget& of, const char* type) {
  QWidgetList parts = of.findChildren<QWidget*>();
  parts.erase(std::remove_if(
                  parts.begin(), parts.end(),
                  [&](const QWidget* part) { return !part->inherits(type) || !part->isVisible(); }),
              parts.end());
  return parts;
}

/// Returns the most frequent colour of what is painted: a palette may say otherwise.
QColor paper_of(const QImage& drawn) {
  std::map<QRgb, int> counts;
  for (int x = 0; x < drawn.width(); ++x) {
    for (int y = 0; y < drawn.height(); ++y) {
      ++counts[drawn.pixel(x, y)];
    }
  }
  return std::ranges::max_element(counts, {}, &std::pair<const QRgb, int>::second)->first;
}

void expect_seen_on_paper(const QWidget& panel, gui::Theme theme) {
  const QColor paper = gui::colors_of(theme).surface;
  for (const char* type : {"QwtPlot", "QwtPlotCanvas"}) {
    const QWidgetList parts = visible_parts(panel, type);
    ASSERT_EQ(parts.size(), 1) << type;
    EXPECT_EQ(paper_of(parts.front()->grab().toImage()).name().toStdString(),
              paper.name().toStdString())
        << type;
  }
  ASSERT_GE(visible_parts(panel, "QwtScaleWidget").size(), 2);
  for (QWidget* scale : visible_parts(panel, "QwtScaleWidget")) {
    const QImage drawn = scale->grab().toImage();
    double most = 1.0;
    for (int x = 0; x < drawn.width(); ++x) {
      for (int y = 0; y < drawn.height(); ++y) {
        most = std::max(most, gui::contrast(drawn.pixelColor(x, y), paper));
      }
    }
    EXPECT_GE(most, 4.5) << "numbers and title";
  }
}

class PlotsInTheWindow : public WindowTest {
 protected:
  void TearDown() override {
    if (!IsSkipped()) {
      gui::apply_theme(*qApp, gui::Theme::kLight);
    }
    WindowTest::TearDown();
  }
  void plan_what_is_drawn() {
    open(cell().post());
    plan();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window().workbench().analysis.motion() != nullptr; },
                                kPatienceMs));
  }
  void expect_all_seen(gui::Theme theme) {
    SCOPED_TRACE(theme == gui::Theme::kDark ? "dark" : "light");
    auto& campaigns = tool<gui::CampaignsPanel>();
    campaigns.come_to_front();
    QTest::qWait(50);
    expect_seen_on_paper(campaigns, theme);
    for (const char* name : {"plots", "projection"}) {
      SCOPED_TRACE(name);
      show_dock(name);
      expect_seen_on_paper(part<QWidget>(name), theme);
    }
  }
};

TEST_F(PlotsInTheWindow, FollowTheTheme) {
  plan_what_is_drawn();
  for (const gui::Theme theme : {gui::Theme::kDark, gui::Theme::kLight, gui::Theme::kDark}) {
    window().workbench().preferences.set(&gui::PreferenceValues::theme, std::optional(theme));
    expect_all_seen(theme);
  }
}

class PlotsInADarkWindow : public PlotsInTheWindow {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    gui::apply_theme(*qApp, gui::Theme::kDark);
    PlotsInTheWindow::SetUp();
  }
};

TEST_F(PlotsInADarkWindow, AreDarkFromTheStart) {
  plan_what_is_drawn();
  expect_all_seen(gui::Theme::kDark);
}

TEST_F(PlotsInADarkWindow, AreWhiteInPrint) {
  const QString file = QString::fromStdString((cell().folder() / "plot.png").string());
  gui::CursorPlot plot;
  plot.set_colors(gui::screen_colors(), Qt::red);
  plot.set_lines({0.0, 1.0}, {{"joint", Qt::blue, false, {0.0, 1.0}, {}}});
  plot.write(file, "Joint");
  EXPECT_EQ(paper_of(QImage(file)).name().toStdString(), "#ffffff");
}

}  // namespace
}  // namespace handway::test
