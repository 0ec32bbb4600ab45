/// Tests that every edit with the mouse, in any dock, is one entry of one history.
#include "features/editing/scene_tree.h"
#include "features/glove/glove_panel.h"
#include "features/glove/mapping_editor.h"
#include "features/glove/mapping_wires.h"
#include "hands_on.h"
#include "handway/device/glove/glove_layout.h"
#include "pressed_mouse.h"
#include "view3d/view_gizmo.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QListView>
#include <QMenu>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>
#include <QUndoStack>
#include <QUndoView>

#include <sstream>
#include <vector>

namespace handway::test {
namespace {

class OneHistory : public HandsOn {
 protected:
  /// Returns the edited state of the scene, of the planner's settings and of the glove's mapping.
  [[nodiscard]] std::string all_that_is_edited() const {
    std::ostringstream all;
    all << written();
    const gui::PlanChoices choices = window().workbench().plan_settings.choices();
    all << choices.planner.name << ' ' << choices.request.seed;
    for (const auto& [key, value] : choices.planner.settings) {
      all << ' ' << key << '=' << value;
    }
    for (const device::JointMapping& mapped : glove().session().mapping().joints) {
      all << ' ' << mapped.joint << '=' << mapped.sensor << '*' << mapped.gain;
    }
    return all.str();
  }
  [[nodiscard]] gui::GlovePanel& glove() const { return *window().findChild<gui::GlovePanel*>(); }
  [[nodiscard]] const QUndoStack& history() const { return editor().undo_stack(); }

  /// Fails unless what was done since the last call is one entry more, of these words.
  void expect_entry(const char* words) {
    const int entries = static_cast<int>(states_.size());
    ASSERT_TRUE(wait_for([&] { return history().count() >= entries; })) << words;
    QTest::qWait(30);  // there shall be no other
    ASSERT_EQ(history().count(), entries)
        << words << " after " << history().undoText().toStdString();
    EXPECT_EQ(history().undoText().toStdString(), words);
    states_.push_back(all_that_is_edited());
    EXPECT_NE(states_.back(), states_[states_.size() - 2]) << words;
  }

  void choose_in(const char* box, const QString& text) const {
    auto& choices = part<QComboBox>(box);
    click(choices);
    ASSERT_TRUE(wait_for([&] { return choices.view()->isVisible(); }));
    const int row = choices.findText(text);
    ASSERT_GE(row, 0) << text.toStdString();
    const QModelIndex index = choices.model()->index(row, choices.modelColumn());
    // A release soon after the list has opened does not choose yet.
    ASSERT_TRUE(wait_for([&] {
      choices.view()->scrollTo(index);
      click(*choices.view()->viewport(), choices.view()->visualRect(index).center());
      return !choices.view()->isVisible();
    }));
  }
  void choose_in_menu_of(const char* button, const char* words) const {
    auto& opens = part<QPushButton>(button);
    QMenu& menu = *opens.menu();
    QTimer watch;  // the open menu has an event loop of its own
    QObject::connect(&watch, &QTimer::timeout, &watch, [&] {
      if (menu.isVisible()) {
        watch.stop();
        click(menu, menu.actionGeometry(&entry(menu, words)).center());
      }
    });
    watch.start(20);
    click(opens);
    ASSERT_TRUE(wait_for([&] { return !watch.isActive() && !menu.isVisible(); }));
  }
  void click_in_tree(const char* title) const {
    auto& tree = *window().findChild<gui::SceneTree*>();
    const QList<QTreeWidgetItem*> rows =
        tree.findItems(QString::fromUtf8(title), Qt::MatchExactly | Qt::MatchRecursive);
    ASSERT_EQ(rows.size(), 1) << title;
    tree.scrollToItem(rows.front());
    click(*tree.viewport(), tree.visualItemRect(rows.front()).center());
  }
  void pull_up(double part_of_arrow) const {
    gui::SceneView& view = window().view();
    ASSERT_TRUE(wait_for([&] { return view.gizmo().is_shown(); }));
    const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
    const auto along_arrow = [&](double part) {
      const Eigen::Vector3d p_W = frame.centre + part * frame.size * frame.axes.col(2);
      return gui::place_of(view.camera(), view.size(), p_W).toPoint();
    };
    QTest::mousePress(&view, Qt::LeftButton, {}, along_arrow(0.9));
    ASSERT_TRUE(view.gizmo().is_dragging());
    move_pressed_mouse(view, along_arrow(0.9 + part_of_arrow));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, along_arrow(0.9 + part_of_arrow));
  }
  void show_glove_page(const char* title) const {
    choose_tab("Glove");
    auto& pages = part<QTabBar>("glove_pages");
    for (int i = 0; i < pages.count(); ++i) {
      if (pages.tabText(i) == QLatin1String(title)) {
        click(pages, pages.tabRect(i).center());
      }
    }
  }

