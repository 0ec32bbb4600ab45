/// Tests what users do with the pointer, besides clicking: menus, dragging with numbers, drag and
/// drop.
#include "features/editing/editing_test.h"
#include "features/editing/mesh_import.h"
#include "features/editing/scene_tree.h"
#include "handway/geometric/formats/obj_writer.h"
#include "handway/planning/edits/arranging.h"
#include "patience.h"
#include "pressed_mouse.h"
#include "widgets/style/menu_text.h"

#include <QClipboard>
#include <QComboBox>
#include <QDropEvent>
#include <QGuiApplication>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QTimer>

#include <algorithm>
#include <string>

namespace handway::test {
namespace {

using gui::SceneItem;
using Kind = SceneItem::Kind;

class Pointing : public EditingTest {
 protected:
  [[nodiscard]] gui::SceneView& view() const { return window().view(); }
  [[nodiscard]] gui::SceneTree& tree() const { return tool<gui::SceneTree>(); }
  [[nodiscard]] QTreeWidgetItem& row(const char* text) const {
    return *tree().findItems(QLatin1String(text), Qt::MatchExactly | Qt::MatchRecursive).front();
  }
  /// Returns the entries of the open menu, and closes it.
  [[nodiscard]] QStringList offered() const {
    QStringList texts;
    if (auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget())) {
      for (const QAction* action : menu->actions()) {
        texts << action->text().remove(QLatin1Char('&'));
      }
      menu->close();
    }
    return texts;
  }
  /// Grabs an arrow of the gizmo.
  void hold_arrow(int axis) const {
    QTest::qWait(50);
    const gui::GizmoFrame frame = view().gizmo().frame(view().camera(), view().size());
    const QPoint tip = seen(frame.centre + 0.9 * frame.size * frame.axes.col(axis));
    QTest::mousePress(&view(), Qt::LeftButton, {}, tip);
    ASSERT_TRUE(view().gizmo().is_dragging());
  }
  void drag_with_shift(const QPoint& to) const {
    QMouseEvent move(QEvent::MouseMove, to, view().mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                     Qt::ShiftModifier);
    QCoreApplication::sendEvent(&view(), &move);
  }
  /// Drops rows there, as if dragged.
  void drop(const char* names, QWidget& onto, const QPoint& place) const {
    QMimeData data;
    data.setData(QLatin1String(gui::SceneTree::kDraggedObjects), names);
    QDragEnterEvent enter(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&onto, &enter);
    QDragMoveEvent over(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&onto, &over);
    EXPECT_TRUE(over.isAccepted());
    QDropEvent event(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&onto, &event);
    EXPECT_TRUE(event.isAccepted());
  }
  void drop_on_row(const char* names, const char* text) const {
    tree().scrollToItem(&row(text));
    drop(names, *tree().viewport(), tree().visualItemRect(&row(text)).center());
  }
};

TEST_F(Pointing, TheRightButtonSelectsAndOffersWhatCanBeDone) {
  QGuiApplication::clipboard()->setText(QStringLiteral("objects: []"));
  QTest::mouseClick(&view(), Qt::RightButton, {}, seen({0.41, 0.38, 0.15}));
  EXPECT_EQ(editor().selection(), (SceneItem{Kind::kObject, "", "post"}));
  const QStringList of_an_object = offered();
  for (const char* command :
       {"Cut", "Copy", "Paste", "Rename", "Duplicate", "Delete", "Hide", "Lock",
        "Attach to the palm", "Grasp…", "Set goal here", "Show all", "Show selection"}) {
    EXPECT_TRUE(of_an_object.contains(QString::fromUtf8(command))) << command;
  }
  EXPECT_FALSE(of_an_object.contains(QStringLiteral("Detach")));
  QTest::mouseClick(&view(), Qt::RightButton, {}, QPoint(4, 4));
  const QStringList of_nothing = offered();
  EXPECT_TRUE(of_nothing.contains(QStringLiteral("Paste")));
  EXPECT_FALSE(of_nothing.contains(QStringLiteral("Delete")));
  EXPECT_EQ(editor().selection().kind, Kind::kNone);
}

TEST_F(Pointing, TheMenuKeyOffersTheSame) {
  select("post");
  QContextMenuEvent event(QContextMenuEvent::Keyboard, {}, {});
  QCoreApplication::sendEvent(&view(), &event);
  EXPECT_TRUE(offered().contains(QStringLiteral("Duplicate")));
  emit tree().customContextMenuRequested({5, 5});
  EXPECT_TRUE(offered().contains(QStringLiteral("Duplicate")));
}

TEST_F(Pointing, TheRightButtonStillZooms) {
  const double before = view().camera().placement().distance;
  QTest::mousePress(&view(), Qt::RightButton, {}, {100, 100});
  QMouseEvent move(QEvent::MouseMove, {100, 200}, view().mapToGlobal(QPoint(100, 200)),
                   Qt::NoButton, Qt::RightButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&view(), &move);
  QTest::mouseRelease(&view(), Qt::RightButton, {}, {100, 200});
  EXPECT_NE(view().camera().placement().distance, before);
  EXPECT_TRUE(offered().empty());
}

TEST_F(Pointing, ANumberIsTypedInPlaceOfADrag) {
  select("post");
  const Eigen::Vector3d from = object("post").X_PO.translation();
  hold_arrow(2);
  QTest::keyClicks(&view(), QStringLiteral("-35.5"));
  EXPECT_EQ(view().gizmo().amount(), QStringLiteral("Z -35.5_ mm"));
  move_pressed_mouse(view(), QPoint(30, 30));
  QTest::keyClick(&view(), Qt::Key_Backspace);
  QTest::keyClick(&view(), Qt::Key_5);
  QTest::keyClick(&view(), Qt::Key_Return);
  EXPECT_TRUE(
      object("post").X_PO.translation().isApprox(from + Eigen::Vector3d(0.0, 0.0, -0.0355), 1e-12));
  EXPECT_EQ(editor().undo_stack().undoText(), QStringLiteral("Move post"));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, QPoint(30, 30));
  EXPECT_EQ(editor().selection().name, "post") << "letting go is no click";
  EXPECT_EQ(editor().undo_stack().count(), 1);
}

