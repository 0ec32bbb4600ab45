/// Views that are saved, distances that are measured, and objects that are cut open.
#include "features/editing/editing_test.h"
#include "handway/geometric/formats/scene_file.h"
#include "patience.h"

#include <QCheckBox>
#include <QInputDialog>
#include <QLabel>
#include <QMenu>
#include <QTimer>

namespace handway::test {
namespace {

using Kind = gui::SceneItem::Kind;

class Viewing : public EditingTest {
 protected:
  [[nodiscard]] gui::SceneView& view() const { return window().view(); }
  /// The entries of a menu that is filled when it is opened.
  [[nodiscard]] QAction& entry(const char* menu, const QString& text) const {
    auto& shown = part<QMenu>(menu);
    emit shown.aboutToShow();
    for (QAction* action : shown.actions()) {
      if (action->text().remove(QLatin1Char('&')) == text) {
        return *action;
      }
    }
    throw std::runtime_error("no entry " + text.toStdString());
  }
  void save_view(const QString& name) const {
    QTimer::singleShot(0, [name] {
      auto* dialog = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
      ASSERT_TRUE(dialog);
      dialog->setTextValue(name);
      dialog->accept();
    });
    entry("saved_views", QString::fromUtf8("Save this view…")).trigger();
  }
  void click_view(const QPoint& place) const {
    QTest::mouseMove(&view(), place);
    QTest::mouseClick(&view(), Qt::LeftButton, {}, place);
  }
  [[nodiscard]] QString measured() const { return part<QLabel>("measure_text").text(); }
};

TEST_F(Viewing, AViewIsSavedWithTheSceneAndGoneToAgain) {
  const gui::OrbitCamera::Placement from{{0.2, 0.1, 0.05}, 0.9, 0.7, 0.4};
  view().set_camera(from);
  save_view(QStringLiteral("by the post"));
  const std::filesystem::path file = cell().folder() / "viewed.yaml";
  geometric::write_scene(scene(), file);
  EXPECT_EQ(geometric::read_scene(file).display.views.front().name, "by the post");
  view().set_camera({});
  entry("saved_views", QStringLiteral("by the post")).trigger();
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const gui::OrbitCamera::Placement& now = view().camera().placement();
        return (now.target - from.target).norm() < 1e-9 && std::abs(now.azimuth - 0.7) < 1e-9 &&
               std::abs(now.distance - 0.9) < 1e-9 && std::abs(now.elevation - 0.4) < 1e-9;
      },
      kPatienceMs));
  editor().undo_stack().undo();
  EXPECT_TRUE(scene().display.views.empty());
}

TEST_F(Viewing, ASecondViewOfTheSameNameTakesThePlaceOfTheFirst) {
  save_view(QStringLiteral("near"));
  view().set_camera({{}, 0.4, 0.0, 0.0});
  save_view(QStringLiteral("near"));
  ASSERT_EQ(scene().display.views.size(), 1U);
  EXPECT_DOUBLE_EQ(scene().display.views.front().distance, 0.4);
  entry("forget_view", QStringLiteral("near")).trigger();
  EXPECT_TRUE(scene().display.views.empty());
}

TEST_F(Viewing, DistancesAreMeasuredFromCornerToCorner) {
  // The post's upper side: 40 mm long edges.
  view().set_camera({{0.41, 0.38, 0.2}, 0.5, geometric::radians(-60.0), geometric::radians(50.0)});
  part<QAction>("measure").trigger();
  click_view(seen({0.39, 0.36, 0.2}) + QPoint(2, 0));
  click_view(seen({0.43, 0.36, 0.2}) + QPoint(-3, -2));
  EXPECT_TRUE(measured().contains(QStringLiteral("<b>40.0 mm</b>"))) << qPrintable(measured());
  EXPECT_TRUE(measured().contains(QStringLiteral("X 40.0 mm"))) << qPrintable(measured());
  EXPECT_EQ(editor().selection().kind, Kind::kNone) << "clicks measure and select nothing";
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_FALSE(part<QAction>("measure").isChecked());
  EXPECT_FALSE(part<QWidget>("measure_card").isVisible());
}

TEST_F(Viewing, TheGapBetweenTwoBodiesIsMeasured) {
  editor().add("block", geometric::Box{{0.1, 0.1, 0.4}}, {}, {0.55, 0.38, -0.2});
  editor().select({});
  view().set_camera({{0.48, 0.38, 0.2}, 0.8, geometric::radians(-90.0), geometric::radians(60.0)});
  part<QAction>("measure").trigger();
  click_view(seen({0.41, 0.38, 0.2}));
  click_view(seen({0.55, 0.38, 0.2}));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return measured().contains(QStringLiteral("post and block: 70.0 mm")); }, kPatienceMs))
      << qPrintable(measured());
}

TEST_F(Viewing, ASectionOpensObjectsTowardsTheCameraAndLeavesRobotsWhole) {
  editor().add("wall", geometric::Box{{0.02, 2.0, 2.0}}, {}, {0.9, 0.0, -1.0});
  editor().select({Kind::kObject, "", "wall"});
  view().set_camera({{0.0, 0.0, 0.0}, 2.5, 0.0, 0.1});
  const auto hit = [&](const Eigen::Vector3d& p_W) { return view().pick_at(seen(p_W))->item; };
  ASSERT_EQ(hit({0.2, 0.0, 0.0}).name, "wall");
  part<QAction>("section").trigger();
  EXPECT_EQ(part<gui::QuantityField>("section_place").quantity(), 0.9) << "the wall's middle";
  type("section_place", "500");
  EXPECT_EQ(hit({0.15, 0.0, 0.0}).kind, Kind::kLink) << "the wall is cut away";
  part<QCheckBox>("section_side").click();
  EXPECT_EQ(hit({0.15, 0.0, 0.0}).name, "wall");
  part<QAction>("section").trigger();
  EXPECT_FALSE(part<QWidget>("section_card").isVisible());
}

TEST_F(Viewing, ASceneThatClosesItsRobotInOpensWithASection) {
  geometric::Scene closed = scene();
  geometric::SceneObject container;
  container.name = "container";
  container.shape = geometric::Box{{4.0, 4.0, 4.0}};
  closed.objects = {container};
  const std::filesystem::path file = cell().folder() / "container.yaml";
  geometric::write_scene(closed, file);
  open(file);
  EXPECT_TRUE(part<QAction>("section").isChecked());
  EXPECT_TRUE(part<QWidget>("section_card").isVisible());
  open(cell().wall());
  EXPECT_FALSE(part<QAction>("section").isChecked()) << "of that scene alone";
}

}  // namespace
}  // namespace handway::test
