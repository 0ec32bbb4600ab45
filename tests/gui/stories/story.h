#pragma once

#include "handway/geometric/formats/scene_file.h"
#include "handway/planning/extensions/plugin.h"
#include "patience.h"
#include "watched_application.h"
#include "window_test.h"

#include <QDir>
#include <QSignalSpy>

#include <fstream>
#include <memory>
#include <string>

namespace handway::test {

// Three times of what is measured (docs/workbench.md), as a core that is shared takes twice as
// long; sanitizers take several times as long.
#ifdef HANDWAY_SANITIZED
inline constexpr double kStallMs = kLongestStallMs;
#else
inline constexpr double kStallMs = 100.0;
#endif

/// A window with all plugins, on real robots and scenes. Each step leaves a picture in the build
/// folder, and none keeps the window from answering.
class Story : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    auto plugins = std::make_shared<planning::PluginManager>();
    plugins->load_plugins(planning::plugin_directory());
    window_ = std::make_unique<gui::MainWindow>(plugins);
    window_->resize(1440, 900);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    WatchedApplication::forget();
  }
  void TearDown() override {
    if (window_) {
      expect_no_stall(kStallMs);
    }
  }

  [[nodiscard]] gui::MainWindow& window() const { return *window_; }
  [[nodiscard]] gui::SceneEditor& editor() const { return window_->editor(); }
  [[nodiscard]] const geometric::Scene& scene() const { return *window_->document().scene(); }

  void select(const char* object) const {
    editor().select({gui::SceneItem::Kind::kObject, "", object});
  }
  template <typename Condition>
  [[nodiscard]] bool wait_for(Condition condition) const {
    return QTest::qWaitFor(condition, kPatienceMs);
  }
  void open(const std::filesystem::path& file) const {
    QSignalSpy ready(window_.get(), &gui::MainWindow::ready);
    QSignalSpy failed(window_.get(), &gui::MainWindow::failed);
    window_->open(QString::fromStdString(file.string()));
    ASSERT_TRUE(wait_for([&] { return !ready.isEmpty() || !failed.isEmpty(); }));
  }
  void trigger(const char* menu_text) const {
    for (QAction* action : window_->findChildren<QAction*>()) {
      if (!action->menu() &&
          action->text().remove(QLatin1Char('&')) == QString::fromUtf8(menu_text)) {
        ASSERT_TRUE(action->isEnabled()) << menu_text;
        action->trigger();
        return;
      }
    }
    FAIL() << "no command called " << menu_text;
  }
  [[nodiscard]] bool plan() const {
    QSignalSpy ended(&window_->session(), &gui::PlanningSession::ended);
    trigger("Plan");
    return wait_for([&] { return !ended.isEmpty(); }) && ended.front().front().toBool();
  }
  /// Waits until the window is at rest, and saves a picture of it.
  void picture(const QString& name) const { picture(name, *window_); }
  static void picture(const QString& name, QWidget& of) {
    QTest::qWait(150);
    const WatchedApplication::LooksAway taking_it_is_no_step_of_a_person;
    QDir().mkpath(QStringLiteral(HANDWAY_PICTURES));
    EXPECT_TRUE(of.grab().save(
        QDir(QStringLiteral(HANDWAY_PICTURES)).filePath(name + QStringLiteral(".png"))));
  }

  /// The scene as a file would have it.
  [[nodiscard]] std::string written() const {
    const std::filesystem::path file = folder_.path() / "scene.yaml";
    geometric::write_scene(scene(), file);
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  ScratchFolder folder_;
  std::unique_ptr<gui::MainWindow> window_;
};

}  // namespace handway::test
