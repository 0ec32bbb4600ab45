/// STOP in every dialog, popup and window size, and while the window's thread is busy.
#include "app/file_commands.h"
#include "features/devices/moving_robot.h"
#include "features/devices/x_input.h"
#include "features/editing/scene_editing.h"
#include "features/glove/calibration_choice.h"
#include "features/glove/glove_panel.h"
#include "features/glove/pmd_explorer.h"
#include "features/grasping/grasp_card.h"
#include "features/planning/plan_panel.h"
#include "features/planning/preset_bar.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/obj_writer.h"
#include "handway_test/fake_xacro.h"
#include "handway_test/paths.h"
#include "pressed_mouse.h"
#include "view3d/scene_view.h"
#include "widgets/panels/xacro_dialog.h"

#include <QComboBox>
#include <QDialog>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QScreen>
#include <QTimer>
#include <QToolButton>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <thread>

namespace handway::test {
namespace {

constexpr double kSlow = 0.01;  // share of full pace

class Stop : public MovingRobot {
 protected:
  void SetUp() override {
    MovingRobot::SetUp();
    if (!IsSkipped()) {
      connect_to("emulator", "emulator");
    }
  }

  /// Returns the action with this text; those of the menu bar, which have an underlined letter,
  /// come first.
  [[nodiscard]] QAction& action(const QString& text) const {
    QAction* found = nullptr;
    for (QAction* action : window().findChildren<QAction*>()) {
      const bool has_letter = action->text().contains(QLatin1Char('&'));
      if (action->text().remove(QLatin1Char('&')) == text && (!found || has_letter)) {
        found = action;
      }
    }
    return found ? *found : throw std::runtime_error("no action " + text.toStdString());
  }
  [[nodiscard]] static QAbstractButton& button(const QWidget& parent, const QString& text) {
    for (QAbstractButton* button : parent.findChildren<QAbstractButton*>()) {
      if (button->text() == text) {
        return *button;
      }
    }
    throw std::runtime_error("no button " + text.toStdString());
  }
  [[nodiscard]] static QWidget* top_dialog() {
    if (QWidget* modal = QApplication::activeModalWidget()) {
      return modal;
    }
    for (QWidget* widget : QApplication::topLevelWidgets()) {
      if (qobject_cast<QDialog*>(widget) && widget->isVisible()) {
        return widget;
      }
    }
    return nullptr;
  }
  /// Saves a picture of the screen in the folder $HANDWAY_PICTURES, if there is one.
  static void keep_screen(const QString& name) {
    const QString folder = qEnvironmentVariable("HANDWAY_PICTURES");
    if (!folder.isEmpty()) {
      QTest::qWait(300);
      EXPECT_TRUE(QGuiApplication::primaryScreen()->grabWindow(0).save(
          QStringLiteral("%1/%2.png").arg(folder, name)));
    }
  }
  static void close_dialogs() {
    while (QWidget* dialog = top_dialog()) {
      dialog->close();
      QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
  }

  /// Opens a dialog while the robot moves, and stops the robot there.
  void stop_through(const std::function<void()>& open,
                    const std::function<void(QWidget& dialog)>& stop) {
    begin_motion(kSlow);
    bool was_seen = false;
    QTimer watch;
    QObject::connect(&watch, &QTimer::timeout, &watch, [&] {
      if (QWidget* dialog = top_dialog()) {
        watch.stop();
        was_seen = true;
        QTest::qWait(50);  // it is drawn
        const auto asked = Clock::now();
        stop(*dialog);
        expect_stopped_within_50_ms(asked);
        dialog->close();
      }
    });
    watch.start(5);
    open();  // whose own event loop runs in some
    EXPECT_TRUE(QTest::qWaitFor([&] { return was_seen; }, 5000)) << "no dialog";
    watch.stop();
    close_dialogs();
    if (moves()) {
      driver().stop();
    }
    ASSERT_TRUE(waits_for(gui::MotionDriver::State::kConnected));
  }

  /// Presses the button that a user would click: visible, and nothing over it.
  static void press_stop_of(const QWidget& dialog) {
    auto* stop = dialog.findChild<QPushButton*>(QStringLiteral("stop"));
    ASSERT_TRUE(stop);
    ASSERT_TRUE(stop->isVisible());
    const QPoint middle = stop->mapToGlobal(stop->rect().center());
    EXPECT_TRUE(dialog.frameGeometry().contains(middle));
    EXPECT_EQ(QApplication::widgetAt(middle), stop);
    QTest::mousePress(stop, Qt::LeftButton);
  }
  static void press_key(QWidget& dialog, Qt::Key key) {
    QWidget* focus = dialog.focusWidget();
    QTest::keyPress(focus ? focus : &dialog, key,
                    key == Qt::Key_Space ? Qt::ControlModifier : Qt::NoModifier);
  }
};

/// A place in the sources that makes a dialog, and how a person comes to it.
struct DialogCase {
  const char* source;  ///< The file that names it, in gui/.
  const char* name;
  std::function<void()> open;
};

/// A place in the sources that makes a dialog. A class counts where it is declared.
const std::regex& dialog_pattern() {
  static const std::regex kPattern(
      R"(ask_where_to_save\(|QFileDialog::get\w+\(|QInputDialog::get\w+\(|QColorDialog::get\w+\(|QFontDialog::get\w+\(|)"
      R"(QMessageBox::(question|warning|critical|information|about|aboutQt)\(|)"
      R"(new Q\w*(Dialog|MessageBox|Wizard|ErrorMessage)\b|)"
      R"(\bQ(File|Input|Color|Font|Progress)?(Dialog|MessageBox|Wizard|ErrorMessage) \w+[({;]|)"
      R"(: public Q\w*(Dialog|MessageBox|Wizard)\b)");
  return kPattern;
}

std::map<std::string, int> dialogs_in_the_sources() {
  std::map<std::string, int> count;
  const std::filesystem::path gui = source_dir() / "gui";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(gui)) {
    const std::string suffix = entry.path().extension().string();
    // Calls of the functions that ask where to save count at their callers.
    if ((suffix != ".cpp" && suffix != ".h") || entry.path().stem() == "file_dialogs") {
      continue;
    }
    std::ifstream stream(entry.path());
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const auto found = std::distance(
        std::sregex_iterator(text.begin(), text.end(), dialog_pattern()), std::sregex_iterator());
    if (found > 0) {
      count[std::filesystem::relative(entry.path(), gui).string()] = static_cast<int>(found);
    }
  }
  return count;
}

class StopInDialogs : public Stop {
 protected:
  void SetUp() override {
    Stop::SetUp();
    if (IsSkipped()) {
      return;
    }
    plan();
    window().player().set_loop(false);
    tool<gui::PresetBar>().save_as("own");
    window().editor().select_objects({"post"});
    // A glove, of which something is recorded.
    glove_ = std::make_unique<device::GloveEmulator>(device::GloveEmulatorSettings{}, [](double) {
      return std::array<std::uint16_t, device::kGloveSensors>{};
    });
    tool<gui::GlovePanel>().connect_to(QString::fromStdString(glove_->address()));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          return tool<gui::GlovePanel>().session().link().state() ==
                 device::StreamState::kStreaming;
        },
        kPatienceMs));
  }

  void record_something() const {
    part<QPushButton>("record").click();
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return tool<gui::GlovePanel>().session().link().tap().rows() > 0; }, kPatienceMs));
    part<QPushButton>("record").click();
  }
  void import_a_mesh() const {
    const std::filesystem::path file = cell().folder() / "slab.obj";
    geometric::write_obj(*geometric::tessellate(geometric::Box{{0.2, 0.3, 0.1}}), file);
    emit window().workbench().mesh_dropped(QString::fromStdString(file.string()));
  }
  void choose(QComboBox& box, const QString& text) const {
    const int row = box.findText(text);
    ASSERT_GE(row, 0) << text.toStdString();
    box.setCurrentIndex(row);
    emit box.activated(row);
  }
  template <typename Part>
  [[nodiscard]] Part& only() const {
    return *window().findChild<Part*>();
  }
  /// A dialog of a dialog.
  void open_both(const QString& first, const QString& then) const {
    action(first).trigger();
    button(*top_dialog(), then).click();
  }

  [[nodiscard]] std::vector<DialogCase> cases() const;

 private:
  std::unique_ptr<device::GloveEmulator> glove_;
};