TEST_F(Pointing, TypedNumbersAreTakenBackByEscape) {
  select("post");
  hold_arrow(0);
  QTest::keyClicks(&view(), QStringLiteral("200"));
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_FALSE(view().gizmo().is_dragging());
  EXPECT_EQ(editor().undo_stack().count(), 0);
}

TEST_F(Pointing, ADragWithShiftStopsBesideOtherSides) {
  editor().add("block", geometric::Box{{0.2, 0.2, 0.2}}, {}, {-0.4, 0.4, 0.0});
  editor().add("brick", geometric::Box{{0.1, 0.1, 0.1}}, {}, {-0.4, 0.63, 0.0});
  hold_arrow(1);
  const gui::GizmoFrame frame = view().gizmo().frame(view().camera(), view().size());
  // 80 mm back are 4 mm from the block's side.
  const Eigen::Vector3d held = frame.centre + 0.9 * frame.size * Eigen::Vector3d::UnitY();
  drag_with_shift(seen(held - Eigen::Vector3d(0.0, 0.076, 0.0)));
  QTest::keyClick(&view(), Qt::Key_Return);
  EXPECT_NEAR(object("brick").X_PO.translation().y(), 0.4 + 0.1 + 0.05 + geometric::kRestingGap,
              1e-9);
}

TEST_F(Pointing, RowsAreDraggedOntoLinksIntoGroupsAndOut) {
  editor().add("can", geometric::Cylinder{0.03, 0.12}, {}, {-0.5, -0.5, 0.0});
  editor().add("lid", geometric::Cylinder{0.03, 0.01}, {}, {-0.5, -0.5, 0.13});
  editor().select_objects({"can", "lid"});
  part<QAction>("group").trigger();
  drop_on_row("post\n", "group");
  EXPECT_EQ(display("post").group, "group");
  EXPECT_EQ(editor().undo_stack().undoText(), QStringLiteral("Put post into group"));
  drop_on_row("post\nlid\n", "Objects");
  EXPECT_EQ(display("post").group, "");
  EXPECT_EQ(display("can").group, "group");
  drop_on_row("can\n", "palm");
  EXPECT_EQ(object("can").attachment->link, "palm");
  EXPECT_EQ(tree().findItems(QStringLiteral("can"), Qt::MatchExactly | Qt::MatchRecursive).size(),
            1);
}

TEST_F(Pointing, RowsAreDraggedIntoTheView) {
  editor().add("table", geometric::Box{{0.5, 0.5, 0.1}}, {}, {-0.5, 0.4, 0.0});
  const QPoint place = seen({-0.5, 0.4, 0.1});
  const Eigen::Vector3d there = view().pick_at(place)->point;
  drop("post\n", view(), place);
  const Eigen::Vector3d at = object("post").X_PO.translation();
  EXPECT_LT((at - there).head<2>().norm(), 0.004);
  EXPECT_NEAR(at.z() - 0.2, 0.1 + geometric::kRestingGap, 1e-6) << "it stands on the table";
  EXPECT_EQ(editor().undo_stack().undoText(), QStringLiteral("Move post"));
}

