#include "widgets/style/text_rules.h"

#include "window_test.h"

#include <QHelpEvent>
#include <QLabel>
#include <QListWidget>
#include <QMessageBox>
#include <QToolTip>

#include <memory>

namespace handway::test {
namespace {

class TextRules : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    rules_ = std::make_unique<gui::TextRules>(nullptr);
  }

  /// Holds the pointer still over a widget. @returns the tool tip that is shown, nullptr if there
  /// is none.
  static const QLabel* tip_of(QWidget& widget, const QPoint& place) {
    QHelpEvent event(QEvent::ToolTip, place, widget.mapToGlobal(place));
    QApplication::sendEvent(&widget, &event);
    for (const QWidget* shown : QApplication::topLevelWidgets()) {
      if (shown->inherits("QTipLabel") && shown->isVisible()) {
        return static_cast<const QLabel*>(shown);
      }
    }
    return nullptr;
  }

 private:
  std::unique_ptr<gui::TextRules> rules_;
};

TEST_F(TextRules, TakeALabelForPlainTextUnlessItSaysOtherwise) {
  QLabel name(QStringLiteral("<h1>Cell</h1>"));
  QLabel words(QStringLiteral("<b>Cell</b>"));
  words.setTextFormat(Qt::RichText);
  name.show();
  words.show();
  EXPECT_EQ(name.textFormat(), Qt::PlainText);
  EXPECT_EQ(name.text(), "<h1>Cell</h1>");
  EXPECT_EQ(words.textFormat(), Qt::RichText);
  name.setText(QStringLiteral("<img src=\"x\">"));
  EXPECT_EQ(name.textFormat(), Qt::PlainText) << "a text that comes later";
}

TEST_F(TextRules, HoldForMessageBoxes) {
  QMessageBox box;
  box.setText(QStringLiteral("Save the changes to <b>cell</b>?"));
  box.setInformativeText(QStringLiteral("<i>cell.yaml</i>"));
  box.show();
  for (const QLabel* label : box.findChildren<QLabel*>()) {
    EXPECT_EQ(label->textFormat(), Qt::PlainText) << label->objectName().toStdString();
  }
}

TEST_F(TextRules, HoldForToolTips) {
  QListWidget list;
  list.addItem(QStringLiteral("cell"));
  list.item(0)->setToolTip(QStringLiteral("<b>cell</b>"));
  list.show();
  const QLabel* tip = tip_of(*list.viewport(), list.visualItemRect(list.item(0)).center());
  ASSERT_TRUE(tip);
  EXPECT_EQ(tip->textFormat(), Qt::PlainText);
  EXPECT_EQ(tip->text(), "<b>cell</b>");
  QToolTip::hideText();
}

// Qt would show this in one line, wider than the screen with large text.
TEST_F(TextRules, BreakToolTipsIntoLines) {
  const QString sentence = QStringLiteral("Make the path better for the objective above. ");
  const int letter = QFontMetrics(QToolTip::font()).averageCharWidth();
  QWidget widget;
  widget.setToolTip(sentence);
  widget.show();
  const QLabel* tip = tip_of(widget, QPoint(2, 2));
  ASSERT_TRUE(tip);
  EXPECT_EQ(tip->text(), sentence);
  widget.setToolTip(sentence.repeated(6) + QStringLiteral("\n") + sentence);
  tip = tip_of(widget, QPoint(2, 2));
  ASSERT_TRUE(tip);
  EXPECT_LT(tip->width(), 110 * letter);
  EXPECT_EQ(tip->text().simplified(), (sentence.repeated(7)).simplified());
  QListWidget list;
  list.addItem(QStringLiteral("cell"));
  list.item(0)->setToolTip(sentence.repeated(5));
  list.show();
  tip = tip_of(*list.viewport(), list.visualItemRect(list.item(0)).center());
  ASSERT_TRUE(tip);
  EXPECT_GT(tip->text().count(QLatin1Char('\n')), 1);
  EXPECT_LT(tip->width(), 110 * letter);
  QToolTip::hideText();
}

}  // namespace
}  // namespace handway::test
