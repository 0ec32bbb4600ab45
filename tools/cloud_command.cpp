#include "commands.h"
#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/formats/depth_image.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/edits/cloud_import.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "numbers.h"
#include "parameter_options.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::Pose;

struct CloudOptions {
  fs::path file;
  fs::path scene;
  fs::path out;
  std::vector<double> camera;  ///< fx, fy, cx, cy.
  geometric::DepthCamera depth;
  std::vector<double> xyz{0.0, 0.0, 0.0};
  std::vector<double> rpy_deg{0.0, 0.0, 0.0};
  bool is_optical = false;
  std::string name = "cloud";
  planning::CloudImport import;  ///< Its described settings.
  CLI::Option* cell = nullptr;
  bool keeps_robot = false;
  bool keeps_outliers = false;
  std::vector<double> box;
  std::vector<std::string> cut_out;
  bool hides = false;
};

Eigen::Vector3d vector_at(const std::vector<double>& values, std::size_t first = 0) {
  return {values.at(first), values.at(first + 1), values.at(first + 2)};
}

/// Returns the pose of the points in the world.
Pose pose_of(const CloudOptions& options) {
  const Eigen::Vector3d rpy = geometric::radians(1.0) * vector_at(options.rpy_deg);
  Pose X_WC = geometric::pose_from_rpy(vector_at(options.xyz), rpy.x(), rpy.y(), rpy.z());
  if (options.is_optical) {
    X_WC.linear() = X_WC.linear() * geometric::optical_frame();
  }
  return X_WC;
}

geometric::DepthCamera camera_of(const CloudOptions& options) {
  geometric::DepthCamera camera = options.depth;
  camera.focal = {options.camera.at(0), options.camera.at(1)};
  camera.centre = {options.camera.at(2), options.camera.at(3)};
  return camera;
}

geometric::PointCloud read_points(const CloudOptions& options) {
  if (options.camera.empty()) {
    if (geometric::is_image_file(options.file)) {
      throw geometric::InputError({options.file.string(), "", "a depth image without its camera",
                                   "--camera FX FY CX CY",
                                   "They are K[0], K[4], K[2] and K[5] of "
                                   "ROS's CameraInfo"});
    }
    geometric::ReadCloud read = geometric::read_cloud(options.file);
    for (const std::string& warning : read.warnings) {
      print_error("handway: {}\n", warning);
    }
    return std::move(read.cloud);
  }
  geometric::PointCloud cloud = geometric::read_depth_image(options.file, camera_of(options));
  constexpr double kNearest = 0.05;  // m; no camera measures nearer
  double farthest = 0.0;
  for (const Eigen::Vector3f& point : cloud.points) {
    farthest = std::max(farthest, static_cast<double>(point.z()));
  }
  if (farthest < kNearest) {
    print_error(
        "handway: {}: the farthest depth is {:g} m; is --depth-unit right? It is 1 for "
        "depths in m\n",
        options.file.string(), farthest);
  }
  return cloud;
}

void print_cloud(const fs::path& file, const geometric::PointCloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : cloud.points) {
    box.extend(point);
  }
  print_out("{}: {} points{}, {:.3f} × {:.3f} × {:.3f} m around ({:.3f}, {:.3f}, {:.3f}) m\n",
            file.string(), cloud.size(), cloud.colors.empty() ? "" : " with colours",
            box.sizes().x(), box.sizes().y(), box.sizes().z(), box.center().x(), box.center().y(),
            box.center().z());
}

planning::CloudImport import_of(const CloudOptions& options, const geometric::PointCloud& cloud) {
  planning::CloudImport import = options.import;
  import.name = options.name;
  import.X_WC = pose_of(options);
  if (options.cell->count() == 0) {
    import.cells.size = geometric::usual_cells(cloud).size;
  }
  if (!options.box.empty()) {
    import.box = geometric::Aabb{vector_at(options.box), vector_at(options.box, 3)};
  }
  if (options.keeps_outliers) {
    import.outliers.reset();
  }
  if (options.hides) {
    import.hidden_from = camera_of(options);
  }
  import.bodies.robots = !options.keeps_robot;
  import.bodies.objects = options.cut_out;
  return import;
}

void print_object(const geometric::SceneObject& object) {
  if (const auto* cloud = std::get_if<geometric::Cloud>(&object.shape)) {
    print_out("Object {}: {} points in cells of {:g} mm, {} triangles\n", object.name,
              cloud->points->size(), geometric::millimetres(cloud->cells.size),
              cloud->surface->triangles.size());
    return;
  }
  const Eigen::Vector3d size = geometric::bounding_box(*geometric::tessellate(object.shape)).size();
  const Eigen::Vector3d place = object.X_PO.translation();
  print_out("Object {}: {} of {:.0f} × {:.0f} × {:.0f} mm at ({:.3f}, {:.3f}, {:.3f}) m\n",
            object.name, geometric::shape_name(object.shape), geometric::millimetres(size.x()),
            geometric::millimetres(size.y()), geometric::millimetres(size.z()), place.x(),
            place.y(), place.z());
}

