/// Tests the way from the URDFs of an arm and a hand to a grasp that is planned and played, with
/// the mouse alone, as by a first-time user. Each step leaves a picture.
#include "handway/geometric/io/resources.h"
#include "handway/planning/extensions/plugin.h"
#include "patience.h"
#include "pressed_mouse.h"
#include "view3d/scene_view.h"
#include "window_test.h"

#include <QComboBox>
#include <QDir>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QListView>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QTabBar>
#include <QTabWidget>
#include <QTimer>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <vector>

namespace handway::test {
namespace {

constexpr int kSteps = 10;  // of a drag
constexpr int kTenMinutesMs = 10 * 60 * 1000;

class OwnRobots : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    auto plugins = std::make_shared<planning::PluginManager>();
    plugins->load_plugins(planning::plugin_directory());
    window_ = std::make_unique<gui::MainWindow>(plugins);
    window_->resize(1440, 900);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    clock_.start();
  }

  template <typename Condition>
  [[nodiscard]] static bool wait_for(Condition condition) {
    return QTest::qWaitFor(condition, kPatienceMs);
  }
  void click(const char* name) const {
    auto* button = window_->findChild<QWidget*>(QLatin1String(name));
    ASSERT_TRUE(button) << name;
    ASSERT_TRUE(wait_for([&] { return button->isVisible() && button->isEnabled(); })) << name;
    QTest::mouseClick(button, Qt::LeftButton);
  }
  /// The entry of a menu of the menu bar, both by what they say.
  void choose_in_menu(const QString& title, const QString& entry) const {
    const auto find = [](const QList<QAction*>& actions, const QString& words) {
      const auto found = std::ranges::find_if(actions, [&](QAction* action) {
        return action->text().remove(QLatin1Char('&')) == words;
      });
      return found == actions.end() ? nullptr : *found;
    };
    QMenuBar* bar = window_->menuBar();
    QAction* top = find(bar->actions(), title);
    ASSERT_TRUE(top) << title.toStdString();
    QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(top).center());
    QMenu* menu = top->menu();
    ASSERT_TRUE(wait_for([&] { return menu->isVisible(); }));
    QAction* action = find(menu->actions(), entry);
    ASSERT_TRUE(action && action->isEnabled()) << entry.toStdString();
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
  }
  /// Opens a file dialog by `open`, whose own event loop runs, and double-clicks a file there.
  void choose_file(const std::function<void()>& open, const QString& dialog_name,
                   const QString& file, const QString& picture_name) {
    bool done = false;
    QTimer watch;
    QObject::connect(&watch, &QTimer::timeout, &watch, [&] {
      QPointer<QFileDialog> dialog = window_->findChild<QFileDialog*>(dialog_name);
      auto* list = dialog ? dialog->findChild<QListView*>(QStringLiteral("listView")) : nullptr;
      if (!list || !list->isVisible()) {
        return;
      }
      const QModelIndexList found =
          list->model()->match(list->model()->index(0, 0, list->rootIndex()), Qt::DisplayRole, file,
                               1, Qt::MatchExactly);
      if (found.isEmpty()) {
        return;
      }
      watch.stop();
      list->scrollTo(found.front());
      picture(picture_name, *dialog);
      const QPoint place = list->visualRect(found.front()).center();
      QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, place);
      QTest::mouseDClick(list->viewport(), Qt::LeftButton, {}, place);
      done = true;
    });
    watch.start(50);
    open();
    ASSERT_TRUE(wait_for([&] { return done; })) << "no file " << file.toStdString();
  }
  void picture(const QString& name, QWidget& of) const {
    QTest::qWait(150);
    QDir().mkpath(QStringLiteral(HANDWAY_PICTURES));
    EXPECT_TRUE(
        of.grab().save(QDir(QStringLiteral(HANDWAY_PICTURES))
                           .filePath(name_ + QLatin1Char('_') + name + QStringLiteral(".png"))));
  }
  void picture(const QString& name) const { picture(name, *window_); }
  void wait_until_at_rest() const {
    ASSERT_TRUE(wait_for([&] { return !window_->workbench().is_busy(); }));
  }
  /// Drags with the mouse over places in the world, and waits for what follows.
  void drag(const std::vector<Eigen::Vector3d>& places) const {
    QTest::qWait(100);
    gui::SceneView& view = window_->view();
    QTest::mousePress(&view, Qt::LeftButton, {}, seen(places.front()));
    ASSERT_TRUE(view.gizmo().is_dragging());
    for (const Eigen::Vector3d& place : places) {
      move_pressed_mouse(view, seen(place));
      QTest::qWait(20);
    }
    QTest::mouseRelease(&view, Qt::LeftButton, {}, seen(places.back()));
    wait_until_at_rest();
  }
  /// Pulls an arrow of the handles. @param by m, along an axis of the world.
  void pull(int axis, double by) const {
    const gui::SceneView& view = window_->view();
    const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
    const Eigen::Vector3d direction = frame.axes.col(axis);
    const Eigen::Vector3d from = frame.centre + 0.9 * frame.size * direction;
    std::vector<Eigen::Vector3d> places;
    for (int step = 0; step <= kSteps; ++step) {
      places.emplace_back(from + by * step / kSteps * direction);
    }
    drag(places);
  }
  /// Turns a ring of the handles. @param by rad, about an axis of the world. @param from where it
  /// is taken, rad.
  void turn(int axis, double by, double from) const {
    const gui::SceneView& view = window_->view();
    const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
    const double radius = gui::GizmoFrame::kRingRadius * frame.size;
    std::vector<Eigen::Vector3d> places;
    for (int step = 0; step <= kSteps; ++step) {
      const double angle = from + by * step / kSteps;
      places.emplace_back(frame.centre +
                          radius * (std::cos(angle) * frame.axes.col((axis + 1) % 3) +
                                    std::sin(angle) * frame.axes.col((axis + 2) % 3)));
    }
    drag(places);
  }
  /// Pulls what is selected to a place in the world, upwards first.
  void move_selected(const Eigen::Vector3d& to) const {
    for (const int axis : {2, 0, 1}) {
      const double from = window_->editor().selected_pose()->translation()[axis];
      if (std::abs(to[axis] - from) > 0.01) {
        pull(axis, to[axis] - from);
      }
      EXPECT_NEAR(window_->editor().selected_pose()->translation()[axis], to[axis], 0.02);
    }
  }
  [[nodiscard]] QPoint seen(const Eigen::Vector3d& p_W) const {
    const gui::SceneView& view = window_->view();
    return gui::place_of(view.camera(), view.size(), p_W).toPoint();
  }
  [[nodiscard]] const geometric::Scene& scene() const { return *window_->document().scene(); }

  void open_arm(const std::filesystem::path& urdf);
  void mount_hand(const std::filesystem::path& urdf, const char* link);
  void set_up(const std::filesystem::path& urdf);
  void put_can_on_table();
  void grasp();
  void play_to_the_end();

  ScratchFolder folder_;
  QString name_;  ///< Name of the pictures.
  std::unique_ptr<gui::MainWindow> window_;
  QElapsedTimer clock_;
};

