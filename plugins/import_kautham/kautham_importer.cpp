#include "kautham_importer.h"

#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/planning/extensions/plugin.h"
#include "kautham_model.h"
#include "kautham_problem.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace handway::import_kautham {
namespace {

using geometric::InputError;
using geometric::Scene;

template <typename Range>
std::string unique_name(const Range& taken, const std::string& wanted) {
  std::string name = wanted;
  for (int n = 2; std::ranges::find(taken, name,
                                    [](const auto& item) -> const std::string& {
                                      return item.name;
                                    }) != taken.end();
       ++n) {
    name = wanted + "_" + std::to_string(n);
  }
  return name;
}

geometric::Shape scaled_about_frame(const geometric::Shape& shape, double scale) {
  const auto* mesh = std::get_if<geometric::Mesh>(&shape);
  if (!mesh) {
    return geometric::scaled(shape, scale);
  }
  const Eigen::Vector3d each_way = Eigen::Vector3d::Constant(scale);
  return geometric::Mesh{mesh->file, scale * mesh->scale,
                         std::make_shared<const geometric::TriangleMesh>(
                             transformed(*mesh->triangles, geometric::Pose::Identity(), each_way))};
}

/// A robot with all lengths multiplied.
std::shared_ptr<const geometric::RobotModel> scaled_robot(
    const std::shared_ptr<const geometric::RobotModel>& model, double scale) {
  if (scale == 1.0) {
    return model;
  }
  geometric::RobotDescription robot = model->description();
  for (geometric::Link& link : robot.links) {
    for (std::vector<geometric::LinkGeometry>* parts : {&link.visual, &link.collision}) {
      for (geometric::LinkGeometry& part : *parts) {
        part.X_LG.translation() *= scale;
        part.shape = scaled_about_frame(part.shape, scale);
      }
    }
  }
  for (geometric::Joint& joint : robot.joints) {
    joint.X_PJ.translation() *= scale;
    if (joint.type == geometric::JointType::kPrismatic) {
      joint.limits.lower *= scale;
      joint.limits.upper *= scale;
      joint.limits.velocity *= scale;
    }
  }
  return std::make_shared<const geometric::RobotModel>(std::move(robot));
}

class SceneBuilder {
 public:
  explicit SceneBuilder(const KauthamProblem& problem)
      : problem_(problem), folder_(problem.file.parent_path()) {}

  planning::SceneState build() {
    scene_->name = problem_.name;
    scene_->file = problem_.file;
    scene_->warnings = problem_.warnings;
    add_robots();
    for (const KauthamProblem::Obstacle& obstacle : problem_.obstacles) {
      add_obstacle(obstacle);
    }
    note_planner();
    note_textures();
    return {scene_, basis_};
  }

 private:
  void add_robots() {
    std::vector<KauthamRobot> robots;
    std::vector<BaseLimits> limits;
    for (const KauthamProblem::PlacedRobot& placed : problem_.robots) {
      robots.push_back(read_robot(placed));
      limits.push_back(placed.limits);
    }
    const bool are_shared = read_controls(robots, limits);
    std::size_t count = robots.front().controls.size();
    for (std::size_t r = 1; r < robots.size() && !are_shared; ++r) {
      count += robots[r].controls.size();
    }
    for (const std::vector<double>* end : {&problem_.init, &problem_.goal}) {
      if (!end->empty() && end->size() != count) {
        throw InputError(
            {problem_.query_place, "Query",
             std::to_string(end->size()) + " controls in <Init> and <Goal>",
             std::to_string(count) + ", one for each control of the robots",
             "Look at the <ControlSet> of " +
                 (problem_.controls.empty() ? robots.front().file : problem_.controls).string()});
      }
    }
    std::size_t first = 0;
    for (std::size_t r = 0; r < robots.size(); ++r) {
      add_robot(problem_.robots[r], robots[r], first);
      first += are_shared ? 0 : robots[r].controls.size();
    }
  }

  [[nodiscard]] KauthamRobot read_robot(const KauthamProblem::PlacedRobot& placed) {
    const std::filesystem::path file = found(placed.file);
    if (!geometric::has_extension(file, ".urdf")) {
      return read_kautham_robot(file);
    }
    // Models are cached by file and scale: a file may be used in several sizes.
    const double scale = placed.scale * problem_.units.length;
    const auto model = scaled_robot(geometric::load_robot(file), scale);
    models_[{placed.file, placed.scale}] = model;
    return controlled_robot(*model);
  }