  void ask_planner();
  void set_goals();
  void constrain();
  void map_glove();
  void use_basis();

  std::vector<std::string> states_;
};

void OneHistory::ask_planner() {
  choose_in("planners", QStringLiteral("rrt-connect"));
  ASSERT_NO_FATAL_FAILURE(expect_entry("Plan with rrt-connect"));
  type_into("seed", "17");
  ASSERT_NO_FATAL_FAILURE(expect_entry("Set seed"));
  type_into("range", "0.35");
  ASSERT_NO_FATAL_FAILURE(expect_entry("Set range of rrt-connect"));
  choose_in_menu_of("moving_group", "arm");
  ASSERT_NO_FATAL_FAILURE(expect_entry("Let arm move"));
}

void OneHistory::set_goals() {
  choose("Plan", "Add a goal pose");
  ASSERT_NO_FATAL_FAILURE(expect_entry("Add goal pose"));
  pull_up(0.3);
  ASSERT_NO_FATAL_FAILURE(expect_entry("Move goal pose"));
  type_into("goal_position_tolerance", "5 mm");
  ASSERT_NO_FATAL_FAILURE(expect_entry("Change goal pose"));
  press(Qt::Key_Delete);
  ASSERT_NO_FATAL_FAILURE(expect_entry("Delete goal pose"));
  click_in_tree("Goal");
  pull_up(0.3);
  ASSERT_NO_FATAL_FAILURE(expect_entry("Set goal"));
  choose_tab("Joints");
  turn_joint("joint_1", "20");
  choose("Plan", "Set goal here");
  ASSERT_NO_FATAL_FAILURE(expect_entry("Set goal"));
  choose("Plan", "Set start here");
  ASSERT_NO_FATAL_FAILURE(expect_entry("Set start"));
}

void OneHistory::constrain() {
  click_in_tree("can");
  choose_in("fixed_to", QStringLiteral("palm"));
  ASSERT_NO_FATAL_FAILURE(expect_entry("Attach can to tx90_sah/palm"));
  click(part<QCheckBox>("keep_upright"), QPoint(8, part<QCheckBox>("keep_upright").height() / 2));
  ASSERT_NO_FATAL_FAILURE(expect_entry("Constrain can"));
}

void OneHistory::map_glove() {
  show_glove_page("Mapping");
  auto& wires = *window().findChild<gui::MappingWires*>();
  const int joint = 2;
  const QPoint from = wires.sensor_handle(device::find_sensor("n").value()).toPoint();
  const QPoint to = wires.joint_handle(joint).toPoint();
  QTest::mousePress(&wires, Qt::LeftButton, {}, from);
  move_pressed_mouse(wires, to);
  QTest::mouseRelease(&wires, Qt::LeftButton, {}, to);
  ASSERT_NO_FATAL_FAILURE(expect_entry("Wire thumb_proximal"));
}

void OneHistory::use_basis() {
  show_glove_page("Explore");
  choose_in("explorer_basis", QStringLiteral("sah_free_hand"));
  ASSERT_TRUE(wait_for([&] { return part<QPushButton>("basis_use").isEnabled(); }));
  click(part<QPushButton>("basis_use"));
  ASSERT_NO_FATAL_FAILURE(expect_entry("Use basis sah_free_hand"));
}

TEST_F(OneHistory, HoldsWhatIsDoneInAllDocks) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  states_.push_back(all_that_is_edited());
  ASSERT_NO_FATAL_FAILURE(ask_planner());
  ASSERT_NO_FATAL_FAILURE(set_goals());
  ASSERT_NO_FATAL_FAILURE(constrain());
  ASSERT_NO_FATAL_FAILURE(map_glove());
  ASSERT_NO_FATAL_FAILURE(use_basis());

  auto& dock = part<QDockWidget>("history");
  dock.show();
  dock.raise();
  auto& list = *dock.findChild<QUndoView*>();
  ASSERT_EQ(list.model()->rowCount(), static_cast<int>(states_.size())) << "with \"As opened\"";
  picture("history_of_all_docks");
  activate();
  for (int left = history().count(); left-- > 0;) {
    const std::string undone = history().undoText().toStdString();
    press(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_TRUE(wait_for([&] { return history().index() == left; })) << undone;
    EXPECT_EQ(all_that_is_edited(), states_[static_cast<std::size_t>(left)]) << undone;
  }
  for (int row = 1; row < list.model()->rowCount(); ++row) {
    const QModelIndex index = list.model()->index(row, 0);
    list.scrollTo(index);
    click(*list.viewport(), list.visualRect(index).center());
    ASSERT_EQ(history().index(), row);
    EXPECT_EQ(all_that_is_edited(), states_[static_cast<std::size_t>(row)])
        << index.data().toString().toStdString();
  }
}

}  // namespace
}  // namespace handway::test