// A copy without SRDF, as robots come from their makers.
std::filesystem::path copy_robot(const std::filesystem::path& urdf,
                                 const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  copy_folder(urdf.parent_path() / "meshes", folder / "meshes");
  std::filesystem::copy_file(urdf, folder / urdf.filename());
  return folder / urdf.filename();
}

void OwnRobots::open_arm(const std::filesystem::path& urdf) {
  // Sets the folder in which the dialog opens: the story before may have left it elsewhere.
  QFileDialog(window_.get()).setDirectory(QString::fromStdString(urdf.parent_path().string()));
  choose_file([this] { click("start_browse"); }, QStringLiteral("open_dialog"),
              QString::fromStdString(urdf.filename().string()), QStringLiteral("1_open"));
  ASSERT_TRUE(wait_for([&] { return window_->document().scene() != nullptr; }));
  wait_until_at_rest();
  picture(QStringLiteral("2_arm"));
}

void OwnRobots::mount_hand(const std::filesystem::path& urdf, const char* link) {
  QSettings().setValue(QStringLiteral("robot_folder"),
                       QString::fromStdString(urdf.parent_path().string()));
  choose_in_menu(QStringLiteral("Add"), QStringLiteral("Robot…"));
  choose_file([this] { click("add_robot_browse"); }, QStringLiteral("robot_file_dialog"),
              QString::fromStdString(urdf.filename().string()), QStringLiteral("3_hand_file"));
  auto* add = window_->findChild<QPushButton*>(QStringLiteral("add_robot_now"));
  ASSERT_TRUE(wait_for([&] { return add->isEnabled(); }));
  const auto* on = window_->findChild<QComboBox*>(QStringLiteral("add_robot_on"));
  EXPECT_TRUE(on->currentText().startsWith(QLatin1String(link))) << "where hands go";
  picture(QStringLiteral("4_mount"), *add->window());
  click("add_robot_now");
  wait_until_at_rest();
  ASSERT_EQ(scene().robots.size(), 1U);
  ASSERT_EQ(scene().robots.front().parts.size(), 2U);
  picture(QStringLiteral("5_mounted"));
}