TEST_F(Pointing, NamesWithPercentSignsAndAmpersandsAreShownAsTheyAre) {
  editor().add("lid", geometric::Cylinder{0.03, 0.01}, {}, {-0.5, -0.5, 0.13});
  editor().move_into_group({"post", "lid"}, "R%2 & co");
  const auto rows =
      tree().findItems(QStringLiteral("R%2 & co"), Qt::MatchExactly | Qt::MatchRecursive);
  ASSERT_EQ(rows.size(), 1);
  EXPECT_EQ(rows.front()->toolTip(0), QStringLiteral("R%2 & co: group of 2 objects"));
  EXPECT_EQ(gui::menu_text(std::string("R%2 & co")), QStringLiteral("R%2 && co"));
}

TEST_F(Pointing, AMeshSaysItsUnitAndWhatIsUpwards) {
  // A slab of 200 x 300 x 100 mm, in millimetres, on its y side.
  const std::filesystem::path file = cell().folder() / "slab.obj";
  geometric::write_obj(*geometric::tessellate(geometric::Box{{200.0, 300.0, 100.0}}), file);
  QString size_as_guessed;
  QTimer::singleShot(200, [&] {
    auto* dialog = qobject_cast<gui::MeshImportDialog*>(QApplication::activeModalWidget());
    if (!dialog) {
      return;
    }
    const auto size = [&] {
      return dialog->findChild<QLabel*>(QStringLiteral("mesh_size"))->text();
    };
    size_as_guessed = size();
    dialog->findChild<QComboBox*>(QStringLiteral("mesh_unit"))->setCurrentIndex(1);
    EXPECT_EQ(size(), QString::fromUtf8("2000 × 3000 × 1000 mm, 1000 mm high"));
    dialog->findChild<QComboBox*>(QStringLiteral("mesh_unit"))->setCurrentIndex(2);
    dialog->findChild<QComboBox*>(QStringLiteral("mesh_up"))->setCurrentIndex(1);
    EXPECT_EQ(size(), QString::fromUtf8("100 × 200 × 300 mm, 300 mm high"));
    dialog->findChild<QPushButton*>(QStringLiteral("mesh_add"))->click();
  });
  emit window().workbench().mesh_dropped(QString::fromStdString(file.string()));
  EXPECT_EQ(size_as_guessed, QString::fromUtf8("200 × 300 × 100 mm, 100 mm high"));
  const Eigen::Vector3d extent =
      geometric::bounds(scene(), window().document().configuration(), {"slab"}).size();
  EXPECT_TRUE(extent.isApprox(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-6));
  EXPECT_TRUE(std::get<geometric::Mesh>(object("slab").shape)
                  .scale.isApprox(Eigen::Vector3d::Constant(1e-3)));
}

TEST_F(Pointing, NewObjectsHaveColoursOfTheirOwn) {
  const auto add = [&](const char* shape) {
    part<QAction>(shape).trigger();
    return scene().objects.back().color;
  };
  const geometric::Color first = add("box");
  const geometric::Color second = add("box");
  EXPECT_NE(first, second);
  EXPECT_NE(add("cylinder"), second);
  editor().undo_stack().undo();
  editor().undo_stack().undo();
  EXPECT_EQ(add("sphere"), second) << "what was undone takes no colour";
}

/// A small block beside a low table, in an empty corner of the floor.
class Carrying : public Pointing {
 protected:
  void SetUp() override {
    Pointing::SetUp();
    if (!IsSkipped()) {
      view().show_ghosts(false, false);
      editor().add("table", geometric::Box{{0.4, 0.4, 0.1}}, {}, {-0.5, -0.3, 0.0});
      editor().add("block", geometric::Box{{0.06, 0.06, 0.06}}, {}, {-0.1, -0.5, 0.0});
      view().look_from(gui::StandardView::kOblique);
      QTest::qWait(400);
      select("block");
      QTest::qWait(50);
    }
  }
  [[nodiscard]] Eigen::Vector3d place() const { return object("block").X_PO.translation(); }
  /// Presses on a side of the block that is seen, beside the handles.
  [[nodiscard]] QPoint press() const {
    for (const double x : {-0.028, 0.028}) {
      for (const double y : {-0.028, 0.028}) {
        for (const double z : {-0.028, 0.028}) {
          const QPoint corner = seen(place() + Eigen::Vector3d(x, y, z));
          QTest::mousePress(&view(), Qt::LeftButton, {}, corner);
          if (view().gizmo().is_carrying()) {
            return corner;
          }
          QTest::mouseRelease(&view(), Qt::LeftButton, {}, corner);
          select("block");
        }
      }
    }
    ADD_FAILURE() << "the block can't be grabbed";
    return {};
  }
};

