#include "commands.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/robot_edits.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/given_grasps.h"
#include "numbers.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using geometric::Configuration;
using geometric::Pose;
using planning::ObjectNames;
using planning::SceneState;

/// Makes the edited state of a scene, with the first robot at `q`.
using Edit = std::function<SceneState(const SceneState& state, const Configuration& q)>;

/// Options of all edits, and what the results go to.
struct EditOptions {
  std::filesystem::path scene;
  std::filesystem::path out;
  int* exit_code = nullptr;
};

int run_edit(const EditOptions& options, const Edit& edit) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const SceneState state = planning::load_scene(options.scene, plugins);
  Configuration q;
  if (!state.scene->robots.empty()) {
    q = state.scene->start.value_or(state.scene->robots.front().configuration);
  }
  const SceneState edited = edit(state, q);
  geometric::write_scene(*edited.scene, options.out);
  print_out("Saved {}\n", options.out.string());
  return kDone;
}

CLI::App& add_edit(CLI::App& command, const std::shared_ptr<EditOptions>& options, const char* name,
                   const char* description, const Edit& edit) {
  CLI::App* added = command.add_subcommand(name, description);
  added->add_option("scene", options->scene, "Scene or problem file")->required();
  added->add_option("--out", options->out, "Scene file (YAML), replaced whole")->required();
  added->callback([options, edit] { *options->exit_code = run_edit(*options, edit); });
  return *added;
}

/// An edit of some objects of the scene, which are there.
Edit of_objects(const std::shared_ptr<ObjectNames>& names, const Edit& edit) {
  return [names, edit](const SceneState& state, const Configuration& q) {
    planning::need_objects(*state.scene, *names);
    return edit(state, q);
  };
}

void add_objects_option(CLI::App& command, const std::shared_ptr<ObjectNames>& names) {
  command.add_option("objects", *names, "Objects of the scene")->required();
}

template <typename Axis>
void add_axis_option(CLI::App& command, const char* name, Axis& axis, const char* description) {
  static const std::map<std::string, int> kAxes{{"x", 0}, {"y", 1}, {"z", 2}};
  command.add_option(name, axis, description)
      ->transform(CLI::CheckedTransformer(kAxes, CLI::ignore_case));
}

void add_triple_option(CLI::App& command, const char* name, std::vector<double>& values,
                       const char* description) {
  command.add_option(name, values, description)->expected(3)->check(number_in(-1e3, 1e3));
}

Eigen::Vector3d vector_of(const std::vector<double>& values) {
  return {values.at(0), values.at(1), values.at(2)};
}

Pose pose_of(const std::vector<double>& xyz, const std::vector<double>& rpy_deg) {
  const Eigen::Vector3d rpy = vector_of(rpy_deg) * geometric::radians(1.0);
  return geometric::pose_from_rpy(vector_of(xyz), rpy.x(), rpy.y(), rpy.z());
}

// The link of a robot or of a part of one, given as LINK or ROBOT/LINK.
planning::LinkOfRobot link_from(const geometric::Scene& scene, const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos && find_robot_with_part(scene, text.substr(0, slash))) {
    return {text.substr(0, slash), text.substr(slash + 1)};
  }
  if (scene.robots.empty()) {
    throw geometric::InputError({planning::source_of(scene), "robots", "none", "a robot", ""});
  }
  return {scene.robots.front().name, text};
}

void add_align(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  struct Settings {
    int axis = 0;
    planning::AlignTo to = planning::AlignTo::kCentre;
  };
  static const std::map<std::string, planning::AlignTo> kPlaces{
      {"min", planning::AlignTo::kLeast},
      {"centre", planning::AlignTo::kCentre},
      {"max", planning::AlignTo::kMost}};
  auto names = std::make_shared<ObjectNames>();
  auto settings = std::make_shared<Settings>();
  CLI::App& align = add_edit(
      command, options, "align", "Align objects with the last one along an axis of the world",
      of_objects(names, [names, settings](const SceneState& state, const Configuration& q) {
        return aligned(state, q, *names, settings->axis, settings->to);
      }));
  add_objects_option(align, names);
  add_axis_option(align, "--axis", settings->axis, "Axis: x (default), y or z");
  align
      .add_option("--to", settings->to, "Side of the bounding boxes: min, centre (default) or max")
      ->transform(CLI::CheckedTransformer(kPlaces, CLI::ignore_case));
}

