#include "widgets/forms/typed_input.h"

#include "widgets/forms/quantity_field.h"
#include "widgets/forms/shape_form.h"
#include "widgets/forms/slider_row.h"
#include "window_test.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>

namespace handway::test {
namespace {

using Kind = gui::QuantityField::Kind;

/// Fields of all kinds, and another widget to go to.
class TypedInput : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    guard_ = std::make_unique<gui::TypingGuard>(nullptr);
    panel_ = std::make_unique<QWidget>();
    auto* layout = new QVBoxLayout(panel_.get());
    length_ = new gui::QuantityField(Kind::kLength, -1.0, 1.0);
    count_ = new QSpinBox;
    count_->setRange(0, 1000);
    count_->setKeyboardTracking(false);
    name_ = new QLineEdit;
    slider_ = new gui::SliderRow("joint", {-1.0, 1.0, 100.0, QStringLiteral(" %"), 1});
    choice_ = new QComboBox;
    away_ = new QPushButton("away");
    for (QWidget* part : {static_cast<QWidget*>(length_), static_cast<QWidget*>(count_),
                          static_cast<QWidget*>(name_), static_cast<QWidget*>(slider_),
                          static_cast<QWidget*>(choice_), static_cast<QWidget*>(away_)}) {
      layout->addWidget(part);
    }
    panel_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(panel_.get()));
    QApplication::setActiveWindow(panel_.get());
  }

  /// Replaces the field's text key by key; the program shows another value after each.
  template <typename Show>
  static void type_while(QWidget& field, const char* text, Show show) {
    field.setFocus();
    QTest::keyClick(&field, Qt::Key_A, Qt::ControlModifier);
    int frame = 0;
    for (const char* key = text; *key != '\0'; ++key) {
      QTest::keyClick(&field, *key);
      show(++frame);
    }
  }

  std::unique_ptr<gui::TypingGuard> guard_;
  std::unique_ptr<QWidget> panel_;
  gui::QuantityField* length_ = nullptr;
  QSpinBox* count_ = nullptr;
  QLineEdit* name_ = nullptr;
  gui::SliderRow* slider_ = nullptr;
  QComboBox* choice_ = nullptr;
  QPushButton* away_ = nullptr;
};

TEST_F(TypedInput, StaysInAFieldThatTheProgramShowsValuesIn) {
  QSignalSpy edited(length_, &gui::QuantityField::quantity_edited);
  type_while(*length_, "123.4", [&](int frame) { length_->show_quantity(0.01 * frame); });
  EXPECT_EQ(length_->cleanText(), "123.4");
  EXPECT_TRUE(gui::is_being_edited(*length_));
  QTest::keyClick(length_, Qt::Key_Return);
  ASSERT_EQ(edited.size(), 1);
  EXPECT_NEAR(edited[0][0].toDouble(), 0.1234, 1e-9);
  EXPECT_FALSE(gui::is_being_edited(*length_));
  length_->show_quantity(0.2);
  EXPECT_EQ(length_->text(), "200 mm");
}

TEST_F(TypedInput, IsEnteredWhenTheFieldIsLeft) {
  QSignalSpy edited(length_, &gui::QuantityField::quantity_edited);
  type_while(*length_, "50", [&](int frame) { length_->show_quantity(0.01 * frame); });
  away_->setFocus();
  ASSERT_EQ(edited.size(), 1);
  EXPECT_NEAR(edited[0][0].toDouble(), 0.05, 1e-9);
}

TEST_F(TypedInput, CountsAlsoWhereItIsTheValueFromBefore) {
  length_->show_quantity(0.05);
  QSignalSpy edited(length_, &gui::QuantityField::quantity_edited);
  type_while(*length_, "50", [&](int frame) { length_->show_quantity(0.3 + 0.01 * frame); });
  QTest::keyClick(length_, Qt::Key_Return);
  ASSERT_EQ(edited.size(), 1) << "the robot has moved on since: it is an edit";
  EXPECT_NEAR(edited[0][0].toDouble(), 0.05, 1e-9);
}

