#include "model/settings/preferences.h"

#include "features/editing/editing_test.h"
#include "features/planning/plan_panel.h"
#include "features/preferences/preferences_dialog.h"
#include "model/document/autosave.h"
#include "pressed_mouse.h"
#include "view3d/orientation_cube.h"
#include "view3d/scene_view.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/style/desktop_theme.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSettings>
#include <QSpinBox>

#include <algorithm>
#include <filesystem>

namespace handway::test {
namespace {

using gui::PreferenceValues;

class ThePreferences : public EditingTest {
 protected:
  void SetUp() override {
    EditingTest::SetUp();
    if (!IsSkipped()) {
      part<QAction>("preferences").trigger();
    }
  }
  void TearDown() override {
    if (!IsSkipped()) {
      window().workbench().preferences.set(PreferenceValues{});
    }
    EditingTest::TearDown();
  }

  [[nodiscard]] const PreferenceValues& values() const {
    return window().workbench().preferences.values();
  }
  [[nodiscard]] gui::SceneView& view() const { return window().view(); }
  void choose(const char* box, int index) const { part<QComboBox>(box).setCurrentIndex(index); }
  [[nodiscard]] double turned_by(Qt::MouseButton button) const {
    const double before = view().camera().placement().azimuth;
    QTest::mousePress(&view(), button, {}, QPoint(40, 200));
    QMouseEvent move(QEvent::MouseMove, QPoint(80, 200), view().mapToGlobal(QPoint(80, 200)),
                     Qt::NoButton, button, Qt::NoModifier);
    QCoreApplication::sendEvent(&view(), &move);
    QTest::mouseRelease(&view(), button, {}, QPoint(80, 200));
    return view().camera().placement().azimuth - before;
  }
};

TEST_F(ThePreferences, WorkAtOnceInTheView) {
  choose("projection", 1);
  EXPECT_EQ(view().camera().projection(), gui::Projection::kOrthographic);
  EXPECT_TRUE(part<QAction>("orthographic").isChecked());
  part<QCheckBox>("show_cube").setChecked(false);
  EXPECT_FALSE(part<gui::OrientationCube>("orientation_cube").isVisible());
  part<QCheckBox>("show_floor").setChecked(false);
  EXPECT_FALSE(part<QAction>("grid").isChecked());
  EXPECT_LT(turned_by(Qt::LeftButton), -0.1);
  choose("navigation", 1);
  EXPECT_EQ(turned_by(Qt::LeftButton), 0.0);
  EXPECT_LT(turned_by(Qt::MiddleButton), -0.1);
  choose("navigation", 2);
  EXPECT_LT(turned_by(Qt::RightButton), -0.1);
  EXPECT_EQ(turned_by(Qt::MiddleButton), 0.0);
}

TEST_F(ThePreferences, ReverseTheWheel) {
  const auto roll = [this] {
    const double before = view().camera().placement().distance;
    const QPointF middle(view().rect().center());
    QWheelEvent wheel(middle, view().mapToGlobal(middle.toPoint()), {}, {0, 120}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&view(), &wheel);
    return view().camera().placement().distance - before;
  };
  EXPECT_LT(roll(), 0.0);
  choose("wheel", 1);
  EXPECT_GT(roll(), 0.0);
}

TEST_F(ThePreferences, MakeEdgesSmoothOrNot) {
  const auto picture = [this] {
    view().settle();
    return view().grabFramebuffer();
  };
  choose("samples", 0);
  const QImage rough = picture();
  choose("samples", 2);
  EXPECT_NE(picture(), rough);
  choose("samples", 0);
  EXPECT_EQ(picture(), rough);
}

TEST_F(ThePreferences, PaintFinelyWhileSomethingMovesOrNot) {
  choose("motion_quality", 1);
  choose("samples", 2);
  const auto turned = [this] {
    gui::OrbitCamera::Placement placement = view().camera().placement();
    placement.azimuth = 1.0;
    view().set_camera(placement);
    return view().grabFramebuffer();
  };
  view().settle();
  const QImage fine = turned();
  choose("motion_quality", 0);
  EXPECT_NE(turned(), fine);
  view().settle();
  EXPECT_EQ(view().grabFramebuffer(), fine);
}

TEST_F(ThePreferences, ChangeTheTheme) {
  choose("theme", 2);
  EXPECT_EQ(gui::current_theme(), gui::Theme::kDark);
  EXPECT_TRUE(part<QAction>("theme").isChecked());
  choose("theme", 0);
  EXPECT_EQ(gui::current_theme(), gui::desktop_theme());
  EXPECT_FALSE(values().theme) << "it stays the desktop's";
}

TEST_F(ThePreferences, ShowQuantitiesInOtherUnits) {
  select("post");
  auto& x = part<gui::QuantityField>("position_x");
  const double metres = x.quantity();
  choose("length_unit", 1);
  EXPECT_TRUE(x.text().endsWith(" cm")) << x.text().toStdString();
  EXPECT_DOUBLE_EQ(x.quantity(), metres);
  x.selectAll();
  QTest::keyClicks(&x, "25");
  QTest::keyClick(&x, Qt::Key_Return);
  EXPECT_NEAR(object("post").X_PO.translation().x(), 0.25, 1e-12);
  x.selectAll();
  QTest::keyClicks(&x, "300 mm");
  QTest::keyClick(&x, Qt::Key_Return);
  EXPECT_NEAR(object("post").X_PO.translation().x(), 0.3, 1e-12);
  EXPECT_EQ(x.text(), "30 cm");
  choose("angle_unit", 1);
  EXPECT_TRUE(part<gui::QuantityField>("yaw").text().endsWith(" rad"));
}

TEST_F(ThePreferences, SetWhatPlanningBeginsWith) {
  part<QSpinBox>("usual_threads").setValue(3);
  part<QDoubleSpinBox>("usual_time_limit").setValue(12.0);
  const planning::PlanRequest request = window().workbench().plan_settings.request();
  EXPECT_EQ(request.threads, 3);
  EXPECT_DOUBLE_EQ(request.time_limit_s, 12.0);
  auto& planner = part<QComboBox>("usual_planner");
  planner.setCurrentIndex(planner.count() - 1);
  const std::string last = planner.currentText().toStdString();
  window().workbench().plan_settings.apply({});
  EXPECT_EQ(window().workbench().plan_settings.planner()->name(), last);
}

TEST_F(ThePreferences, SwitchOffTheKeepingOfUnsavedChanges) {
  const auto is_kept = [] {
    const std::filesystem::recursive_directory_iterator files(gui::Autosave::default_folder());
    return std::ranges::any_of(
        files, [](const auto& entry) { return entry.path().filename() == "scene.yaml"; });
  };
  select("post");
  editor().set_color({0.1F, 0.2F, 0.3F, 1.0F});
  ASSERT_TRUE(QTest::qWaitFor(is_kept, 5000));
  part<QCheckBox>("autosave").setChecked(false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !is_kept(); }, 5000));
  editor().set_color({0.3F, 0.2F, 0.1F, 1.0F});
  QTest::qWait(100);
  EXPECT_FALSE(is_kept());
  part<QCheckBox>("autosave").setChecked(true);
  EXPECT_TRUE(QTest::qWaitFor(is_kept, 5000));
}