std::vector<DialogCase> StopInDialogs::cases() const {
  const auto trigger = [this](const char* text) {
    return [this, text = QString::fromUtf8(text)] { action(text).trigger(); };
  };
  const auto menu_of = [this](const char* name) {
    return part<QToolButton>(name).menu()->actions();
  };
  return {
      {"app/file_commands.cpp", "open", trigger("Open…")},
      {"app/file_commands.cpp", "save as", trigger("Save as…")},
      {"app/file_commands.cpp", "picture", trigger("Save picture…")},
      {"app/file_commands.cpp", "unsaved changes",
       [this] { (void)only<gui::FileCommands>().may_discard(); }},
      {"app/file_commands.cpp", "changed by another program",
       [this] {
         std::ofstream(window().workbench().document.file(), std::ios::app) << "\n";
         (void)only<gui::FileCommands>().save();
       }},
      {"features/devices/device_session.cpp", "leave", [this] { window().close(); }},
      {"features/postures/posture_panels.h", "save a posture", trigger("Save posture…")},
      {"features/export/export_dialog.h", "export", trigger("Export the path…")},
      {"features/export/export_dialog.cpp", "folder",
       [this] { open_both("Export the path…", QStringLiteral("Browse…")); }},
      {"features/export/pictures_dialog.h", "pictures", trigger("Export pictures of the path…")},
      {"features/export/pictures_dialog.cpp", "file",
       [this] { open_both("Export pictures of the path…", QStringLiteral("Browse…")); }},
      {"app/start/help.cpp", "about", trigger("About Handway")},
      {"app/start/shortcut_list.cpp", "shortcuts", trigger("Keyboard shortcuts")},
      {"features/preferences/preferences_dialog.h", "preferences", trigger("Preferences…")},
      {"features/comparison/comparison_window.h", "compare", trigger("Compare two paths…")},
      {"features/comparison/comparison_window.cpp", "a path to compare",
       [this] { open_both("Compare two paths…", QStringLiteral("From a file…")); }},
      {"features/editing/scene_editing.cpp", "mesh", trigger("Mesh from file…")},
      {"features/grasping/grasp_tool.cpp", "grasps to keep",
       [this] { emit only<gui::GraspCard>().keep_requested(); }},
      {"features/editing/mesh_import.h", "size of a mesh", [this] { import_a_mesh(); }},
      {"features/editing/cloud_tool.cpp", "points", trigger("Point cloud from file…")},
      {"features/editing/cloud_import_dialog.h", "pose of points",
       [this] { emit window().workbench().cloud_dropped(QStringLiteral("scan.xyz")); }},
      {"features/postures/likeness_meter.cpp", "recorded postures",
       [this] { part<QPushButton>("likeness_choose").menu()->actions().last()->trigger(); }},
      {"features/editing/properties_panel.cpp", "colour",
       [this] { part<QToolButton>("color").click(); }},
      {"features/viewing/saved_views.cpp", "save a view",
       [this] {
         auto& menu = part<QMenu>("saved_views");
         emit menu.aboutToShow();
         menu.actions().front()->trigger();
       }},
      {"app/start/new_scene_dialog.h", "new scene", trigger("New…")},
      {"features/robots/add_robot_dialog.h", "add a robot", trigger("Robot…")},
      {"features/robots/add_robot_dialog.cpp", "robot file",
       [this] { open_both("Robot…", QStringLiteral("From a file…")); }},
      {"features/robots/robots.cpp", "export a robot", trigger("Export robot…")},
      {"features/robots/setup_dialog.h", "robot setup", trigger("Robot setup…")},
      {"widgets/panels/xacro_dialog.h", "xacro arguments",
       [this] {
         const std::filesystem::path file = cell().folder() / "box.xacro";
         std::ofstream(file) << kXacroBox;
         gui::with_xacro_arguments(&window(), file, [](const geometric::XacroArguments&) {});
       }},
      {"features/planning/preset_bar.cpp", "save a preset",
       [menu_of] { menu_of("preset_menu")[0]->trigger(); }},
      {"features/planning/preset_bar.cpp", "rename a preset",
       [menu_of] { menu_of("preset_menu")[2]->trigger(); }},
      {"features/playback/path_opening.cpp", "path to open", trigger("Open a path…")},
      {"features/playback/plots_panel.cpp", "plot",
       [this] { button(window(), "Export…").click(); }},
      {"features/campaigns/campaigns_panel.cpp", "campaign",
       [this] { button(part<QWidget>("campaigns"), "Open…").click(); }},
      {"features/glove/calibration_guide.cpp", "calibration to save",
       [this] {
         part<QPushButton>("calibrate").click();
         while (part<QPushButton>("calibration_skip").isEnabled()) {
           part<QPushButton>("calibration_skip").click();
         }
         part<QPushButton>("calibration_capture").click();
       }},
      {"features/glove/capture_pages.cpp", "captured postures",
       [this] { emit only<gui::PmdExplorer>().recording_requested(); }},
      {"features/glove/pmd_explorer.cpp", "basis",
       [this] { choose(part<QComboBox>("explorer_basis"), "Open a basis…"); }},
      {"features/glove/pmd_explorer.cpp", "save a basis",
       [this] { part<QPushButton>("basis_save").click(); }},
      {"features/glove/device_field.cpp", "recording to replay",
       [this] { choose(part<QComboBox>("glove_device"), "Replay a recording…"); }},
      {"features/glove/calibration_choice.cpp", "calibration",
       [this] { choose(only<gui::CalibrationChoice>(), "From a file…"); }},
      {"features/glove/mapping_editor.cpp", "mapping", trigger("Open…")},
      {"features/glove/mapping_editor.cpp", "save a mapping", trigger("Save as…")},
      {"features/glove/mapping_editor.cpp", "recording to fit", trigger("Fit to a recording…")},
      {"features/glove/mapping_editor.cpp", "mapping to compare", trigger("With a file…")},
      {"features/glove/record_bar.cpp", "name of a recording", [this] { record_something(); }},
  };
}