TEST_F(TypedInput, ShowsWhatTheProgramMadeOfIt) {
  QObject::connect(length_, &gui::QuantityField::quantity_edited, length_,
                   [&](double value) { length_->show_quantity(std::min(value, 0.1)); });
  type_while(*length_, "500", [](int) {});
  QTest::keyClick(length_, Qt::Key_Return);
  EXPECT_EQ(length_->text(), "100 mm");
}

TEST_F(TypedInput, IsForgottenWithEscape) {
  QSignalSpy edited(length_, &gui::QuantityField::quantity_edited);
  type_while(*length_, "77", [&](int frame) { length_->show_quantity(0.1 * frame); });
  QTest::keyClick(length_, Qt::Key_Escape);
  EXPECT_EQ(length_->text(), "200 mm") << "the value of now";
  type_while(*length_, "7", [](int) {});
  QTest::keyClick(length_, Qt::Key_Escape);
  EXPECT_EQ(length_->text(), "200 mm");
  EXPECT_EQ(edited.size(), 0);
}

TEST_F(TypedInput, IsForgottenWhereTheFieldIsAboutSomethingElse) {
  type_while(*length_, "77", [&](int) { length_->show_quantity(0.3); });
  gui::forget_typed(*panel_);
  EXPECT_EQ(length_->text(), "300 mm");
}

TEST_F(TypedInput, StaysInCountsAndNames) {
  type_while(*count_, "421", [&](int frame) { gui::show_value(*count_, frame); });
  EXPECT_EQ(count_->text(), "421");
  QTest::keyClick(count_, Qt::Key_Return);
  EXPECT_EQ(count_->value(), 421);

  gui::show_text(*name_, "bowl");
  QStringList entered;
  const auto listening = QObject::connect(name_, &QLineEdit::editingFinished, name_,
                                          [&] { entered << name_->text(); });
  type_while(*name_, "cup", [&](int frame) { gui::show_text(*name_, QString::number(frame)); });
  EXPECT_EQ(name_->text(), "cup");
  QTest::keyClick(name_, Qt::Key_Return);
  EXPECT_EQ(entered, QStringList{"cup"});
  gui::show_text(*name_, "mug");
  EXPECT_EQ(name_->text(), "mug");
  QObject::disconnect(listening);  // before what it writes to is gone
}

TEST_F(TypedInput, KeepsASliderThatIsHeld) {
  auto& handle = *slider_->findChild<QSlider*>();
  auto& field = *slider_->findChild<QDoubleSpinBox*>();
  handle.setSliderDown(true);
  handle.setSliderPosition(1500);
  slider_->set_value(-1.0);
  EXPECT_EQ(handle.value(), 1500);
  EXPECT_EQ(field.text(), "-100.0 %");
  handle.setSliderDown(false);
  QTest::qWait(1);
  EXPECT_EQ(handle.value(), 0) << "where the joint is";
}

TEST_F(TypedInput, KeepsAListThatIsOpen) {
  gui::show_choices(*choice_, {{"World"}, {"palm", "arm"}}, 0);
  choice_->showPopup();
  ASSERT_TRUE(QTest::qWaitFor([&] { return choice_->view()->isVisible(); }));
  gui::show_choices(*choice_, {{"World"}}, 0);
  EXPECT_EQ(choice_->count(), 2);
  EXPECT_TRUE(choice_->view()->isVisible());
  choice_->hidePopup();
  EXPECT_TRUE(QTest::qWaitFor([&] { return choice_->count() == 1; }));
}