  // Returns whether all robots have the same list of controls; else each has its own, one after the
  // other.
  bool read_controls(std::vector<KauthamRobot>& robots, const std::vector<BaseLimits>& limits) {
    if (!problem_.controls.empty()) {
      read_kautham_controls(found(problem_.controls), robots);
      return true;
    }
    const bool have_none =
        std::ranges::none_of(robots, [](const KauthamRobot& robot) { return robot.has_controls; });
    if (have_none && !problem_.init.empty()) {
      add_default_controls(robots, limits);
      return true;
    }
    for (const KauthamRobot& robot : robots) {
      if (!robot.has_controls) {
        scene_->warnings.push_back("robot " + robot.name +
                                   ": no <ControlSet>: no control moves a joint");
      }
    }
    return false;
  }

  // @param first its first control in the problem's lists.
  void add_robot(const KauthamProblem::PlacedRobot& placed, const KauthamRobot& robot,
                 std::size_t first) {
    const bool is_urdf = models_.contains({placed.file, placed.scale});
    if (is_urdf && std::ranges::count(moving_base(robot), true) > 0) {
      scene_->warnings.push_back("robot " + robot.name +
                                 ": controls of the base of a URDF robot are passed over");
    }
    const auto model =
        is_urdf ? models_.at({placed.file, placed.scale})
                : make_robot_model(robot, placed.scale, placed.limits, placed.X_WH, meshes_);
    const auto at = [&](const std::vector<double>& values) {
      const auto count = static_cast<Eigen::Index>(robot.controls.size());
      const Eigen::VectorXd controls =
          values.empty()
              ? Eigen::VectorXd::Constant(count, 0.5)
              : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data() + first, count));
      return configuration_at(robot, *model, controls, placed.limits, placed.X_WH);
    };
    const geometric::Configuration start = at(problem_.init);
    const bool is_planned = scene_->robots.empty();
    const std::vector<std::string>& said = model->description().warnings;
    scene_->robots.push_back({unique_name(scene_->robots, robot.name), placed.file, model,
                              is_urdf ? placed.X_WH : placed.X_WH * root_pose(robot), start});
    for (const std::string& warning : said) {
      scene_->warnings.push_back("robot " + scene_->robots.back().name + ": " + warning);
    }
    if (!is_planned) {
      if (!problem_.goal.empty() && start != at(problem_.goal)) {
        scene_->warnings.push_back("robot " + scene_->robots.back().name +
                                   " stays at its <Init>: plans are made for the first robot");
      }
      return;
    }
    basis_ = make_hand_basis(robot, *model, scene_->warnings);
    if (!problem_.init.empty()) {
      scene_->start = start;
    }
    if (!problem_.goal.empty()) {
      scene_->goal = at(problem_.goal);
    }
  }

  // The file of this name in the problem's folder or in the model folders of Kautham's programs,
  // ../../models and the like; with a warning if its name differs in case.
  [[nodiscard]] std::filesystem::path found(const std::filesystem::path& written) {
    std::filesystem::path file = geometric::existing_file(folder_ / written);
    std::error_code ignored;
    for (const char* models : {"../../models", "../models", "../../../models", "models"}) {
      if (!std::filesystem::exists(file, ignored)) {
        const auto elsewhere = geometric::existing_file(
            (std::filesystem::absolute(folder_) / models / written).lexically_normal());
        file = std::filesystem::exists(elsewhere, ignored) ? elsewhere : file;
      }
    }
    if (geometric::differs_in_case(written, file)) {
      scene_->warnings.push_back("file " + written.string() + ": its name has other letters, \"" +
                                 file.filename().string() + "\"");
    }
    return file;
  }

  void add_obstacle(const KauthamProblem::Obstacle& obstacle) {
    const std::filesystem::path file = found(obstacle.mesh);
    const std::string name = obstacle.mesh.stem().string();
    if (geometric::has_extension(file, ".urdf")) {
      add_links(*geometric::load_robot(file), obstacle, name);
      return;
    }
    // Meshes have millimetres times scale, or, if the problem is in metres, metres.
    const double scale = obstacle.scale * problem_.units.length / geometric::kMillimetre;
    const InventorMesh& mesh = meshes_.load(file, scale);
    scene_->objects.push_back({unique_name(scene_->objects, name),
                               geometric::Mesh{std::filesystem::absolute(file).lexically_normal(),
                                               Eigen::Vector3d::Constant(scale), mesh.triangles},
                               obstacle.X_WO, mesh.color, std::nullopt});
  }

  // An obstacle of later versions that is a URDF file: each shape of its links is an object.
  void add_links(const geometric::RobotModel& model, const KauthamProblem::Obstacle& obstacle,
                 const std::string& name) {
    const double scale = obstacle.scale * problem_.units.length;
    std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model.link_count()));
    model.forward_kinematics(model.neutral(), X_BL);
    for (int link = 0; link < model.link_count(); ++link) {
      for (const geometric::LinkGeometry& part : model.link(link).collision) {
        geometric::Pose X_WG = X_BL[static_cast<std::size_t>(link)] * part.X_LG;
        X_WG.translation() *= scale;
        scene_->objects.push_back({unique_name(scene_->objects, name),
                                   scaled_about_frame(part.shape, scale), obstacle.X_WO * X_WG,
                                   part.color, std::nullopt});
      }
    }
  }

  // A problem requests a path; the planner that finds it best is the default.
  void note_planner() {
    if (!problem_.planner.empty() && problem_.planner != "PRMAURO HandArm") {
      scene_->warnings.push_back("planner \"" + problem_.planner +
                                 "\" of the problem has no counterpart; the default is used");
    }
    std::string parameters;
    for (const auto& [key, value] : problem_.parameters) {
      parameters += (parameters.empty() ? "" : ", ") + key + " = " + value;
    }
    if (!parameters.empty()) {
      scene_->warnings.push_back(
          "parameters of the problem's planner that have no exact counterpart: " + parameters);
    }
  }

  // Reports textures once, with the first of them: planning doesn't need them.
  void note_textures() {
    if (const std::vector<std::string>& missing = meshes_.warnings(); !missing.empty()) {
      scene_->warnings.push_back(
          "textures that can't be read and are not drawn: " + std::to_string(missing.size()) +
          ", the first: " + missing.front());
    }
  }

  const KauthamProblem& problem_;
  std::filesystem::path folder_;
  std::shared_ptr<Scene> scene_ = std::make_shared<Scene>();
  std::shared_ptr<const sampling::PmdBasis> basis_;
  /// URDF robots by file and scale.
  std::map<std::pair<std::filesystem::path, double>, std::shared_ptr<const geometric::RobotModel>>
      models_;
  InventorMeshes meshes_;
};