TEST_F(StopInDialogs, WorksByKeyAndByButtonInEveryOne) {
  window().editor().add("box", geometric::Box{}, {}, {0.9, 0.0, 0.0});
  window().editor().select_objects({"post"});
  constexpr std::array kKeys{Qt::Key_Pause, Qt::Key_Space, Qt::Key_F12};
  std::map<std::string, int> covered;
  std::size_t turn = 0;
  for (const DialogCase& dialog : cases()) {
    SCOPED_TRACE(std::string(dialog.source) + ": " + dialog.name);
    ++covered[dialog.source];
    const Qt::Key key = kKeys.at(turn++ % kKeys.size());
    stop_through(dialog.open, [&](QWidget& shown) { press_key(shown, key); });
    stop_through(dialog.open, [&](QWidget& shown) {
      press_stop_of(shown);
      keep_screen(QStringLiteral("stop_in_%1").arg(QLatin1String(dialog.name)));
    });
    if (HasFatalFailure()) {
      return;
    }
  }
  EXPECT_EQ(covered, dialogs_in_the_sources()) << "open the new one here, too";
}

TEST_F(Stop, IsInDialogsWhileSomethingIsConnectedOnly) {
  window().workbench().driver.disconnect_all();
  ASSERT_TRUE(waits_for(gui::MotionDriver::State::kOff));
  action("Preferences…").trigger();
  const auto* stop = top_dialog()->findChild<QPushButton*>(QStringLiteral("stop"));
  ASSERT_TRUE(stop);
  EXPECT_FALSE(stop->isVisible());
  EXPECT_FALSE(part<QPushButton>("devices_stop").isVisible());
  close_dialogs();
}

