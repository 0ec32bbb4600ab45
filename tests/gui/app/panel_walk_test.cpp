/// A walk through all panels, cards, menus and dialogs in usual sizes, themes and sizes of text:
/// nothing is cut, outside of the window or hard to read. With $HANDWAY_PICTURES it saves a picture
/// of each stop, which scripts/contact-sheet puts together.
#include "features/devices/device_session.h"
#include "features/glove/glove_panel.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/fake_xacro.h"
#include "handway_test/paths.h"
#include "layout_audit.h"
#include "patience.h"
#include "reader_names.h"
#include "small_cell.h"
#include "widgets/panels/floating_card.h"
#include "widgets/panels/xacro_dialog.h"
#include "widgets/style/theme.h"
#include "window_test.h"

#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPainter>
#include <QPushButton>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTabWidget>
#include <QTimer>
#include <QToolButton>

namespace handway::test {
namespace {

struct Form {
  const char* name;
  QSize size;
  double text_scale;
  gui::Theme theme;
};

void PrintTo(const Form& form, std::ostream* out) { *out << form.name; }

class PanelWalk : public ::testing::TestWithParam<Form> {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    gui::apply_theme(*qApp, GetParam().theme, GetParam().text_scale);
    auto plugins = std::make_shared<planning::PluginManager>();
    plugins->load_plugins(planning::plugin_directory());
    window_ = std::make_unique<gui::MainWindow>(plugins);
    window_->resize(GetParam().size);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  }
  void TearDown() override {
    window_.reset();
    if (qApp) {
      gui::apply_theme(*qApp, gui::Theme::kLight, 1.0);
    }
  }

  [[nodiscard]] gui::Workbench& workbench() const { return window_->workbench(); }
  template <typename Widget = QWidget>
  [[nodiscard]] Widget& part(const char* name) const {
    auto* widget = window_->findChild<Widget*>(QLatin1String(name));
    if (!widget) {
      throw std::runtime_error(std::string("no part called ") + name);
    }
    return *widget;
  }
  [[nodiscard]] QAction& action(const char* words) const {
    for (QAction* action : window_->findChildren<QAction*>()) {
      if (!action->menu() && action->text().remove(QLatin1Char('&')) == QString::fromUtf8(words)) {
        return *action;
      }
    }
    throw std::runtime_error(std::string("no command called ") + words);
  }
  template <typename Condition>
  void wait_for(Condition condition) const {
    ASSERT_TRUE(QTest::qWaitFor(condition, kPatienceMs));
  }

  /// Looks at what is on screen now.
  void look(const QString& stop) { look_at(stop, *window_); }
  void look_at(const QString& stop, QWidget& of) {
    settle(of);
    const QSize room = GetParam().size;
    if (of.width() > room.width() || of.height() > room.height()) {
      ADD_FAILURE() << stop.toStdString() << " is " << of.width() << " x " << of.height();
    }
    for (const QString& fault : audit_.new_faults(of)) {
      ADD_FAILURE() << stop.toStdString() << ": " << fault.toStdString();
    }
    for (const QString& fault : faults_for_readers(of)) {
      if (!known_.contains(fault)) {
        known_ << fault;
        ADD_FAILURE() << stop.toStdString() << ": " << fault.toStdString();
      }
    }
    keep_picture(stop, of);
  }
  /// Waits until nothing is laid out any more.
  static void settle(QWidget& of) {
    QList<QRect> before;
    for (int still = 0, tries = 0; still < 3 && tries < 60; ++tries) {
      QTest::qWait(20);
      QList<QRect> now;
      for (const QWidget* widget : of.findChildren<QWidget*>()) {
        now << widget->geometry();
      }
      still = now == before ? still + 1 : 0;
      before = now;
    }
    // A figure that has just changed has its room only then.
    QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
  }
  static void keep_picture(const QString& stop, QWidget& of) {
    const QString folder = qEnvironmentVariable("HANDWAY_PICTURES");
    if (!folder.isEmpty()) {
      const QDir place(QStringLiteral("%1/%2").arg(folder, QLatin1String(GetParam().name)));
      place.mkpath(QStringLiteral("."));
      static int number = 0;
      EXPECT_TRUE(of.grab().save(place.filePath(
          QStringLiteral("%1_%2.png").arg(++number, 4, 10, QLatin1Char('0')).arg(stop))));
    }
  }

