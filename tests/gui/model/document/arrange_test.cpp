#include "features/editing/array_tool.h"
#include "features/editing/editing_test.h"
#include "features/editing/scene_tree.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/planning/edits/arranging.h"
#include "pressed_mouse.h"
#include "view3d/scene_view.h"
#include "widgets/forms/quantity_field.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>

#include <cmath>
#include <numbers>

namespace handway::test {
namespace {

using gui::SceneItem;
using planning::SceneState;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;
using Kind = SceneItem::Kind;
using Names = std::vector<std::string>;

/// Three boxes of 40, 60 and 80 mm on the floor, besides the post.
class ArrangingObjects : public EditingTest {
 protected:
  void SetUp() override {
    EditingTest::SetUp();
    if (!IsSkipped()) {
      add("a", 0.04, {0.5, -0.3, 0.0});
      add("b", 0.06, {0.62, -0.45, 0.0});
      add("c", 0.08, {0.9, -0.2, 0.0});
      before_ = editor().state();
      count_ = editor().undo_stack().count();
    }
  }
  void add(const char* name, double size, const Eigen::Vector3d& foot) const {
    editor().add(name, geometric::Box{Eigen::Vector3d::Constant(size)}, {}, foot);
  }
  [[nodiscard]] Eigen::Vector3d place(const char* name) const {
    return object(name).X_PO.translation();
  }
  [[nodiscard]] QTreeWidgetItem* row(const char* text) const {
    const auto rows = tree().findItems(QLatin1String(text), Qt::MatchExactly | Qt::MatchRecursive);
    if (!rows.isEmpty()) {
      return rows.front();
    }
    throw std::runtime_error(std::string("no row called ") + text);
  }
  void click_row(const char* text, Qt::KeyboardModifiers keys = {}) const {
    tree().scrollToItem(row(text));
    QTest::mouseClick(tree().viewport(), Qt::LeftButton, keys,
                      tree().visualItemRect(row(text)).center());
  }
  [[nodiscard]] gui::SceneTree& tree() const { return *window().findChild<gui::SceneTree*>(); }
  void trigger(const char* menu_text) const {
    for (QAction* action : window().findChildren<QAction*>()) {
      if (action->text().remove(QLatin1Char('&')) == QString::fromUtf8(menu_text)) {
        action->trigger();
        return;
      }
    }
    FAIL() << "no command called " << menu_text;
  }
  /// One edit was made; undoing it leaves the scene from before itself.
  void expect_one_edit(const char* text) const {
    EXPECT_EQ(editor().undo_stack().count(), count_ + 1);
    EXPECT_EQ(editor().undo_stack().undoText(), text);
    editor().undo_stack().undo();
    EXPECT_EQ(editor().state(), before_);
    editor().undo_stack().redo();
  }