TEST_F(Stop, WorksWhileAMenuAListOrThePaletteIsOpen) {
  const std::vector<std::function<void()>> popups{
      [this] { window().menuBar()->actions().front()->menu()->popup(window().pos()); },
      [this] { part<QComboBox>("planners").showPopup(); },
      [this] { action("Find a command…").trigger(); },
      [this] { action("Help on this panel").trigger(); }};
  for (const auto& open : popups) {
    begin_motion(kSlow);
    open();
    ASSERT_TRUE(QTest::qWaitFor([] { return QApplication::activePopupWidget() != nullptr; }));
    const QPointer<QWidget> popup = QApplication::activePopupWidget();
    SCOPED_TRACE(popup->metaObject()->className());
    const auto asked = Clock::now();
    press_key(*popup, Qt::Key_Pause);
    EXPECT_TRUE(!popup.isNull() && popup->isVisible()) << "the key is for nothing else";
    expect_stopped_within_50_ms(asked);
    if (!popup.isNull()) {
      popup->close();
    }
  }
}

TEST_F(Stop, KeepsCtrlSpaceFromATextFieldAndFromThePlayback) {
  begin_motion(kSlow);
  QLineEdit field(&window());
  field.show();
  field.setFocus();
  const auto asked = Clock::now();
  press_key(field, Qt::Key_Space);
  expect_stopped_within_50_ms(asked);
  EXPECT_TRUE(field.text().isEmpty());
}