int add_to_scene(const CloudOptions& options, geometric::PointCloud cloud) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const planning::SceneState state = planning::load_scene(options.scene, plugins);
  const geometric::Scene& scene = *state.scene;
  const planning::CloudImport import = import_of(options, cloud);
  const planning::ImportedCloud made =
      planning::import_cloud(scene, scene.start.value_or(scene.robots.front().configuration),
                             std::move(cloud), import, options.file.string());
  print_out(
      "Left out: {} points outside of the box, {} of robots and cut-out objects, {} outliers\n",
      made.outside, made.of_bodies, made.outliers);
  if (options.hides) {
    print_out("Hidden: {} cells of {:g} mm\n", made.hidden,
              geometric::millimetres(import.cells.size));
  }
  for (const geometric::SceneObject& object : made.objects) {
    print_object(object);
  }
  geometric::write_scene(*planning::with_cloud(state, made).scene, options.out);
  print_out("Saved {}\n", options.out.string());
  return kDone;
}

int run_cloud(const CloudOptions& options) {
  geometric::PointCloud cloud = read_points(options);
  print_cloud(options.file, cloud);
  if (!options.scene.empty()) {
    return add_to_scene(options, std::move(cloud));
  }
  if (!options.out.empty()) {
    if (!geometric::has_extension(options.out, ".ply")) {
      throw geometric::InputError(
          {"--out", "", options.out.string(), "a file .ply", "With --scene it is a scene (.yaml)"});
    }
    geometric::write_ply(cloud, options.out);
    print_out("Saved {}\n", options.out.string());
  }
  return kDone;
}

void add_reading(CLI::App& command, CloudOptions& options) {
  command
      .add_option("file", options.file,
                  "Points (.pcd, .ply, .xyz, .pts, .asc, .txt, .csv, .npy), octomap (.bt, .ot), or "
                  "depth image (.png, .npy)")
      ->required();
  command
      .add_option("--camera", options.camera,
                  "Of a depth image: focal lengths and centre, pixels (FX FY CX CY)")
      ->expected(4)
      ->check(number_in(0.0, 1e5));
  command.add_option("--depth-unit", options.depth.unit, "Of a depth image: metres for 1")
      ->check(number_in(1e-6, 1e3))
      ->capture_default_str();
  command
      .add_option("--farthest", options.depth.farthest,
                  "Of a depth image: depths beyond are left out, m")
      ->check(number_in(0.0, 100.0))
      ->capture_default_str();
}

void add_placing(CLI::App& command, CloudOptions& options) {
  command.add_option("--xyz", options.xyz, "Place of the points' frame in the world, m")
      ->expected(3)
      ->check(number_in(-1e3, 1e3));
  command.add_option("--rpy-deg", options.rpy_deg, "Its roll, pitch and yaw")
      ->expected(3)
      ->check(number_in(-360.0, 360.0));
  command.add_flag(
      "--optical", options.is_optical,
      "The points are in a camera's optical frame (z forwards, y down), and the pose is "
      "that of its body (x forwards, z up)");
}

void add_hidden_space(CLI::App& command, CloudOptions& options) {
  command
      .add_flag("--hidden", options.hides,
                "Of a depth image: make what its points hide an object as well, within --box or "
                "the bounding box of all points; else it is free")
      ->needs(command.get_option("--camera"));
}

void add_filters(CLI::App& command, CloudOptions& options) {
  add_parameter_options(command, parameters_of(options.import));
  options.cell = command.get_option("--cell-mm");
  options.cell->default_str("10; of an octomap its own");
  command
      .add_option("--box", options.box,
                  "Leave out points outside of a box of the world, m (X0 Y0 Z0 X1 Y1 Z1)")
      ->expected(6)
      ->check(number_in(-1e3, 1e3));
  command.add_option("--cut-out", options.cut_out, "Objects whose points are left out");
  command.add_flag("--keep-robot", options.keeps_robot, "Keep the points of robots");
  command.add_flag("--keep-outliers", options.keeps_outliers, "Keep single points");
}

}  // namespace

void add_cloud_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CloudOptions>();
  CLI::App* command =
      app.add_subcommand("cloud", "Add points of a camera or scanner to a scene, or show them");
  add_reading(*command, *options);
  CLI::Option* scene =
      command->add_option("--scene", options->scene, "Scene to which the points are added");
  CLI::Option* out = command->add_option(
      "--out", options->out, "The new scene (.yaml); without --scene: the points (.ply)");
  scene->needs(out);
  command->add_option("--name", options->name, "Name of the object")->capture_default_str();
  add_placing(*command, *options);
  add_filters(*command, *options);
  add_hidden_space(*command, *options);
  command->callback([options, &exit_code] { exit_code = run_cloud(*options); });
}

}  // namespace handway::tools