TEST_F(ThePreferences, AreThereInTheNextRunAndGoBackToTheDefaults) {
  choose("projection", 1);
  choose("frame_limit", 0);
  choose("length_unit", 2);
  const gui::Preferences next;
  EXPECT_EQ(next.values(), values());
  click("restore_defaults");
  EXPECT_EQ(values(), PreferenceValues{});
  EXPECT_EQ(part<QComboBox>("projection").currentIndex(), 0);
  EXPECT_EQ(view().camera().projection(), gui::Projection::kPerspective);
}

TEST(Preferences, TakeNoNonsenseFromTheSettings) {
  HANDWAY_NEED_DISPLAY();
  QSettings().setValue("view/projection", "fisheye");
  QSettings().setValue("view/samples", 4000);
  EXPECT_EQ(gui::Preferences().values(), PreferenceValues{});
  QSettings().remove("view/projection");
  QSettings().remove("view/samples");
}

TEST(Preferences, LimitTheFramesOfASecond) {
  HANDWAY_NEED_DISPLAY();
  class Canvas : public QWidget {
   public:
    gui::FramePacer pacer{*this};
    int painted = 0;

   protected:
    void paintEvent(QPaintEvent* /*event*/) override {
      pacer.note_painted();
      ++painted;
    }
  };
  Canvas canvas;
  canvas.pacer.set_limit(10);
  canvas.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&canvas));
  QTest::qWait(200);
  canvas.painted = 0;
  QElapsedTimer timer;
  timer.start();
  while (timer.elapsed() < 500) {
    canvas.pacer.request();
    QTest::qWait(2);
  }
  const double allowed = 1e-3 * static_cast<double>(timer.elapsed()) * 10.0 + 1.0;
  EXPECT_GE(canvas.painted, 1);
  EXPECT_LE(canvas.painted, allowed);
}

}  // namespace
}  // namespace handway::test