TEST_F(TypedInput, IsMarkedWhereItIsNoValueAndStays) {
  length_->show_quantity(0.1);
  for (const char* nonsense : {"abc", "1e9", "-", "12 parsecs"}) {
    QSignalSpy edited(length_, &gui::QuantityField::quantity_edited);
    type_while(*length_, nonsense, [](int) {});
    EXPECT_TRUE(length_->property("invalid").toBool()) << nonsense;
    ASSERT_TRUE(gui::invalid_text_reason(*length_)) << nonsense;
    QTest::keyClick(length_, Qt::Key_Return);
    EXPECT_EQ(length_->cleanText(), nonsense) << "it is there to be corrected";
    away_->setFocus();
    EXPECT_EQ(length_->text(), "100 mm") << nonsense;
    EXPECT_EQ(edited.size(), 0) << nonsense;
    EXPECT_TRUE(length_->property("invalid").toBool()) << "it was not taken";
  }
  type_while(*length_, "5", [](int) {});
  EXPECT_FALSE(length_->property("invalid").toBool());
}

// Qt's own number fields drop what they don't like: 1e9 would become 19.
TEST_F(TypedInput, NeverBecomesAnotherNumber) {
  gui::show_value(*count_, 7);
  for (const char* nonsense : {"1e9", "12abc", "9999", "1.5"}) {
    type_while(*count_, nonsense, [](int) {});
    EXPECT_EQ(count_->text(), nonsense);
    QTest::keyClick(count_, Qt::Key_Return);
    away_->setFocus();
    EXPECT_EQ(count_->value(), 7) << nonsense;
  }
  auto& field = *slider_->findChild<QDoubleSpinBox*>();
  for (const char* nonsense : {"101", "x", "1e9"}) {
    type_while(field, nonsense, [](int) {});
    QTest::keyClick(&field, Qt::Key_Return);
    away_->setFocus();
    EXPECT_DOUBLE_EQ(slider_->value(), 0.0) << nonsense;
  }
}

TEST_F(TypedInput, KeepsAllItsDigits) {
  auto& field = *slider_->findChild<QDoubleSpinBox*>();
  type_while(field, "12.3456", [](int) {});
  QTest::keyClick(&field, Qt::Key_Return);
  EXPECT_NEAR(slider_->value(), 0.123456, 1e-9);
  EXPECT_EQ(field.text(), "12.3 %") << "fewer are shown";
  QSignalSpy edited(slider_, &gui::SliderRow::value_edited);
  QTest::keyClick(&field, Qt::Key_Return);
  EXPECT_EQ(edited.size(), 0) << "nothing was typed";
  EXPECT_NEAR(slider_->value(), 0.123456, 1e-9);
}

TEST_F(TypedInput, IsEnteredBeforeAClickElsewhereActs) {
  away_->setFocusPolicy(Qt::NoFocus);  // as the buttons of tool bars
  double entered = 0.0;
  double at_click = 0.0;
  QObject::connect(length_, &gui::QuantityField::quantity_edited, length_,
                   [&](double value) { entered = value; });
  QObject::connect(away_, &QPushButton::clicked, away_, [&] { at_click = entered; });
  type_while(*length_, "40", [](int) {});
  QTest::mouseClick(away_, Qt::LeftButton);
  EXPECT_NEAR(at_click, 0.04, 1e-9);
}

TEST_F(TypedInput, StaysInTheScaleOfAMesh) {
  gui::ShapeForm form;
  geometric::Mesh mesh;
  mesh.file = "cup.stl";
  mesh.triangles = geometric::tessellate(geometric::Box{{0.1, 0.1, 0.1}});
  form.show_shape(mesh);
  form.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&form));
  QApplication::setActiveWindow(&form);
  auto* scale = form.findChild<QDoubleSpinBox*>("size_scale");
  ASSERT_TRUE(scale);
  type_while(*scale, "0.5", [&](int) { form.show_shape(mesh); });
  ASSERT_EQ(form.findChild<QDoubleSpinBox*>("size_scale"), scale) << "it is the same field";
  EXPECT_EQ(scale->cleanText(), "0.5");
}

}  // namespace
}  // namespace handway::test
