#pragma once

#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"
#include "handway/planning/extensions/exporter.h"
#include "handway/planning/planners/planner.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace handway::planning {

class HoldTest;

/// Reads problems or robots of a third-party format.
class HANDWAY_PLANNING_EXPORT Importer {
 public:
  virtual ~Importer() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// Tests the name and the first bytes; must not throw on any readable file.
  [[nodiscard]] virtual bool can_read(const std::filesystem::path& file) const = 0;
  /// @throws InputError naming file, element, the value found and the expected one.
  [[nodiscard]] virtual SceneState read(const std::filesystem::path& file) const = 0;
};

/// Makes the simulation of grasps of an object of the problem's scene by the hand with this palm (a
/// link of its robot). @throws InputError if something of them can't be simulated.
using MakeHoldTest = std::unique_ptr<HoldTest> (*)(const PlanningProblem& problem,
                                                   std::string_view object, int palm);

/// Raised whenever a plugin built against an older header would misbehave.
inline constexpr int kPluginApiVersion = 12;

/// Hash of the sizes of shared types: it differs for most other versions of the headers.
inline constexpr std::uint64_t kPluginLayout = [] {
  std::uint64_t layout = 0;
  for (const std::size_t size :
       {sizeof(geometric::RobotDescription), sizeof(geometric::RobotModel),
        sizeof(geometric::SceneObject), sizeof(geometric::Scene), sizeof(sampling::PmdBasis),
        sizeof(PlanningProblem), sizeof(PlanRequest), sizeof(PlanResult), sizeof(PlanningContext),
        sizeof(MotionValidator), sizeof(Planner), sizeof(Motion)}) {
    layout = 31 * layout + size;
  }
  return layout;
}();

/// Interface of a plugin library: a struct with this layout, exported as `extern "C" const
/// handway::planning::Plugin* handway_plugin()`.
struct Plugin {
  int api_version = kPluginApiVersion;
  const char* name = "";
  const char* version = "";
  void (*register_planners)(PlannerRegistry& registry) = nullptr;        ///< May be null.
  std::unique_ptr<Importer> (*make_importer)() = nullptr;                ///< May be null.
  std::vector<std::unique_ptr<Exporter>> (*make_exporters)() = nullptr;  ///< May be null.
  /// Exporters of whole scenes; may be null.
  std::vector<std::unique_ptr<SceneExporter>> (*make_scene_exporters)() = nullptr;
  std::vector<geometric::RobotReader> (*make_robot_readers)() = nullptr;  ///< May be null.
  MakeHoldTest make_hold_test = nullptr;                                  ///< May be null.
  std::uint64_t layout = kPluginLayout;
};

/// Defines `handway_plugin()`, once in a library, which returns the Plugin `{…}`. Weak, so that a
/// program can link the code of several.
#define HANDWAY_PLUGIN(...)                                                                \
  extern "C" __attribute__((visibility("default"), weak)) const handway::planning::Plugin* \
  handway_plugin() {                                                                       \
    static const handway::planning::Plugin kPlugin = __VA_ARGS__;                          \
    return &kPlugin;                                                                       \
  }                                                                                        \
  static_assert(true)

/// A loaded plugin.
struct LoadedPlugin {
  std::filesystem::path file;
  std::string name;
  std::string version;
};

/// A refused plugin file, with the reason.
struct RefusedPlugin {
  std::filesystem::path file;
  std::string reason;
};

/// The plugins that a program has loaded, and its planners.
class HANDWAY_PLANNING_EXPORT PluginManager {
 public:
  PluginManager() = default;

  /// Loads every library of `directory` (none if it does not exist), in the order of their names. A
  /// file that is no plugin, was built against other headers, has the name of a loaded one or fails
  /// to register is listed as refused and adds nothing. Libraries stay loaded for the life of the
  /// program.
  void load_plugins(const std::filesystem::path& directory);

  [[nodiscard]] PlannerRegistry& planners() { return planners_; }
  [[nodiscard]] const PlannerRegistry& planners() const { return planners_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Importer>>& importers() const {
    return importers_;
  }
  [[nodiscard]] const std::vector<std::unique_ptr<Exporter>>& exporters() const {
    return exporters_;
  }
  [[nodiscard]] const std::vector<std::unique_ptr<SceneExporter>>& scene_exporters() const {
    return scene_exporters_;
  }
  /// Returns the exporter of that name, or null.
  [[nodiscard]] const SceneExporter* find_scene_exporter(const std::string& name) const;
  /// @throws InputError with the valid names, if none is called `name`.
  [[nodiscard]] const Exporter& exporter(const std::string& name) const;
  /// The simulation of grasps; null if no plugin has one.
  [[nodiscard]] MakeHoldTest hold_test_maker() const { return make_hold_test_; }
  [[nodiscard]] const std::vector<LoadedPlugin>& loaded() const { return loaded_; }
  [[nodiscard]] const std::vector<RefusedPlugin>& refused() const { return refused_; }

 private:
  void add(const Plugin& plugin, const std::filesystem::path& file);

  PlannerRegistry planners_;
  std::vector<std::unique_ptr<Importer>> importers_;
  std::vector<std::unique_ptr<Exporter>> exporters_;
  std::vector<std::unique_ptr<SceneExporter>> scene_exporters_;
  MakeHoldTest make_hold_test_ = nullptr;
  std::vector<LoadedPlugin> loaded_;
  std::vector<RefusedPlugin> refused_;
};

/// $HANDWAY_PLUGIN_DIR, or lib/handway-plugins beside the program's bin/, or, if that is missing,
/// handway-plugins beside this library.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::filesystem::path plugin_directory();

}  // namespace handway::planning