  planning::SceneState before_;
  int count_ = 0;
};

TEST_F(ArrangingObjects, SelectsSeveralInTheTree) {
  click_row("a");
  click_row("c", Qt::ControlModifier);
  EXPECT_THAT(editor().selected_objects(), ElementsAre("a", "c"));
  EXPECT_EQ(part<QLineEdit>("object_name").text(), "2 objects");
  EXPECT_EQ(part<QLabel>("extent").text(), "460.0 × 160.0 × 80.0 mm together");
  click_row("a", Qt::ControlModifier);
  EXPECT_THAT(editor().selected_objects(), ElementsAre("c"));
  click_row("a");
  click_row("c", Qt::ShiftModifier);
  EXPECT_THAT(editor().selected_objects(), UnorderedElementsAre("a", "b", "c"));
  keep_picture("several_objects");
}

TEST_F(ArrangingObjects, SelectsSeveralInTheView) {
  QWidget& view = window().view();
  const auto middle = [&](const char* name) { return seen(place(name)); };
  QTest::mouseClick(&view, Qt::LeftButton, {}, middle("a"));
  QTest::mouseClick(&view, Qt::LeftButton, Qt::ControlModifier, middle("c"));
  EXPECT_THAT(editor().selected_objects(), ElementsAre("a", "c"));
  QTest::mouseClick(&view, Qt::LeftButton, Qt::ShiftModifier, middle("a"));
  EXPECT_THAT(editor().selected_objects(), ElementsAre("c"));
  QTest::mouseClick(&view, Qt::LeftButton, Qt::ControlModifier, QPoint(4, 4));
  EXPECT_THAT(editor().selected_objects(), ElementsAre("c")) << "a miss takes nothing away";
  QTest::mouseClick(&view, Qt::LeftButton, {}, QPoint(4, 4));
  EXPECT_TRUE(editor().selected_objects().empty());
}

TEST_F(ArrangingObjects, MovesAndTurnsThemTogether) {
  editor().select_objects({"a", "b"});
  geometric::Pose X = editor().selected_pose().value();
  EXPECT_TRUE(X.translation().isApprox(Eigen::Vector3d(0.565, -0.38, 0.03), 1e-9));
  X.translation().z() += 0.1;
  X.linear() = Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()).matrix();
  editor().place(X);
  EXPECT_TRUE(place("a").isApprox(Eigen::Vector3d(0.485, -0.445, 0.12), 1e-9));
  EXPECT_TRUE(place("b").isApprox(Eigen::Vector3d(0.635, -0.325, 0.13), 1e-9));
  EXPECT_EQ(object("c").X_PO.matrix(), before_.find("c")->X_PO.matrix());
  expect_one_edit("Move 2 objects");
}

TEST_F(ArrangingObjects, DragsThemTogether) {
  editor().select_objects({"a", "b", "c"});
  QTest::qWait(50);
  gui::SceneView& view = window().view();
  const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
  const QPoint tip = seen(frame.centre + 0.9 * frame.size * frame.axes.col(2));
  const QPoint farther = seen(frame.centre + 1.9 * frame.size * frame.axes.col(2));
  QTest::mousePress(&view, Qt::LeftButton, {}, tip);
  ASSERT_TRUE(view.gizmo().is_dragging());
  move_pressed_mouse(view, farther);
  QTest::mouseRelease(&view, Qt::LeftButton, {}, farther);
  const double lifted = place("a").z() - before_.find("a")->X_PO.translation().z();
  EXPECT_NEAR(lifted, frame.size, 0.05 * frame.size);
  for (const char* name : {"b", "c"}) {
    const Eigen::Vector3d moved = place(name) - before_.find(name)->X_PO.translation();
    EXPECT_TRUE(moved.isApprox(Eigen::Vector3d(0.0, 0.0, lifted), 1e-9)) << name;
  }
  expect_one_edit("Move 3 objects");
}

TEST_F(ArrangingObjects, LeavesLockedOnesAlone) {
  editor().set_locked({"b"}, true);
  editor().select_objects({"a", "b", "c"});
  editor().remove();
  EXPECT_FALSE(editor().state().find("a"));
  EXPECT_TRUE(editor().state().find("b"));
  EXPECT_EQ(editor().undo_stack().undoText(), "Delete 2 objects");
}

TEST_F(ArrangingObjects, AlignsThemToTheOneSelectedLast) {
  editor().select_objects({"a", "b", "c"});
  trigger("X: lower sides");
  EXPECT_NEAR(place("a").x(), 0.86 + 0.02, 1e-12);
  EXPECT_NEAR(place("b").x(), 0.86 + 0.03, 1e-12);
  EXPECT_EQ(place("c").x(), 0.9);
  EXPECT_EQ(place("a").y(), -0.3);
  expect_one_edit("Align 3 objects along X");
  trigger("Y: centres");
  EXPECT_NEAR(place("a").y(), -0.2, 1e-12);
  trigger("Z: upper sides");
  EXPECT_NEAR(place("b").z(), 0.08 - 0.03, 1e-12);
}

TEST_F(ArrangingObjects, DistributesWithEqualGaps) {
  editor().select_objects({"c", "a", "b"});
  trigger("Along X");
  const double gap = (0.94 - 0.48 - 0.04 - 0.06 - 0.08) / 2.0;
  EXPECT_EQ(place("a").x(), 0.5);
  EXPECT_NEAR(place("b").x(), 0.52 + gap + 0.03, 1e-12);
  EXPECT_EQ(place("c").x(), 0.9);
  expect_one_edit("Distribute 3 objects along X");
}

TEST_F(ArrangingObjects, DuplicatesHidesAndLocksThemInOneEditEach) {
  editor().select_objects({"a", "b"});
  actions().duplicate->trigger();
  EXPECT_THAT(editor().selected_objects(), ElementsAre("a 2", "b 2"));
  expect_one_edit("Duplicate 2 objects");
  actions().hide->trigger();
  EXPECT_EQ(editor().undo_stack().undoText(), "Hide 2 objects");
  EXPECT_TRUE(display("b 2").hidden);
  actions().lock->trigger();
  EXPECT_EQ(editor().undo_stack().undoText(), "Lock 2 objects");
  EXPECT_FALSE(window().view().gizmo().is_shown());
}

TEST_F(ArrangingObjects, DropsThemOneOnTheOther) {
  editor().select_objects({"a"});
  editor().place(geometric::Pose(Eigen::Translation3d(0.9, -0.2, 0.4)));
  editor().select_objects({"c", "a"});
  editor().place(geometric::Pose(Eigen::Translation3d(editor().selected_pose()->translation() +
                                                      Eigen::Vector3d(0.0, 0.0, 0.5))));
  actions().drop->trigger();
  EXPECT_NEAR(place("c").z(), 0.04, 1e-9);
  EXPECT_NEAR(place("a").z(), 0.10 + geometric::kRestingGap, 1e-9);
}

TEST_F(ArrangingObjects, KeepsAGroupTogether) {
  editor().select_objects({"a", "b"});
  trigger("Group");
  expect_one_edit("Group 2 objects");
  EXPECT_TRUE(row("group")->isSelected());
  EXPECT_EQ(row("a")->parent(), row("group"));
  editor().select({});
  QTest::mouseClick(&window().view(), Qt::LeftButton, {}, seen(place("a")));
  EXPECT_THAT(editor().selected_objects(), UnorderedElementsAre("a", "b"));
  keep_picture("group");
  editor().click({Kind::kObject, "", "a"}, false);
  EXPECT_THAT(editor().selected_objects(), ElementsAre("a")) << "a second click takes it alone";
  click_row("group");
  EXPECT_THAT(editor().selected_objects(), UnorderedElementsAre("a", "b"));
  row("group")->setText(0, "pair");
  ASSERT_TRUE(QTest::qWaitFor([&] { return display("a").group == "pair"; }));
  EXPECT_EQ(display("b").group, "pair");
  actions().duplicate->trigger();
  EXPECT_EQ(display("a 2").group, "pair 2");
  editor().select_objects({"a", "b", "c"});
  trigger("Y: centres");
  EXPECT_NEAR((place("a") - place("b")).y(), 0.15, 1e-12) << "aligned as one";
  EXPECT_NEAR(
      geometric::bounds(scene(), window().document().configuration(), {"a", "b"}).centre().y(),
      -0.2, 1e-12);
  trigger("Ungroup");
  EXPECT_EQ(display("a").group, "");
}

TEST_F(ArrangingObjects, SavesGroupsAndWhatIsHiddenOrLocked) {
  editor().select_objects({"a", "b"});
  trigger("Group");
  editor().set_hidden({"a"}, true);
  editor().set_locked({"c"}, true);
  window().document().save(cell().folder() / "arranged.yaml", {});
  const geometric::Scene read = geometric::read_scene(cell().folder() / "arranged.yaml");
  EXPECT_EQ(read.display.of("b").group, "group");
  EXPECT_TRUE(read.display.of("a").hidden);
  EXPECT_TRUE(read.display.of("c").locked);
  editor().undo_stack().setClean();
  open(cell().folder() / "arranged.yaml");
  EXPECT_EQ(row("a")->checkState(0), Qt::Unchecked);
  EXPECT_EQ(row("group")->checkState(0), Qt::PartiallyChecked);
  row("group")->setCheckState(0, Qt::Checked);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !display("a").hidden; }));
}