void add_distribute(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  auto names = std::make_shared<ObjectNames>();
  auto axis = std::make_shared<int>(0);
  CLI::App& distribute =
      add_edit(command, options, "distribute", "Make the gaps between three or more objects equal",
               of_objects(names, [names, axis](const SceneState& state, const Configuration& q) {
                 return distributed(state, q, *names, *axis);
               }));
  add_objects_option(distribute, names);
  add_axis_option(distribute, "--axis", *axis, "Axis: x (default), y or z");
}

void add_move(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  auto names = std::make_shared<ObjectNames>();
  auto by = std::make_shared<std::vector<double>>(3, 0.0);
  CLI::App& move =
      add_edit(command, options, "move", "Move objects in the world",
               of_objects(names, [names, by](const SceneState& state, const Configuration& q) {
                 return moved(state, q, *names, Pose(Eigen::Translation3d(vector_of(*by))));
               }));
  add_objects_option(move, names);
  add_triple_option(move, "--by", *by, "Shift along x, y and z of the world, m");
}

void add_array(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  struct Settings {
    std::vector<int> count{2, 1, 1};
    std::vector<double> spacing{0.1, 0.1, 0.1};
    std::optional<int> around;
    planning::CircularArray circle;
    std::vector<double> centre{0.0, 0.0, 0.0};
    double angle_deg = 360.0;
    bool keep_orientation = false;

    [[nodiscard]] std::vector<Pose> motions(const SceneState& state, const Configuration& q,
                                            const ObjectNames& names) const {
      if (!around) {
        return planning::LinearArray{{count.at(0), count.at(1), count.at(2)}, vector_of(spacing)}
            .motions();
      }
      planning::CircularArray array = circle;
      array.axis = *around;
      array.centre = vector_of(centre);
      array.angle = geometric::radians(angle_deg);
      array.turning = !keep_orientation;
      return array.motions(bounds(*state.scene, q, names).centre());
    }
  };
  auto names = std::make_shared<ObjectNames>();
  auto settings = std::make_shared<Settings>();
  CLI::App& array = add_edit(
      command, options, "array", "Copy objects in rows or around an axis",
      of_objects(names, [names, settings](const SceneState& state, const Configuration& q) {
        planning::Copies made = copied(state, q, *names, settings->motions(state, q, *names));
        print_out("Added {}\n", fmt::join(made.names, ", "));
        return made.state;
      }));
  add_objects_option(array, names);
  array
      .add_option("--count", settings->count,
                  "Rows: number along x, y and z, the original included (default 2 1 1)")
      ->expected(3)
      ->check(CLI::Range(1, 100));
  add_triple_option(array, "--spacing", settings->spacing,
                    "Rows: distance of neighbours along x, y and z, m (default 0.1 0.1 0.1)");
  add_axis_option(array, "--around", settings->around,
                  "Circle instead of rows: around this axis, x, y or z, of the world");
  array.add_option("--copies", settings->circle.count, "Circle: number, the original included")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  add_triple_option(array, "--centre", settings->centre,
                    "Circle: a point of the axis, m (default 0 0 0)");
  array
      .add_option("--angle-deg", settings->angle_deg,
                  "Circle: angle from the first to the last; 360 spreads them evenly")
      ->check(number_in(-360.0, 360.0))
      ->capture_default_str();
  array.add_flag("--keep-orientation", settings->keep_orientation,
                 "Circle: shift the copies without turning them");
}

void add_drop(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  auto names = std::make_shared<ObjectNames>();
  CLI::App& drop =
      add_edit(command, options, "drop", "Drop objects onto the surface below them, or the floor",
               of_objects(names, [names](const SceneState& state, const Configuration& q) {
                 return dropped(state, q, *names);
               }));
  add_objects_option(drop, names);
}

void add_attach(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  struct Settings {
    std::string link;
    std::vector<std::string> touching;
  };
  auto names = std::make_shared<ObjectNames>();
  auto settings = std::make_shared<Settings>();
  CLI::App& attach = add_edit(
      command, options, "attach", "Attach objects to a link where they are at the start",
      of_objects(names, [names, settings](const SceneState& state, const Configuration& q) {
        return attached(state, q, *names, link_from(*state.scene, settings->link),
                        settings->touching);
      }));
  add_objects_option(attach, names);
  attach.add_option("--link", settings->link, "Link of the first robot, or ROBOT/LINK")->required();
  attach
      .add_option("--touching", settings->touching,
                  "Link that may touch the objects; may be given several times")
      ->allow_extra_args(false);
}

