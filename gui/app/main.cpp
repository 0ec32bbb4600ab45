#include "app/main_window.h"
#include "app/snapshot.h"
#include "features/workbench.h"
#include "handway/geometric/formats/xacro_file.h"
#include "handway/geometric/io/input_error.h"
#include "model/devices/program_end.h"
#include "model/settings/options.h"
#include "model/settings/preferences.h"
#include "view3d/scene_view.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/desktop_theme.h"
#include "widgets/style/theme.h"

#include <QApplication>

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gui = handway::gui;
namespace planning = handway::planning;

namespace {

constexpr int kWrongUsage = 2;

// "1440x900"
std::optional<QSize> parse_size(const std::string& text) {
  int width = 0, height = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != 'x') {
    return std::nullopt;
  }
  const auto second = std::from_chars(first.ptr + 1, end, height);
  if (second.ec != std::errc() || second.ptr != end || width < 640 || height < 480 ||
      width > 16384 || height > 16384) {
    return std::nullopt;
  }
  return QSize(width, height);
}

std::string check_size(const std::string& text) {
  return parse_size(text) ? "" : "\"" + text + "\" is not WIDTHxHEIGHT of at least 640x480";
}

std::string check_not_empty(const std::string& text) {
  return text.empty() ? "found an empty text, expected a value" : "";
}

std::string check_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  return equals == std::string::npos || equals == 0 ? "\"" + text + "\" is not KEY=VALUE" : "";
}

std::string check_xacro(const std::string& text) {
  try {
    static_cast<void>(handway::geometric::xacro_argument_of(text, "--xacro"));
  } catch (const handway::geometric::InputError& error) {
    return error.what();
  }
  return "";
}

// Prints help or what is wrong itself. @param[out] exit_code what to end with if nothing is
// returned.
std::optional<gui::Options> parse_options(int argc, char** argv, int& exit_code) {
  gui::Options options;
  std::string size;
  std::vector<std::string> settings;
  std::vector<std::string> xacro;
  CLI::App app("The Handway workbench: see, plan and play hand-arm motions.");
  app.add_option("scene", options.scene, "Scene or problem file to open");
  app.add_option("--xacro", xacro, "Argument of the scene, a robot file in xacro")
      ->type_name("NAME:=VALUE")
      ->expected(1)
      ->check(check_xacro)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--screenshot", options.screenshot, "Save a picture of the window and exit")
      ->type_name("OUT.png");
  app.add_flag("--view-only", options.view_only,
               "Save a picture of the 3-D view only, with this size");
  app.add_option("--size", size,
                 "Size of the window (default: the last one; for pictures 1440x900)")
      ->type_name("WxH")
      ->check(check_size);
  app.add_option("--path", options.path, "Show this path or trajectory (CSV, YAML, JSON)")
      ->type_name("FILE");
  app.add_flag("--play", options.play,
               "Plan at the start, unless a path is given, then play the path in a loop");
  app.add_option("--planner", options.planner, "Planner (default: the scene's)");
  app.add_option("--seed", options.seed, "Seed of all random choices");
  app.add_option("--set", settings, "Parameter of the planner")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->check(check_setting)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--glove", options.glove,
                 "Glove to connect to: a port, HOST:PORT, a recording, or \"emulator\"")
      ->type_name("DEVICE");
  app.add_option("--glove-page", options.glove_page, "Page of the glove panel to open")
      ->type_name("NAME");
  app.add_option("--campaign", options.campaign,
                 "Campaign (.yaml) to execute, or run database (.sqlite) to show");
  app.add_option(
         "--tracker", options.tracker,
         "Wrist tracker that leads the arm: \"emulator\", fastrak:PORT, liberty:PORT, udp:PORT")
      ->type_name("DEVICE");
  app.add_option("--glove-time", options.glove_time,
                 "Time to read glove and tracker before a screenshot, s (default 3)")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--theme", options.theme, "light or dark (default: as in the preferences)")
      ->check(CLI::IsMember({"light", "dark"}));
  app.add_option("--text-size", options.text_size,
                 "Size of text, in percent (default: as in the preferences)")
      ->check(CLI::Range(100, 200));
  for (CLI::Option* option : app.get_options()) {
    option->check(check_not_empty);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : kWrongUsage;
    return std::nullopt;
  }
  options.size = parse_size(size);
  for (const std::string& argument : xacro) {
    const auto [name, value] = handway::geometric::xacro_argument_of(argument, "--xacro");
    options.xacro[name] = value;
  }
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    options.settings.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  return options;
}

bool has_display() {
  return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY") || std::getenv("QT_QPA_PLATFORM");
}

gui::Theme theme_of(const gui::Options& options, const gui::PreferenceValues& preferences) {
  if (!options.theme.empty()) {
    return options.theme == "dark" ? gui::Theme::kDark : gui::Theme::kLight;
  }
  return preferences.theme ? *preferences.theme : gui::desktop_theme();
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
  const std::optional<gui::Options> options = parse_options(argc, argv, exit_code);
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
  const gui::PreferenceValues preferences = gui::Preferences().values();
  const int text_size = options->text_size.value_or(preferences.text_size);
  gui::apply_theme(application, theme_of(*options, preferences), text_size / 100.0);
  QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/handway.svg")));
  return run(application, *options);
}
