#include "features/editing/editing_test.h"
#include "features/editing/properties_panel.h"
#include "features/planning/collision_display.h"
#include "features/planning/query_check.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/math/units.h"
#include "model/document/document.h"

#include <QCheckBox>
#include <QDockWidget>

namespace handway::test {
namespace {

using gui::SceneItem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ConstrainingPaths : public EditingTest {
 protected:
  // Selects it.
  void carry_post() const {
    select("post");
    editor().attach("arm", "palm", {});
  }
  void undo() const { editor().undo_stack().undo(); }
  [[nodiscard]] double angle() const {
    return geometric::degrees(
        std::get<geometric::OrientationConstraint>(scene().constraints.at(0).what).angle);
  }
};

TEST_F(ConstrainingPaths, KeepsACarriedObjectUpright) {
  select("post");
  EXPECT_FALSE(part<QCheckBox>("keep_upright").isVisible()) << "it stands still";
  carry_post();
  ASSERT_TRUE(part<QCheckBox>("keep_upright").isVisibleTo(&window()));
  part<QCheckBox>("keep_upright").click();
  ASSERT_THAT(scene().constraints, SizeIs(1));
  EXPECT_EQ(scene().constraints[0].body, "post");
  EXPECT_NEAR(angle(), 10.0, 1e-9);
  type("upright_angle", "5");
  EXPECT_NEAR(angle(), 5.0, 1e-9);
  EXPECT_TRUE(window().document().problem()->wait({})->checker->world().constraints().size() == 1);
  undo();
  EXPECT_NEAR(angle(), 10.0, 1e-9);
  part<QCheckBox>("keep_upright").click();
  EXPECT_THAT(scene().constraints, IsEmpty());
  undo();
  EXPECT_THAT(scene().constraints, SizeIs(1));
}

TEST_F(ConstrainingPaths, KeepsThePalmInARegion) {
  editor().select({SceneItem::Kind::kPalm, "", ""});
  part<QCheckBox>("keep_region").click();
  ASSERT_THAT(scene().constraints, SizeIs(1));
  EXPECT_EQ(scene().constraints[0].body, "palm");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::QueryCheck>().is_busy(); }, 8000));
  EXPECT_EQ(tool<gui::QueryCheck>().card().text(), "") << "it has room for both ends";
  type("region_position_x", "0.9 m");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::QueryCheck>().is_busy(); }, 8000));
  EXPECT_THAT(tool<gui::QueryCheck>().card().text().toStdString(),
              AllOf(HasSubstr("not valid"), HasSubstr("Violates constraint region of palm"),
                    HasSubstr("are allowed")));
  window().document().set_configuration(*scene().goal);
  auto* label = window().findChild<gui::CollisionLabel*>();
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return label->text().contains(QStringLiteral("violates constraint region of palm")); },
      8000));
}

TEST_F(ConstrainingPaths, ShowsACarriedCanWithWhatItKeeps) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  window().document().set_configuration(*scene().goal);
  select("can");
  editor().attach("tx90_sah", "palm", {});
  editor().set_start(*scene().goal);
  part<QCheckBox>("keep_upright").click();
  part<QCheckBox>("keep_region").click();
  ASSERT_THAT(scene().constraints, SizeIs(2));
  const auto& upright =
      std::get<geometric::OrientationConstraint>(scene().constraints.front().what);
  EXPECT_EQ(upright.axis, Eigen::Vector3d(Eigen::Vector3d::UnitZ())) << "the can stands";
  window().resize(1440, 900);
  window().resizeDocks({window().findChild<QDockWidget*>("properties")}, {290}, Qt::Horizontal);
  QTest::qWait(100);
  window().findChild<gui::PropertiesPanel*>()->ensureWidgetVisible(&part<QCheckBox>("keep_region"));
  keep_picture("constraints");
}

TEST_F(ConstrainingPaths, CarriesAConstraintAlongWithItsObject) {
  carry_post();
  part<QCheckBox>("keep_upright").click();
  editor().rename("can");
  ASSERT_THAT(scene().constraints, SizeIs(1));
  EXPECT_EQ(scene().constraints[0].body, "can");
  const auto file = cell().folder() / "kept.yaml";
  geometric::write_scene(scene(), file);
  EXPECT_EQ(geometric::read_scene(file).constraints.at(0).body, "can");
  editor().detach();
  EXPECT_THAT(scene().constraints, IsEmpty());
  undo();
  EXPECT_THAT(scene().constraints, SizeIs(1));
  editor().remove();
  EXPECT_THAT(scene().constraints, IsEmpty());
  undo();
  EXPECT_THAT(scene().constraints, SizeIs(1));
}

}  // namespace
}  // namespace handway::test
