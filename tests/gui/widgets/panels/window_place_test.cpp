/// Tests that the place of the window is kept between runs.
#include "widgets/panels/dock_layout.h"

#include <QMainWindow>
#include <QScreen>
#include <QSettings>

#include <gtest/gtest.h>

namespace handway::test {
namespace {

TEST(WindowPlace, IsTheUsualSizeAtFirst) {
  QSettings().remove(QStringLiteral("window"));
  QMainWindow window;
  gui::restore_geometry(window, {900, 500});
  EXPECT_EQ(window.size(), QSize(900, 500));
  EXPECT_FALSE(window.isMaximized());
}

// The status line was below the lower edge of a screen as large as the window without its frame.
TEST(WindowPlace, IsTheWholeScreenAtFirstWhereTheFrameHasNoRoom) {
  QSettings().remove(QStringLiteral("window"));
  QMainWindow window;
  const QSize screen = window.screen()->availableSize();
  gui::restore_geometry(window, screen);
  EXPECT_TRUE(window.isMaximized());
  EXPECT_LT(window.height(), screen.height());
  EXPECT_LT(window.width(), screen.width());
}

TEST(WindowPlace, IsThatOfLastTime) {
  QMainWindow last;
  last.setGeometry(120, 90, 710, 610);
  gui::save_layout(last);
  QMainWindow window;
  gui::restore_geometry(window, {1000, 800});
  EXPECT_EQ(window.geometry(), QRect(120, 90, 710, 610));
}

}  // namespace
}  // namespace handway::test