// Sets up the selected robot.
void OwnRobots::set_up(const std::filesystem::path& urdf) {
  choose_in_menu(QStringLiteral("Edit"), QStringLiteral("Robot setup…"));
  auto* write = window_->findChild<QPushButton*>(QStringLiteral("setup_write"));
  ASSERT_TRUE(write);
  ASSERT_TRUE(wait_for([&] { return write->isEnabled(); })) << "samples";
  picture(QStringLiteral("6_setup"), *write->window());
  QTabBar* tabs = window_->findChild<QTabWidget*>(QStringLiteral("setup_tabs"))->tabBar();
  QTest::mouseClick(tabs, Qt::LeftButton, {}, tabs->tabRect(1).center());
  picture(QStringLiteral("6_pairs"), *write->window());
  click("setup_write");
  wait_until_at_rest();
  const auto srdf = std::filesystem::path(urdf).replace_extension(".srdf");
  EXPECT_TRUE(std::filesystem::exists(srdf));
  click("setup_close");
}

void OwnRobots::put_can_on_table() {
  choose_in_menu(QStringLiteral("Add"), QStringLiteral("Table"));
  move_selected({0.95, 0.0, 0.0});
  choose_in_menu(QStringLiteral("Add"), QStringLiteral("Can"));
  move_selected({0.55, 0.1, 0.9});
  choose_in_menu(QStringLiteral("Edit"), QStringLiteral("Drop to surface"));
  EXPECT_NEAR(window_->editor().selected_pose()->translation().z(), 0.74, 1e-3);
  picture(QStringLiteral("7_can"));
}

void OwnRobots::grasp() {
  choose_in_menu(QStringLiteral("Plan"), QStringLiteral("Set start here"));
  choose_in_menu(QStringLiteral("Edit"), QStringLiteral("Grasp…"));
  const auto* card = window_->findChild<QWidget*>(QStringLiteral("grasps"));
  ASSERT_TRUE(card);
  const auto* plan = window_->findChild<QPushButton*>(QStringLiteral("grasp_plan"));
  ASSERT_TRUE(wait_for([&] { return plan->isVisible() && plan->isEnabled(); })) << "grasps";
  picture(QStringLiteral("8_grasps"));
  QSignalSpy ended(&window_->session(), &gui::PlanningSession::ended);
  click("grasp_plan");
  ASSERT_TRUE(wait_for([&] { return !ended.isEmpty(); }));
  ASSERT_TRUE(ended.front().front().toBool()) << window_->message().toStdString();
  wait_until_at_rest();
  EXPECT_EQ(window_->workbench().validity.state(), gui::PathValidity::State::kValid);
}

void OwnRobots::play_to_the_end() {
  if (window_->findChild<QToolButton*>(QStringLiteral("loop"))->isChecked()) {
    click("loop");
  }
  if (!window_->player().is_playing()) {
    click("play");
  }
  ASSERT_TRUE(wait_for([&] { return window_->player().fraction() > 0.5; }));
  picture(QStringLiteral("9_playing"));
  ASSERT_TRUE(wait_for([&] { return window_->player().fraction() >= 1.0; }));
  EXPECT_TRUE(window_->document().configuration().isApprox(*scene().goal, 1e-6));
}

TEST_F(OwnRobots, GraspACanWithTheMouseAlone) {
  name_ = QStringLiteral("own");
  const auto robots = geometric::resource_dir() / "robots";
  const auto arm =
      copy_robot(robots / "iiwa14_class" / "iiwa14_class.urdf", folder_.path() / "arm");
  const auto hand = copy_robot(robots / "allegro_class_right" / "allegro_class_right.urdf",
                               folder_.path() / "hand");
  open_arm(arm);
  mount_hand(hand, "flange_link");
  set_up(hand);
  put_can_on_table();
  grasp();
  play_to_the_end();
  EXPECT_LT(clock_.elapsed(), kTenMinutesMs);
}

// The flange of this arm is turned against its last link: the hand has to be turned on it.
TEST_F(OwnRobots, OfOthersGraspACanWithTheMouseAlone) {
  HANDWAY_NEED_REFERENCE(reference);
  name_ = QStringLiteral("others");
  const auto arm = copy_robot(reference / "robots/iiwa14/iiwa14.urdf", folder_.path() / "arm");
  const auto hand = copy_robot(reference / "robots/allegro_hand/allegro_hand_right.urdf",
                               folder_.path() / "hand");
  open_arm(arm);
  mount_hand(hand, "ee_link");
  turn(1, 0.5 * std::numbers::pi, 1.25 * std::numbers::pi);
  pull(2, 0.1);
  set_up(hand);
  put_can_on_table();
  grasp();
  play_to_the_end();
  EXPECT_LT(clock_.elapsed(), kTenMinutesMs);
}

}  // namespace
}  // namespace handway::test