  void open_task() const {
    QSignalSpy ready(window_.get(), &gui::MainWindow::ready);
    window_->open(QString::fromStdString((source_dir() / "scenes" / "can_on_table.yaml").string()));
    wait_for([&] { return !ready.isEmpty(); });
  }
  void plan() const {
    QSignalSpy ended(&window_->session(), &gui::PlanningSession::ended);
    window_->session().start();
    wait_for([&] { return !ended.isEmpty(); });
  }
  void select(gui::SceneItem::Kind kind, const char* name) const {
    const std::string& robot = window_->document().robot()->name;
    window_->editor().select({kind, kind == gui::SceneItem::Kind::kObject ? "" : robot, name});
  }
  void walk_control_panels();
  void walk_pages_of(QWidget& panel, const QString& stop);
  void walk_docks();
  void walk_properties();
  void walk_cards();
  void walk_program();
  void walk_goals();
  void walk_menus();
  /// Looks at the window that a command opens, and closes it.
  void look_at_opened(const QString& stop, QAction& action);
  void look_at_opened(const QString& stop, const std::function<void()>& open);

  ScratchFolder folder_;
  LayoutAudit audit_;
  QStringList known_;  ///< Faults for screen readers, each reported once.
  std::unique_ptr<gui::MainWindow> window_;
};

void PanelWalk::walk_pages_of(QWidget& panel, const QString& stop) {
  look(stop);
  for (QTabBar* tabs : panel.findChildren<QTabBar*>()) {
    for (int page = 1; tabs->isVisible() && page < tabs->count(); ++page) {
      tabs->setCurrentIndex(page);
      look(stop + QLatin1Char('_') + tabs->tabText(page));
    }
    tabs->setCurrentIndex(0);
  }
}

void PanelWalk::walk_control_panels() {
  auto& tabs = part<QTabWidget>("control_tabs");
  for (int i = 0; i < tabs.count(); ++i) {
    tabs.setCurrentIndex(i);
    walk_pages_of(*tabs.widget(i), tabs.tabText(i));
  }
  tabs.setCurrentIndex(0);
}

void PanelWalk::walk_docks() {
  for (const char* name : {"runs", "plots", "microscope", "projection", "history"}) {
    auto& dock = part<QDockWidget>(name);
    dock.toggleViewAction()->trigger();
    dock.raise();
    QTest::qWait(100);
    look(QLatin1String(name));
    dock.hide();
  }
}

void PanelWalk::walk_properties() {
  using Kind = gui::SceneItem::Kind;
  select(Kind::kObject, "can");
  look(QStringLiteral("object"));
  window_->editor().select_objects({"can", "table"});
  look(QStringLiteral("objects"));
  select(Kind::kLink, "palm");
  look(QStringLiteral("link"));
  select(Kind::kRobot, "");
  look(QStringLiteral("robot"));
  window_->editor().select({Kind::kGoal, "", ""});
  look(QStringLiteral("goal"));
  part<QTabWidget>("control_tabs").setCurrentIndex(0);
}

// The editor of a program, with a step of each kind.
void PanelWalk::walk_program() {
  part<QMenu>("programs").actions().at(0)->trigger();
  part<QAbstractButton>("task_edit").click();
  look(QStringLiteral("program"));
  for (QAction* kind : part<QToolButton>("program_add").menu()->actions()) {
    kind->trigger();
    look(QStringLiteral("program_") + kind->text());
  }
  part<QAbstractButton>("program_disable").click();
  look(QStringLiteral("program_disabled"));
  part<QAbstractButton>("task_close").click();
}

void PanelWalk::walk_cards() {
  const QString message =
      QStringLiteral("/home/somebody/robots/a/folder/with/a/long/name/cell.yaml:12: found a word");
  workbench().banner.show_message(QStringLiteral("The scene can't be opened"), message);
  look(QStringLiteral("banner"));
  workbench().banner.offer(
      QStringLiteral("Unsaved changes to Can on a table"), message, QStringLiteral("Recover"),
      [] {}, QStringLiteral("Discard"), [] {});
  look(QStringLiteral("offer"));
  workbench().banner.hide();

  select(gui::SceneItem::Kind::kObject, "can");
  action("Grasp…").trigger();
  wait_for([&] { return part("grasp_plan").isVisible(); });
  look(QStringLiteral("grasps"));
  part<QAbstractButton>("grasp_close").click();
  walk_program();
  action("Array…").trigger();
  look(QStringLiteral("array"));
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  for (auto* card : window_->findChildren<gui::FloatingCard*>()) {
    card->hide();
  }

  for (const char* tool : {"measure", "section"}) {
    part<QAction>(tool).trigger();
    look(QLatin1String(tool));
    part<QAction>(tool).trigger();
  }
  walk_goals();
}

// Shows a free goal, one in the table, and a pose.
void PanelWalk::walk_goals() {
  const auto goal = window_->document().scene()->goal;
  window_->editor().set_goal(window_->document().robot()->model->neutral());
  wait_for([&] { return !workbench().is_busy(); });
  look(QStringLiteral("other_goal"));
  geometric::Configuration lower = goal.value();
  lower[1] += 0.2;
  window_->editor().set_goal(lower);
  wait_for([&] { return part("doctor").isVisible(); });
  look(QStringLiteral("goal_in_collision"));
  window_->editor().undo_stack().undo();
  window_->editor().undo_stack().undo();
  ASSERT_EQ(window_->document().scene()->goal, goal);
  part<QAction>("add_goal_pose").trigger();
  look(QStringLiteral("goal_pose"));
}

void PanelWalk::walk_menus() {
  for (QAction* top : window_->menuBar()->actions()) {
    QMenu* menu = top->menu();
    ASSERT_TRUE(menu);
    if (menu->isEmpty()) {
      continue;
    }
    menu->popup(window_->mapToGlobal({0, 0}));
    look_at(QStringLiteral("menu_") + top->text().remove(QLatin1Char('&')), *menu);
    menu->close();
  }
}

void PanelWalk::look_at_opened(const QString& stop, QAction& action) {
  ASSERT_TRUE(action.isEnabled()) << stop.toStdString();
  look_at_opened(stop, [&action] { action.trigger(); });
}

void PanelWalk::look_at_opened(const QString& stop, const std::function<void()>& open) {
  bool was_seen = false;
  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, &watch, [&] {
    for (QWidget* opened : QApplication::topLevelWidgets()) {
      if (opened != window_.get() && opened->isVisible() && !was_seen) {
        watch.stop();
        was_seen = true;
        look_at(stop, *opened);
        for (auto* pages : opened->findChildren<QTabWidget*>()) {
          for (int page = 1; page < pages->count(); ++page) {
            pages->setCurrentIndex(page);
            look_at(stop + QLatin1Char('_') + pages->tabText(page), *opened);
          }
        }
        opened->close();
      }
    }
  });
  watch.start(100);
  // A popup closes where another program takes the focus: it is opened again.
  for (int attempt = 0; attempt < 10 && !was_seen; ++attempt) {
    open();
    static_cast<void>(QTest::qWaitFor([&] { return was_seen; }, kPatienceMs / 10));
  }
  EXPECT_TRUE(was_seen) << stop.toStdString();
  QTest::qWait(300);
}

