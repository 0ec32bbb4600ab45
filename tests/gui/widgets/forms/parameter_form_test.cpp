#include "widgets/forms/parameter_form.h"

#include "window_test.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSignalSpy>
#include <QSpinBox>

namespace handway::gui {
namespace {

class ParameterForms : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    form_ = std::make_unique<ParameterForm>(std::vector<planning::Parameter>{
        {"smooth", "Smooth the path", "", "", &smooth_},
        {"count", "Count", "", "How many", &count_, 1.0, 50.0},
        {"step", "Step", "rad", "How far", &step_, 1e-6, 2.0},
        {"corridor", "Corridor", "", "", planning::ChoiceValue{&choice_, {"joint", "cartesian"}}}});
  }
  template <typename Field>
  [[nodiscard]] Field& field(const char* key) const {
    return *form_->findChild<Field*>(QLatin1String(key));
  }

  bool smooth_ = true;
  int count_ = 7;
  double step_ = 0.02;
  int choice_ = 1;
  std::unique_ptr<ParameterForm> form_;
};

TEST_F(ParameterForms, ShowsEveryKindOfParameterWithItsValue) {
  EXPECT_TRUE(field<QCheckBox>("smooth").isChecked());
  EXPECT_EQ(field<QSpinBox>("count").value(), 7);
  EXPECT_EQ(field<QSpinBox>("count").maximum(), 50);
  EXPECT_EQ(field<QDoubleSpinBox>("step").text(), "0.02 rad");
  EXPECT_EQ(field<QComboBox>("corridor").currentText(), "cartesian");
}

TEST_F(ParameterForms, WritesWhatIsEntered) {
  QSignalSpy edited(form_.get(), &ParameterForm::edited);
  field<QCheckBox>("smooth").setChecked(false);
  field<QSpinBox>("count").setValue(20);
  field<QDoubleSpinBox>("step").setValue(0.000005);
  field<QComboBox>("corridor").setCurrentIndex(0);
  EXPECT_FALSE(smooth_);
  EXPECT_EQ(count_, 20);
  EXPECT_DOUBLE_EQ(step_, 0.000005);
  EXPECT_EQ(choice_, 0);
  EXPECT_EQ(edited.count(), 4);
}

TEST_F(ParameterForms, KeepsNumbersInTheirRange) {
  field<QSpinBox>("count").setValue(1000);
  EXPECT_EQ(count_, 50);
}

TEST(ObjectiveForm, ShowsWeightsWhereTheyCount) {
  HANDWAY_NEED_DISPLAY();
  int objective = 0;
  double weight = 1.0;
  ParameterForm form({{"objective", "Objective", "", "",
                       planning::ChoiceValue{&objective, {"shortest", "custom"}}},
                      {"weight_length", "Weight of length", "", "", &weight, 0.0, 10.0}});
  form.show();
  const auto* field = form.findChild<QDoubleSpinBox*>(QStringLiteral("weight_length"));
  EXPECT_FALSE(field->isVisible());
  form.findChild<QComboBox*>(QStringLiteral("objective"))->setCurrentIndex(1);
  EXPECT_TRUE(field->isVisible());
  form.findChild<QComboBox*>(QStringLiteral("objective"))->setCurrentIndex(0);
  EXPECT_FALSE(field->isVisible());
}

}  // namespace
}  // namespace handway::gui
