#include "handway/planning/extensions/plugin.h"

#include "handway/geometric/io/input_error.h"

#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using boost::dll::shared_library;

constexpr const char* kEntryPoint = "handway_plugin";

// Libraries stay loaded to the very end: objects made by their code may live as long as the
// program.
void keep_loaded(shared_library library) {
  static auto& libraries = *new std::vector<shared_library>;
  libraries.push_back(std::move(library));
}

// Folder of the library with this code: other programs, such as Python, load it too.
fs::path library_folder() {
  return fs::path(boost::dll::this_line_location().string()).parent_path();
}

std::vector<fs::path> libraries_in(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, error)) {
    if (entry.path().extension() == shared_library::suffix().string() &&
        entry.is_regular_file(error)) {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

// Checks that only trusted users could write the file: a plugin may do whatever the program may.
// @throws std::runtime_error naming the other users.
void need_trusted(const fs::path& path) {
  struct stat state {};
  if (::stat(path.c_str(), &state) != 0) {
    throw std::runtime_error(std::strerror(errno));
  }
  if (state.st_uid != 0 && state.st_uid != ::geteuid()) {
    throw std::runtime_error(
        fmt::format("{} belongs to another user ({}): only plugins of your own or of the system "
                    "are loaded",
                    path.string(), state.st_uid));
  }
  if ((state.st_mode & S_IWOTH) != 0) {
    throw std::runtime_error(fmt::format(
        "every user may write to {0}: remove this permission (chmod o-w {0})", path.string()));
  }
}

// The library's Plugin. @throws std::runtime_error with the reason if it has none.
const Plugin& open_plugin(const fs::path& file) {
  shared_library library;
  try {
    library.load(boost::filesystem::path(file.string()));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("not a library that can be loaded: {}", error.what()));
  }
  if (!library.has(kEntryPoint)) {
    throw std::runtime_error(fmt::format("not a plugin: it has no function {}", kEntryPoint));
  }
  const Plugin* plugin = library.get<const Plugin*()>(kEntryPoint)();
  keep_loaded(std::move(library));
  if (plugin == nullptr) {
    throw std::runtime_error(fmt::format("{} returned nothing", kEntryPoint));
  }
  if (plugin->api_version != kPluginApiVersion) {
    throw std::runtime_error(fmt::format("made for version {} of the plugin interface, not {}",
                                         plugin->api_version, kPluginApiVersion));
  }
  if (plugin->layout != kPluginLayout) {
    throw std::runtime_error("built against other headers of Handway: build it again");
  }
  return *plugin;
}

}  // namespace

void PluginManager::load_plugins(const fs::path& directory) {
  const std::vector<fs::path> files = libraries_in(directory);
  if (files.empty()) {
    return;
  }
  try {
    need_trusted(directory);
  } catch (const std::exception& error) {
    refused_.push_back({directory, error.what()});
    return;
  }
  for (const fs::path& file : files) {
    try {
      need_trusted(file);
      add(open_plugin(file), file);
    } catch (const std::exception& error) {
      refused_.push_back({file, error.what()});
    }
  }
}

void PluginManager::add(const Plugin& plugin, const fs::path& file) {
  const auto same = std::ranges::find(loaded_, plugin.name, &LoadedPlugin::name);
  if (same != loaded_.end()) {
    throw std::runtime_error(
        fmt::format("plugin {} is loaded already, from {}", plugin.name, same->file.string()));
  }
  // All or nothing: the registry is replaced only if nothing has thrown.
  PlannerRegistry planners = planners_;
  if (plugin.register_planners != nullptr) {
    plugin.register_planners(planners);
  }
  const auto made = [](const auto& make) { return make ? make() : decltype(make())(); };
  auto exporters = made(plugin.make_exporters);
  auto scene_exporters = made(plugin.make_scene_exporters);
  const auto robot_readers = made(plugin.make_robot_readers);
  if (auto importer = made(plugin.make_importer)) {
    importers_.push_back(std::move(importer));
  }
  std::ranges::move(exporters, std::back_inserter(exporters_));
  std::ranges::move(scene_exporters, std::back_inserter(scene_exporters_));
  std::ranges::for_each(robot_readers, geometric::register_robot_reader);
  if (plugin.make_hold_test != nullptr) {
    make_hold_test_ = plugin.make_hold_test;
  }
  planners_ = std::move(planners);
  loaded_.push_back({file, plugin.name, plugin.version});
}

const SceneExporter* PluginManager::find_scene_exporter(const std::string& name) const {
  const auto found = std::ranges::find_if(
      scene_exporters_, [&](const auto& exporter) { return exporter->name() == name; });
  return found == scene_exporters_.end() ? nullptr : found->get();
}

const Exporter& PluginManager::exporter(const std::string& name) const {
  std::vector<std::string> names;
  for (const std::unique_ptr<Exporter>& exporter : exporters_) {
    if (exporter->name() == name) {
      return *exporter;
    }
    names.push_back(exporter->name());
  }
  for (const std::unique_ptr<SceneExporter>& exporter : scene_exporters_) {
    names.push_back(exporter->name());
  }
  throw geometric::InputError({"--to", "", "\"" + name + "\"",
                               names.empty() ? "a format (no plugin exports any)" : "a format",
                               geometric::advise_name(name, names)});
}

fs::path plugin_directory() {
  if (const char* directory = std::getenv("HANDWAY_PLUGIN_DIR");
      directory != nullptr && *directory != '\0') {
    return directory;
  }
  const fs::path program = boost::dll::program_location().string();
  const fs::path folder = program.parent_path().parent_path() / "lib" / "handway-plugins";
  std::error_code error;
  return fs::is_directory(folder, error) ? folder : library_folder() / "handway-plugins";
}

}  // namespace handway::planning
