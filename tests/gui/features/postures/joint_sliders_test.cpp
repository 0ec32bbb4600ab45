#include "view3d/scene_view.h"
#include "widgets/forms/slider_row.h"
#include "window_test.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QTabWidget>

#include <numbers>

namespace handway::test {
namespace {

class JointSliders : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
    }
  }
  [[nodiscard]] const geometric::Configuration& shown() const {
    return window().document().configuration();
  }
  [[nodiscard]] int variable(const char* name) const {
    return window().document().robot()->model->find_variable(name).value();
  }
  [[nodiscard]] QSlider& slider(const char* name) const {
    return *part<gui::SliderRow>(name).findChild<QSlider*>();
  }
};

TEST_F(JointSliders, MoveTheRobot) {
  slider("elbow").setValue(slider("elbow").maximum());
  EXPECT_DOUBLE_EQ(shown()[variable("elbow")], 2.5);
}

TEST_F(JointSliders, TakeDegreesFromTheKeyboard) {
  part<gui::SliderRow>("elbow").findChild<QDoubleSpinBox*>()->setValue(90.0);
  EXPECT_NEAR(shown()[variable("elbow")], std::numbers::pi / 2.0, 1e-12);
}

TEST_F(JointSliders, AreMarkedForALinkThatIsClickedWhereverTheyAre) {
  const gui::SceneItem lower{gui::SceneItem::Kind::kLink, window().document().robot()->name,
                             "lower"};
  const int tab = part<QTabWidget>("control_tabs").currentIndex();
  emit window().view().picked(lower, false);
  EXPECT_EQ(part<QTabWidget>("control_tabs").currentIndex(), tab) << "another panel is in use";
  const auto is_marked = [&](const char* joint) {
    return part<gui::SliderRow>(joint).findChild<QLabel*>()->property("role").toString() ==
           QStringLiteral("chosen");
  };
  EXPECT_TRUE(is_marked("elbow"));
  EXPECT_FALSE(is_marked("shoulder"));
  part<QTabWidget>("control_tabs").setCurrentIndex(1);
  EXPECT_TRUE(part<gui::SliderRow>("elbow").isVisible());
  keep_picture("clicked_link");
}

TEST_F(JointSliders, FollowTheRobot) {
  click("go_to_goal");
  EXPECT_DOUBLE_EQ(part<gui::SliderRow>("shoulder").value(), 1.5);
}

TEST_F(JointSliders, ShowCoupledJoints) {
  slider("left").setValue(slider("left").maximum());
  EXPECT_DOUBLE_EQ(part<gui::SliderRow>("tip").value(), 0.4);
  EXPECT_FALSE(slider("tip").isEnabled());
}

TEST_F(JointSliders, OfPrincipalDirectionsMoveAllTheirJoints) {
  click("mean_posture");
  EXPECT_NEAR(shown()[variable("left")], 0.3, 1e-12);
  EXPECT_NEAR(shown()[variable("right")], -0.3, 1e-12);
  slider("PMD1").setValue(slider("PMD1").maximum());
  EXPECT_NEAR(shown()[variable("left")], 0.3 + 0.6 * 0.4, 1e-9);
  EXPECT_NEAR(shown()[variable("right")], -0.3 + 0.8 * 0.4, 1e-9);
}

}  // namespace
}  // namespace handway::test
