/// From the URDFs of an arm and a hand to one robot beside a can, with the mouse alone, as somebody
/// would who has never seen the window. Each step leaves a picture.
#include "handway/planning/extensions/plugin.h"
#include "model/document/robot_edits.h"
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
#include <QTimer>

#include <algorithm>
#include <cmath>
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
  static void picture(const QString& name, QWidget& of) {
    QTest::qWait(150);
    QDir().mkpath(QStringLiteral(HANDWAY_PICTURES));
    EXPECT_TRUE(of.grab().save(
        QDir(QStringLiteral(HANDWAY_PICTURES)).filePath(name + QStringLiteral(".png"))));
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
  [[nodiscard]] QPoint seen(const Eigen::Vector3d& p_W) const {
    const gui::SceneView& view = window_->view();
    return gui::place_of(view.camera(), view.size(), p_W).toPoint();
  }
  [[nodiscard]] const geometric::Scene& scene() const { return *window_->document().scene(); }

  std::unique_ptr<gui::MainWindow> window_;
  QElapsedTimer clock_;
};

TEST_F(OwnRobots, AreMountedWithTheMouseAlone) {
  HANDWAY_NEED_REFERENCE(reference);
  const QString arm = QString::fromStdString((reference / "robots" / "iiwa14").string());
  const QString hand = QString::fromStdString((reference / "robots" / "allegro_hand").string());
  const QString here = QDir::currentPath();
  ASSERT_TRUE(QDir::setCurrent(arm));
  choose_file([this] { click("start_browse"); }, QStringLiteral("open_dialog"),
              QStringLiteral("iiwa14.urdf"), QStringLiteral("own_1_open"));
  QDir::setCurrent(here);
  ASSERT_TRUE(wait_for([&] { return window_->document().scene() != nullptr; }));
  wait_until_at_rest();
  picture(QStringLiteral("own_2_arm"));

  QSettings().setValue(QStringLiteral("robot_folder"), hand);
  choose_in_menu(QStringLiteral("Add"), QStringLiteral("Robot…"));
  choose_file([this] { click("add_robot_browse"); }, QStringLiteral("robot_file_dialog"),
              QStringLiteral("allegro_hand_right.urdf"), QStringLiteral("own_3_hand_file"));
  auto* add = window_->findChild<QPushButton*>(QStringLiteral("add_robot_now"));
  ASSERT_TRUE(wait_for([&] { return add->isEnabled(); }));
  EXPECT_EQ(window_->findChild<QComboBox*>(QStringLiteral("add_robot_on"))->currentText(),
            "ee_link of iiwa14")
      << "where hands go";
  picture(QStringLiteral("own_4_mount"), *add->window());
  click("add_robot_now");
  wait_until_at_rest();
  ASSERT_EQ(scene().robots.size(), 1U);
  ASSERT_EQ(scene().robots.front().parts.size(), 2U);
  picture(QStringLiteral("own_5_mounted"));
  // Its fingers along the flange's axis, its palm in front of the flange.
  turn(1, 0.5 * std::numbers::pi, 1.25 * std::numbers::pi);
  pull(2, 0.1);
  picture(QStringLiteral("own_6_in_place"));
  ASSERT_TRUE(wait_for([&] { return !window_->workbench().is_busy(); }));

  choose_in_menu(QStringLiteral("Add"), QStringLiteral("Can"));
  const Eigen::Vector3d can = window_->editor().selected_pose()->translation();
  pull(0, 0.55 - can.x());
  pull(1, 0.1 - can.y());
  picture(QStringLiteral("own_7_can"));
  EXPECT_NEAR(window_->editor().selected_pose()->translation().x(), 0.55, 0.01);
  EXPECT_LT(clock_.elapsed(), kTenMinutesMs);
}

}  // namespace
}  // namespace handway::test
