#include "widgets/forms/parameter_form.h"

#include "window_test.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSpinBox>

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace handway::gui {
namespace {

class ParameterForms : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    form_ = std::make_unique<ParameterForm>(std::vector<geometric::Parameter>{
        {"smooth", "Smooth the path", "", "", true},
        {"count", "Count", "", "How many", 7, 1.0, 50.0},
        {"step", "Step", "rad", "How far", 0.02, 1e-6, 2.0},
        {"corridor", "Corridor", "", "", geometric::Choice{1, {"joint", "cartesian"}}}});
    QObject::connect(form_.get(), &ParameterForm::edited,
                     [this](const std::string& key, const std::string& value) {
                       edits_.push_back(key + " " + value);
                     });
  }
  template <typename Field>
  [[nodiscard]] Field& field(const char* key) const {
    return *form_->findChild<Field*>(QLatin1String(key));
  }

  std::vector<std::string> edits_;
  std::unique_ptr<ParameterForm> form_;
};

TEST_F(ParameterForms, ShowsEveryKindOfParameterWithItsValue) {
  EXPECT_TRUE(field<QCheckBox>("smooth").isChecked());
  EXPECT_EQ(field<QSpinBox>("count").value(), 7);
  EXPECT_EQ(field<QSpinBox>("count").maximum(), 50);
  EXPECT_EQ(field<QDoubleSpinBox>("step").text(), "0.02 rad");
  EXPECT_EQ(field<QComboBox>("corridor").currentText(), "cartesian");
}

TEST_F(ParameterForms, TellsInToolTipsWhatAParameterIs) {
  EXPECT_EQ(field<QSpinBox>("count").toolTip(), "How many\nFrom 1 to 50\ncount");
  EXPECT_EQ(field<QCheckBox>("smooth").toolTip(), "smooth");
}

TEST_F(ParameterForms, ReportsWhatIsEntered) {
  field<QCheckBox>("smooth").setChecked(false);
  field<QSpinBox>("count").setValue(20);
  field<QDoubleSpinBox>("step").setValue(0.000005);
  field<QComboBox>("corridor").setCurrentIndex(0);
  EXPECT_THAT(edits_,
              testing::ElementsAre("smooth false", "count 20", "step 5e-06", "corridor joint"));
}

TEST_F(ParameterForms, KeepsNumbersInTheirRange) {
  field<QSpinBox>("count").setValue(1000);
  EXPECT_THAT(edits_, testing::ElementsAre("count 50"));
}

TEST(ObjectiveForm, ShowsWeightsWhereTheyCount) {
  HANDWAY_NEED_DISPLAY();
  ParameterForm form(
      {{"objective", "Objective", "", "", geometric::Choice{0, {"shortest", "custom"}}},
       {"weight_length", "Weight of length", "", "", 1.0, 0.0, 10.0}});
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
