#include "app/main_window.h"
#include "app/options.h"
#include "app/snapshot.h"
#include "features/workbench.h"
#include "model/devices/motion_driver.h"
#include "model/settings/preferences.h"
#include "view3d/scene_view.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QSettings>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace gui = handway::gui;
namespace planning = handway::planning;

namespace {

bool has_display() {
  return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY") || std::getenv("QT_QPA_PLATFORM");
}

gui::Theme theme_of(const gui::Options& options) {
  const QString kept = QSettings().value(QStringLiteral("theme")).toString();
  const QString wanted = options.theme.empty() ? kept : QString::fromStdString(options.theme);
  return wanted == QLatin1String("dark") ? gui::Theme::kDark : gui::Theme::kLight;
}

int run(QApplication& application, const gui::Options& options) {
  auto plugins = std::make_shared<planning::PluginManager>();
  plugins->load_plugins(planning::plugin_directory());
  gui::MainWindow window(plugins);
  const gui::ProgramEnd end(window.workbench().driver);
  if (options.size || !options.screenshot.empty()) {
    window.resize(options.size.value_or(gui::kUsualSize));
  } else {
    gui::restore_geometry(window, gui::kUsualSize);
  }
  if (options.view_only) {
    window.view().setFixedSize(options.size.value_or(gui::kUsualSize));
  }

  std::unique_ptr<gui::Snapshot> snapshot;
  if (!options.screenshot.empty()) {
    snapshot = std::make_unique<gui::Snapshot>(window, options);
    QObject::connect(snapshot.get(), &gui::Snapshot::done, &application,
                     [](int exit_code, const QString& problem) {
                       if (exit_code != 0) {
                         std::fprintf(stderr, "handway-workbench: %s\n", qPrintable(problem));
                       }
                       QCoreApplication::exit(exit_code);
                     });
  }
  window.show();
  QMetaObject::invokeMethod(
      &window, [&] { window.begin(options); }, Qt::QueuedConnection);
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  int exit_code = 0;
  const std::optional<gui::Options> options = gui::parse_options(argc, argv, exit_code);
  if (!options) {
    return exit_code;
  }
  if (!has_display()) {
    std::fputs(
        "handway-workbench: no display. Use `handway plan` here, or start it under xvfb-run\n",
        stderr);
    return 2;
  }
  QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QApplication application(argc, argv);
  QApplication::setOrganizationName(QStringLiteral("handway"));
  QApplication::setApplicationName(QStringLiteral("handway-workbench"));
  QApplication::setApplicationVersion(QStringLiteral(HANDWAY_VERSION));
  const int text_size = options->text_size.value_or(gui::Preferences().values().text_size);
  gui::apply_theme(application, theme_of(*options), text_size / 100.0);
  QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/handway.svg")));
  return run(application, *options);
}