void add_detach(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  auto names = std::make_shared<ObjectNames>();
  CLI::App& detach =
      add_edit(command, options, "detach", "Detach objects where they are at the start",
               of_objects(names, [names](const SceneState& state, const Configuration& q) {
                 return detached(state, q, *names);
               }));
  add_objects_option(detach, names);
}

void add_mount(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  struct Settings {
    std::string robot;
    std::string link;
    std::vector<double> xyz{0.0, 0.0, 0.0};
    std::vector<double> rpy_deg{0.0, 0.0, 0.0};
  };
  auto settings = std::make_shared<Settings>();
  CLI::App& mount = add_edit(
      command, options, "mount", "Mount a robot of the scene on a link of another one",
      [settings](const SceneState& state, const Configuration& q) {
        return with_mount(state, q, settings->robot, link_from(*state.scene, settings->link),
                          pose_of(settings->xyz, settings->rpy_deg));
      });
  mount.add_option("robot", settings->robot, "Robot that is mounted")->required();
  mount.add_option("--link", settings->link, "Link of the first robot, or ROBOT/LINK")->required();
  add_triple_option(mount, "--xyz", settings->xyz, "Position of its base in the link, m");
  add_triple_option(mount, "--rpy-deg", settings->rpy_deg,
                    "Roll, pitch and yaw of its base in the link, degrees");
}

void add_unmount(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  auto robot = std::make_shared<std::string>();
  CLI::App& unmount =
      add_edit(command, options, "unmount", "Take a mounted robot off: it stays where it is",
               [robot](const SceneState& state, const Configuration& q) {
                 return without_mount(state, q, *robot);
               });
  unmount.add_option("robot", *robot, "Robot that is mounted")->required();
}

void add_frame(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  struct Settings {
    std::string name;
    std::string on;
    std::vector<double> xyz{0.0, 0.0, 0.0};
    std::vector<double> rpy_deg{0.0, 0.0, 0.0};
  };
  auto settings = std::make_shared<Settings>();
  CLI::App& frame = add_edit(
      command, options, "frame", "Add a named frame, or replace the one of its name",
      [settings](const SceneState& state, const Configuration& /*q*/) {
        return with_frame(
            state, {settings->name, settings->on, pose_of(settings->xyz, settings->rpy_deg)});
      });
  frame.add_option("name", settings->name, "Name of the frame")->required();
  frame.add_option("--on", settings->on,
                   "Object or link of the first robot that it is fixed to; else the world");
  add_triple_option(frame, "--xyz", settings->xyz, "Position in the object, link or world, m");
  add_triple_option(frame, "--rpy-deg", settings->rpy_deg, "Roll, pitch and yaw there, degrees");
}

void add_grasps(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  struct Settings {
    std::string object;
    std::filesystem::path file;
  };
  auto settings = std::make_shared<Settings>();
  CLI::App& grasps =
      add_edit(command, options, "grasps", "Make a file of grasps that of an object, for tasks",
               [settings](const SceneState& state, const Configuration& /*q*/) {
                 planning::need_object(*state.scene, settings->object);
                 return with_grasps(state, settings->object, settings->file);
               });
  grasps.add_option("object", settings->object, "Object of the scene")->required();
  grasps.add_option("file", settings->file, "File of grasps (YAML or JSON)")->required();
}

void add_remove(CLI::App& command, const std::shared_ptr<EditOptions>& options) {
  auto names = std::make_shared<ObjectNames>();
  CLI::App& remove =
      add_edit(command, options, "remove", "Remove objects and the settings about them",
               of_objects(names, [names](const SceneState& state, const Configuration& /*q*/) {
                 return without_objects(state, *names);
               }));
  add_objects_option(remove, names);
}

}  // namespace

void add_edit_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<EditOptions>();
  options->exit_code = &exit_code;
  CLI::App* command = app.add_subcommand("edit", "Edit a scene file");
  command->require_subcommand(1);
  for (const auto& add : {add_align, add_distribute, add_move, add_array, add_drop, add_attach,
                          add_detach, add_frame, add_grasps, add_mount, add_unmount, add_remove}) {
    add(*command, options);
  }
}

}  // namespace handway::tools