TEST_P(PanelWalk, CutsNothingAndIsReadable) {
  look(QStringLiteral("start_page"));
  open_task();
  ASSERT_EQ(window_->size(), GetParam().size);
  look(QStringLiteral("opened"));
  plan();
  window_->player().seek(0.5);
  walk_control_panels();
  walk_docks();
  walk_properties();
  walk_menus();
  look_at_opened(QStringLiteral("preferences"), action("Preferences…"));
  look_at_opened(QStringLiteral("open"), action("Open…"));
  look_at_opened(QStringLiteral("save_as"), action("Save as…"));
  look_at_opened(QStringLiteral("export"), action("Export the path…"));
  look_at_opened(QStringLiteral("pictures"), action("Export pictures of the path…"));
  look_at_opened(QStringLiteral("compare"), action("Compare two paths…"));
  look_at_opened(QStringLiteral("save_posture"), action("Save posture…"));
  look_at_opened(QStringLiteral("mesh"), [this] {
    const auto can = geometric::resource_dir() / "objects" / "can.stl";
    const std::filesystem::path copy = folder_.path() / "can.stl";
    std::filesystem::copy_file(can, copy);
    emit workbench().mesh_dropped(QString::fromStdString(copy.string()));
  });
  look_at_opened(QStringLiteral("new_scene"), action("New…"));
  look_at_opened(QStringLiteral("add_robot"), action("Robot…"));
  look_at_opened(QStringLiteral("robot_setup"), action("Robot setup…"));
  look_at_opened(QStringLiteral("xacro_arguments"), [this] {
    const std::filesystem::path file = folder_.path() / "box.xacro";
    std::ofstream(file) << kXacroBox;
    gui::with_xacro_arguments(window_.get(), file, [](const geometric::XacroArguments&) {});
  });
  look_at_opened(QStringLiteral("commands"), action("Find a command…"));
  look_at_opened(QStringLiteral("help"), action("Help on this panel"));
  look_at_opened(QStringLiteral("about"), action("About Handway"));
  walk_cards();
}