TEST_F(Carrying, MovesTheBodyAlongTheFloorAndOntoWhatIsUnderThePointer) {
  const Eigen::Vector3d before = place();
  const QPoint from = press();
  const QPoint over_floor = from + seen({0.1, -0.6, 0.0}) - seen({-0.1, -0.5, 0.0});
  move_pressed_mouse(view(), over_floor);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, over_floor);
  EXPECT_NEAR(place().x(), before.x() + 0.2, 0.03);
  EXPECT_NEAR(place().y(), before.y() - 0.1, 0.03);
  EXPECT_NEAR(place().z(), 0.03, 1e-4) << "it stands on the floor";
  EXPECT_EQ(editor().undo_stack().undoText(), "Move block");

  static_cast<void>(press());
  const QPoint over_table = seen({-0.5, -0.3, 0.1});
  move_pressed_mouse(view(), over_table);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, over_table);
  EXPECT_NEAR(place().x(), -0.5, 0.06);
  EXPECT_NEAR(place().y(), -0.3, 0.06);
  EXPECT_NEAR(place().z(), 0.13 + geometric::kRestingGap, 1e-4) << "it stands on the table";
}

TEST_F(Carrying, IsAClickWhereThePointerStays) {
  const int edits = editor().undo_stack().count();
  const QPoint from = press();
  move_pressed_mouse(view(), from + QPoint(1, 1));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from + QPoint(1, 1));
  EXPECT_EQ(editor().undo_stack().count(), edits);
  EXPECT_EQ(editor().selection(), (SceneItem{Kind::kObject, "", "block"}));
  EXPECT_FALSE(view().gizmo().is_dragging());
}

TEST_F(Carrying, LeavesLockedAndUnselectedBodiesWhereTheyAre) {
  select("table");
  QTest::mousePress(&view(), Qt::LeftButton, {}, seen(place()));
  EXPECT_FALSE(view().gizmo().is_carrying()) << "the view is turned";
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, seen(place()));
  editor().set_locked({"table"}, true);
  select("table");
  QTest::qWait(50);
  QTest::mousePress(&view(), Qt::LeftButton, {}, seen({-0.5, -0.3, 0.1}));
  EXPECT_FALSE(view().gizmo().is_dragging());
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, seen({-0.5, -0.3, 0.1}));
}

TEST_F(Carrying, SaysAtOnceWhatTheBodyOverlaps) {
  editor().put_at({"block"}, {-0.5, -0.3, 0.1});
  hold_arrow(2);
  const gui::GizmoFrame frame = view().gizmo().frame(view().camera(), view().size());
  const QPoint lower =
      seen(frame.centre + 0.9 * frame.size * frame.axes.col(2) - Eigen::Vector3d(0.0, 0.0, 0.02));
  move_pressed_mouse(view(), lower);
  EXPECT_TRUE(view().note().contains("overlaps table")) << view().note().toStdString();
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, lower);
}

TEST_F(Pointing, NewObjectsGoOnTopOfFurnitureAndNeverBelowIt) {
  editor().add("board", geometric::Box{{0.8, 0.8, 0.04}}, {}, {-0.7, 0.0, 0.5});
  editor().select({});
  gui::OrbitCamera::Placement low = view().camera().placement();
  low.target = {-0.7, 0.0, 0.0};
  low.elevation = 0.1;
  low.distance = 2.5;
  view().set_camera(low);
  EXPECT_NEAR(view().place_for_new().z(), 0.54, 1e-4) << "the floor is seen below the board";
  low.target.z() = 0.52;
  low.elevation = 0.02;
  view().set_camera(low);
  EXPECT_NEAR(view().place_for_new().z(), 0.54, 1e-4) << "its side is seen";
  low.elevation = 0.9;
  view().set_camera(low);
  EXPECT_NEAR(view().place_for_new().z(), 0.54, 1e-4) << "its upper side is seen";
  low.target = {-2.0, -2.0, 0.0};
  view().set_camera(low);
  EXPECT_NEAR(view().place_for_new().z(), 0.0, 1e-4) << "the floor is free";
}

}  // namespace
}  // namespace handway::test
