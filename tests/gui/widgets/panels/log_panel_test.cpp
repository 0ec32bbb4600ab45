#include "widgets/panels/log_panel.h"

#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"
#include "window_test.h"

#include <QApplication>
#include <QScrollBar>
#include <QTest>
#include <QTextBlock>

#include <gtest/gtest.h>

namespace handway::test {
namespace {

using gui::LogPanel;

TEST(LogPanel, IsReadableInTheThemeThatIsChosenLater) {
  HANDWAY_NEED_DISPLAY();
  auto& application = *qobject_cast<QApplication*>(QApplication::instance());
  gui::apply_theme(application, gui::Theme::kLight, 1.0);
  LogPanel log;
  log.show();
  for (const LogPanel::Level level :
       {LogPanel::Level::kNote, LogPanel::Level::kWarning, LogPanel::Level::kError}) {
    log.add(level, QStringLiteral("Path found"));
  }
  for (const gui::Theme theme : {gui::Theme::kDark, gui::Theme::kLight}) {
    gui::apply_theme(application, theme, 1.0);
    EXPECT_EQ(log.document()->blockCount(), 3);
    for (QTextBlock block = log.document()->begin(); block.isValid(); block = block.next()) {
      for (auto part = block.begin(); !part.atEnd(); ++part) {
        const QTextFragment text = part.fragment();
        EXPECT_TRUE(text.text().trimmed().isEmpty() ||
                    gui::contrast(text.charFormat().foreground().color(),
                                  gui::colors_of(theme).surface) >= 4.5)
            << qPrintable(text.text());
      }
    }
  }
}

TEST(LogPanel, ShowsALongMessageFromItsBeginning) {
  HANDWAY_NEED_DISPLAY();
  LogPanel log;
  log.resize(240, 70);
  log.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&log));
  const auto first_shown = [&] { return log.cursorForPosition(QPoint(20, 12)); };
  log.add(LogPanel::Level::kNote, QStringLiteral("Opened"));
  log.add(LogPanel::Level::kWarning, QStringLiteral("why ").repeated(60));
  EXPECT_TRUE(first_shown().block().text().contains(QLatin1String("why")));
  EXPECT_LT(first_shown().positionInBlock(), 40) << "in its first line";
  log.add(LogPanel::Level::kWarning, QStringLiteral("how ").repeated(60));
  log.add(LogPanel::Level::kWarning, QStringLiteral("who ").repeated(60));
  EXPECT_TRUE(first_shown().block().text().contains(QLatin1String("who")));
  EXPECT_LT(first_shown().positionInBlock(), 40) << "of several at once, the last";
  for (int i = 0; i < 9; ++i) {
    log.add(LogPanel::Level::kNote, QStringLiteral("Path found"));
  }
  EXPECT_EQ(log.verticalScrollBar()->value(), log.verticalScrollBar()->maximum());
}

}  // namespace
}  // namespace handway::test