TEST_P(PanelWalk, CutsNothingWithDevices) {
  open_task();
  plan();
  auto& tabs = part<QTabWidget>("control_tabs");
  for (int i = 0; i < tabs.count(); ++i) {
    if (tabs.tabText(i) == QLatin1String("Devices")) {
      tabs.setCurrentIndex(i);
    }
  }
  part<QPushButton>("devices_connect").click();
  wait_for([&] { return workbench().driver.state() == gui::MotionDriver::State::kConnected; });
  QTest::qWait(300);
  look(QStringLiteral("Devices_connected"));
  part<QPushButton>("devices_connect").click();
  wait_for([&] { return workbench().driver.state() == gui::MotionDriver::State::kOff; });
}

// The walk covers the pages with data of an emulated glove, and the guide from its first posture to
// its end.
TEST_P(PanelWalk, CutsNothingWithAGlove) {
  open_task();
  auto& panel = *window_->findChild<gui::GlovePanel*>();
  panel.come_to_front("Sensors");
  part<QPushButton>("glove_connect").click();
  wait_for([&] {
    return panel.session().link().state() == device::StreamState::kStreaming &&
           panel.capture().postures().count() > 20;
  });
  walk_pages_of(panel, QStringLiteral("glove"));
  panel.come_to_front("Sensors");
  part<QPushButton>("calibrate").click();
  look(QStringLiteral("guide"));
  part<QPushButton>("calibration_capture").click();
  look(QStringLiteral("guide_reading"));
  auto& skip = part<QPushButton>("calibration_skip");
  const auto& instruction = part<QLabel>("calibration_instruction");
  wait_for([&] { return skip.isEnabled(); });
  while (skip.isEnabled()) {
    skip.click();
    if (instruction.text().contains(QLatin1String("Now move")) || !skip.isEnabled()) {
      look(QStringLiteral("guide_") +
           (skip.isEnabled() ? QLatin1String("motion") : QLatin1String("bones")));
    }
  }
  part<QPushButton>("glove_connect").click();
  wait_for([&] { return panel.session().link().state() == device::StreamState::kStopped; });
}

// The forms are a small window, a usual one, and a usual one with text of twice the size.
INSTANTIATE_TEST_SUITE_P(
    Forms, PanelWalk,
    ::testing::Values(Form{"small_light", {1024, 700}, 1.0, gui::Theme::kLight},
                      Form{"small_dark", {1024, 700}, 1.0, gui::Theme::kDark},
                      Form{"usual_light", {1440, 900}, 1.0, gui::Theme::kLight},
                      Form{"usual_dark", {1440, 900}, 1.0, gui::Theme::kDark},
                      Form{"large_text_light", {1440, 900}, 2.0, gui::Theme::kLight},
                      Form{"large_text_dark", {1440, 900}, 2.0, gui::Theme::kDark}),
    [](const auto& form) { return std::string(form.param.name); });

}  // namespace
}  // namespace handway::test