TEST_F(ArrangingObjects, ShowsCopiesInRowsWhileTheyAreSetUp) {
  editor().select_objects({"a"});
  trigger("Array…");
  auto& card = part<gui::ArrayCard>("array_card");
  ASSERT_TRUE(card.isVisible());
  part<QSpinBox>("array_count_x").setValue(3);
  part<QSpinBox>("array_count_z").setValue(2);
  part<gui::QuantityField>("array_spacing_x").setValue(50.0);
  EXPECT_EQ(editor().state(), before_) << "only shown";
  EXPECT_TRUE(card.isVisible());
  keep_picture("array_in_rows");
  click("array_make");
  EXPECT_FALSE(card.isVisible());
  ASSERT_EQ(scene().objects.size(), 4U + 5U);
  EXPECT_TRUE(place("a 2").isApprox(Eigen::Vector3d(0.55, -0.3, 0.02), 1e-9));
  EXPECT_EQ(editor().selected_objects().size(), 6U);
  expect_one_edit("Array of a");
}

TEST_F(ArrangingObjects, PutsCopiesAroundAnAxis) {
  editor().select_objects({"a"});
  trigger("Array…");
  part<QComboBox>("array_kind").setCurrentIndex(1);
  part<QSpinBox>("array_around").setValue(4);
  part<QAbstractButton>("array_group").setChecked(true);
  for (const char* field : {"array_centre_x", "array_centre_y"}) {
    part<gui::QuantityField>(field).setValue(0.0);
  }
  keep_picture("array_around");
  click("array_make");
  EXPECT_TRUE(place("a 2").isApprox(Eigen::Vector3d(0.3, 0.5, 0.02), 1e-9));
  EXPECT_TRUE(place("a 3").isApprox(Eigen::Vector3d(-0.5, 0.3, 0.02), 1e-9));
  EXPECT_EQ(display("a 4").group, "a");
  expect_one_edit("Array of a");
}

TEST_F(ArrangingObjects, MakesNoCopiesOnEscape) {
  editor().select_objects({"a"});
  trigger("Array…");
  QTest::keyClick(&part<QSpinBox>("array_count_x"), Qt::Key_Escape);
  EXPECT_FALSE(part<gui::ArrayCard>("array_card").isVisible());
  EXPECT_EQ(editor().state(), before_);
}

TEST_F(ArrangingObjects, RefusesTooManyCopies) {
  editor().select_objects({"a"});
  trigger("Array…");
  for (const char* count : {"array_count_x", "array_count_y", "array_count_z"}) {
    part<QSpinBox>(count).setValue(20);
  }
  EXPECT_FALSE(part<QAbstractButton>("array_make").isEnabled());
}

}  // namespace
}  // namespace handway::test
