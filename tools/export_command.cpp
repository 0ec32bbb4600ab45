#include "commands.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "printing.h"
#include "scene_options.h"
#include "timing_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

struct ExportChoice {
  TimingChoice timing;
  std::string to;
  std::filesystem::path out;
  planning::ExportOptions options;
};

int export_scene(const ExportChoice& choice, const planning::SceneExporter& exporter,
                 const planning::PluginManager& plugins) {
  if (!choice.timing.path.empty()) {
    throw CLI::ValidationError("path", "--to " + choice.to + " exports a scene: omit the path");
  }
  planning::SceneState loaded = planning::load_scene(choice.timing.scene, plugins);
  set_group(choice.timing.group, loaded);
  print_warnings(*loaded.scene);
  for (const std::filesystem::path& file : exporter.write(*loaded.scene, choice.out)) {
    print_out("{}\n", file.string());
  }
  return kDone;
}

int run_export(ExportChoice choice) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  if (const planning::SceneExporter* exporter = plugins.find_scene_exporter(choice.to)) {
    return export_scene(choice, *exporter, plugins);
  }
  if (choice.timing.path.empty()) {
    throw CLI::RequiredError("path");
  }
  const planning::Exporter& exporter = plugins.exporter(choice.to);
  choice.timing.settings = exporter.settings_for(choice.timing.settings);
  const planning::TimedPath timed = run_timing(choice.timing, plugins);
  std::vector<std::filesystem::path> written;
  if (timed.cleared()) {
    written = exporter.write(timed.motion, choice.out, choice.options);
  }
  print_timing(timed);
  for (const std::filesystem::path& file : written) {
    print_out("{}\n", file.string());
  }
  return timed.cleared() ? kDone : kNoPath;
}

}  // namespace

void add_export_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<ExportChoice>();
  CLI::App* command = app.add_subcommand(
      "export", "Time a path and write it for a controller, or export a scene to other programs");
  add_timing_options(*command, choice->timing);
  command->get_option("path")->required(false)->description(
      "Path (CSV); omit it to export a scene");
  command
      ->add_option(
          "--to", choice->to,
          "Format of a path: csv, split, urscript, urscript-servo, krl, rapid, val3, franka, "
          "ros, moveit, or a plugin's; of a scene: gltf, moveit-scene")
      ->required();
  command->add_option("--out", choice->out, "Folder for the files; created if it does not exist")
      ->required();
  command->add_flag("--any-robot", choice->options.any_robot,
                    "Export even if the format does not seem to suit this robot");
  command->callback([choice, &exit_code] { exit_code = run_export(*choice); });
}

}  // namespace handway::tools