/// Opens all files that the problem names and makes the scene. The first robot is the one to plan
/// for; `basis` is its hand's.
/// @throws InputError if one of the files can't be read, or the query's number
/// of controls is not that of the robots.
planning::SceneState make_scene(const KauthamProblem& problem) {
  return SceneBuilder(problem).build();
}

bool is_robot_file(const std::filesystem::path& file) {
  return geometric::has_extension(file, ".rob") || geometric::has_extension(file, ".dh");
}

/// A scene with just this robot, all controls in the middle, nothing around it.
/// @param file a `.rob` file.
planning::SceneState make_robot_scene(const std::filesystem::path& file) {
  KauthamProblem problem;
  problem.file = file;
  problem.name = file.stem().string();
  problem.robots.push_back({file.filename()});
  return make_scene(problem);
}

}  // namespace

std::string KauthamImporter::name() const { return "Kautham (.xml, .rob, .dh)"; }

bool KauthamImporter::can_read(const std::filesystem::path& file) const {
  const bool is_robot = is_robot_file(file);
  if (!is_robot && !geometric::has_extension(file, ".xml")) {
    return false;
  }
  return geometric::head_of(file, 4096).find(is_robot ? "<Robot" : "<Problem") != std::string::npos;
}

planning::SceneState KauthamImporter::read(const std::filesystem::path& file) const {
  return is_robot_file(file) ? make_robot_scene(file) : make_scene(read_kautham_problem(file));
}

}  // namespace handway::import_kautham

HANDWAY_PLUGIN({.name = "import_kautham",
                .version = HANDWAY_VERSION,
                .make_importer = []() -> std::unique_ptr<handway::planning::Importer> {
                  return std::make_unique<handway::import_kautham::KauthamImporter>();
                }});
