/// Where the window is, kept between runs.
#include "widgets/panels/dock_layout.h"

#include <QMainWindow>
#include <QScreen>
#include <QSettings>

#include <gtest/gtest.h>

namespace handway::test {
namespace {

TEST(WindowPlace, IsNoLargerThanTheScreenAtFirst) {
  QSettings().remove(QStringLiteral("window"));
  QMainWindow window;
  gui::restore_geometry(window, {100'000, 500});
  EXPECT_EQ(window.width(), window.screen()->availableSize().width());
  EXPECT_EQ(window.height(), 500);
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