TEST_F(Stop, WorksWhileTheMouseDragsAndAnotherWidgetHasTheKeyboard) {
  begin_motion(kSlow);
  QTest::mousePress(&window().view(), Qt::LeftButton, Qt::NoModifier, QPoint(100, 100));
  move_pressed_mouse(window().view(), QPoint(140, 120));
  QWidget greedy(&window());
  greedy.grabMouse();
  greedy.grabKeyboard();
  const auto asked = Clock::now();
  QTest::keyPress(window().windowHandle(), Qt::Key_F12);  // as the X server would send it
  expect_stopped_within_50_ms(asked);
  greedy.releaseKeyboard();
  greedy.releaseMouse();
  QTest::mouseRelease(&window().view(), Qt::LeftButton, Qt::NoModifier, QPoint(140, 120));
}

TEST_F(Stop, WorksByTheMouseWhileAPopupHoldsIt) {
  XInput input;
  begin_motion(kSlow);
  auto& stop = part<QPushButton>("devices_stop");
  action("Find a command…").trigger();
  ASSERT_TRUE(QTest::qWaitFor([] { return QApplication::activePopupWidget() != nullptr; }));
  QTest::qWait(100);
  const auto asked = Clock::now();
  input.click(stop.mapToGlobal(stop.rect().center()));
  expect_stopped_within_50_ms(asked);
}

TEST_F(Stop, HearsItsKeysThoughTheWindowIsBusy) {
  XInput input;
  const std::vector<std::vector<xcb_keysym_t>> keys{
      {kPauseKey}, {kF12Key}, {kControlKey, kSpaceKey}};
  for (const auto& key : keys) {
    SCOPED_TRACE(key.front());
    begin_motion(kSlow);
    window().activateWindow();
    QTest::qWait(100);
    const auto asked = Clock::now();
    input.type(key);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // the window's thread
    expect_stopped_within_50_ms(asked);
  }
}

TEST_F(Stop, HearsItsKeysThoughTheFocusIsInAWindowThatADialogBlocks) {
  XInput input;
  begin_motion(kSlow);
  action("Preferences…").trigger();
  QTest::qWait(100);
  window().activateWindow();
  QTest::qWait(100);
  const auto asked = Clock::now();
  input.type({kControlKey, kSpaceKey});
  expect_stopped_within_50_ms(asked);
  close_dialogs();
}

TEST_F(Stop, LeavesOtherProgramsAllKeysButPause) {
  XInput input;
  begin_motion(kSlow);
  input.take_keyboard();
  input.type({kF12Key});
  input.type({kControlKey, kSpaceKey});
  QTest::qWait(200);
  EXPECT_TRUE(moves());
  const auto asked = Clock::now();
  input.type({kPauseKey});
  expect_stopped_within_50_ms(asked);
}

TEST_F(Stop, IsSeenAtEverySize) {
  auto& stop = part<QPushButton>("devices_stop");
  for (const QSize size : {QSize(1, 1), QSize(640, 400), QSize(1024, 700), QSize(1500, 900)}) {
    window().resize(size);
    QTest::qWait(100);
    const QPoint corner = stop.mapTo(&window(), stop.rect().bottomRight());
    EXPECT_TRUE(stop.isVisible());
    EXPECT_TRUE(window().rect().contains(corner));
    EXPECT_LE(stop.minimumSizeHint().width(), stop.width()) << "its whole word";
    keep_screen(QStringLiteral("stop_at_%1").arg(size.width()));
    EXPECT_LT(corner.x(), 200) << "where a screen that is too small still shows it";
    EXPECT_LT(corner.y(), 100);
    EXPECT_EQ(QApplication::widgetAt(stop.mapToGlobal(stop.rect().center())), &stop);
  }
}

}  // namespace
}  // namespace handway::test
