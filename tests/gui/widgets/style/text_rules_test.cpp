#include "widgets/style/tooltips.h"

#include <QApplication>
#include <QHelpEvent>
#include <QLabel>
#include <QTest>
#include <QToolTip>

#include <gtest/gtest.h>

namespace handway::test {
namespace {

// Returns the width of the tool tip that is shown over a widget; 0 if there is none.
int width_of(const QString& tip) {
  QWidget widget;
  widget.setToolTip(tip);
  widget.show();
  QHelpEvent event(QEvent::ToolTip, QPoint(2, 2), widget.mapToGlobal(QPoint(2, 2)));
  QApplication::sendEvent(&widget, &event);
  int width = 0;
  for (const QWidget* shown : QApplication::topLevelWidgets()) {
    if (shown->inherits("QTipLabel") && shown->isVisible()) {
      width = shown->width();
    }
  }
  QToolTip::hideText();
  return width;
}

// Qt would show this in one line, wider than the screen with large text.
TEST(Tooltips, AreBrokenIntoLines) {
  if (!QCoreApplication::instance()) {
    GTEST_SKIP() << "no display";
  }
  const gui::WrappedTooltips wrapped(nullptr);
  const QString sentence = QStringLiteral("Make the path better for the objective above. ");
  const int letter = QFontMetrics(QToolTip::font()).averageCharWidth();
  ASSERT_GT(width_of(sentence), 0);
  EXPECT_LT(width_of(sentence.repeated(6)), 110 * letter);
}

}  // namespace
}  // namespace handway::test
