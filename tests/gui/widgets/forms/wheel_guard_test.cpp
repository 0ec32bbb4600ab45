#include "widgets/forms/wheel_guard.h"

#include "window_test.h"

#include <QComboBox>
#include <QScrollArea>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>
#include <QWheelEvent>

namespace handway::test {
namespace {

/// A panel that is too long for its window, with fields of all kinds.
class TheWheelOverAPanel : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    guard_ = std::make_unique<gui::WheelGuard>(nullptr);
    area_ = std::make_unique<QScrollArea>();
    auto* panel = new QWidget;
    auto* layout = new QVBoxLayout(panel);
    slider_ = new QSlider(Qt::Horizontal);
    number_ = new QSpinBox;
    choice_ = new QComboBox;
    choice_->addItems({"one", "two", "three"});
    for (QWidget* field : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(number_),
                           static_cast<QWidget*>(choice_)}) {
      layout->addWidget(field);
    }
    panel->setMinimumHeight(2000);
    area_->setWidget(panel);
    area_->resize(300, 200);
    area_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(area_.get()));
    QApplication::setActiveWindow(area_.get());
    area_->setFocus();
  }

  /// @returns false if the event goes on to what the widget is in.
  static bool roll(QWidget& widget, int steps) {
    const QPointF middle(widget.rect().center());
    QWheelEvent wheel(middle, widget.mapToGlobal(middle.toPoint()), {}, {0, 120 * steps},
                      Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&widget, &wheel);
    return wheel.isAccepted();
  }

  std::unique_ptr<gui::WheelGuard> guard_;
  std::unique_ptr<QScrollArea> area_;
  QSlider* slider_ = nullptr;
  QSpinBox* number_ = nullptr;
  QComboBox* choice_ = nullptr;
};

TEST_F(TheWheelOverAPanel, GoesOnToThePanelWhereNoFieldHasTheFocus) {
  for (QWidget* field : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(number_),
                         static_cast<QWidget*>(choice_)}) {
    EXPECT_FALSE(roll(*field, -1));
  }
  EXPECT_EQ(slider_->value(), 0);
  EXPECT_EQ(number_->value(), 0);
  EXPECT_EQ(choice_->currentIndex(), 0);
}

TEST_F(TheWheelOverAPanel, ChangesTheFieldThatHasTheFocus) {
  number_->setFocus();
  ASSERT_TRUE(number_->hasFocus());
  EXPECT_TRUE(roll(*number_, 1));
  EXPECT_EQ(number_->value(), 1);
}

TEST_F(TheWheelOverAPanel, DoesNotTakeTheFocus) {
  for (const QWidget* field : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(number_),
                               static_cast<QWidget*>(choice_)}) {
    EXPECT_NE(field->focusPolicy(), Qt::WheelFocus);
  }
}

}  // namespace
}  // namespace handway::test
