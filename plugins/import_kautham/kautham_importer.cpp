#include "kautham_importer.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/extensions/importer.h"
#include "kautham_model.h"
#include "kautham_problem.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <span>
#include <string_view>

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

// The controls of the robots one after the other.
class ControlList {
 public:
  explicit ControlList(std::span<const double> values) : rest_(values) {}

  Eigen::VectorXd take(std::size_t count) {
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return Eigen::Map<const Eigen::VectorXd>(taken.data(), static_cast<Eigen::Index>(count));
  }

 private:
  std::span<const double> rest_;
};

class SceneBuilder {
 public:
  explicit SceneBuilder(const KauthamProblem& problem)
      : problem_(problem), folder_(problem.file.parent_path()) {}

  planning::LoadedScene build() {
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
    std::size_t controls = 0;
    for (const KauthamProblem::PlacedRobot& placed : problem_.robots) {
      robots.push_back(read_kautham_robot(found(placed.file)));
      controls += robots.back().controls.size();
    }
    const bool has_query = !problem_.init.empty() || !problem_.goal.empty();
    if (has_query && problem_.init.size() != controls) {
      throw InputError({problem_.query_place, "Query",
                        std::to_string(problem_.init.size()) + " controls in <Init> and <Goal>",
                        std::to_string(controls) + ", one for each control of the robots",
                        "Look at the <ControlSet> of " + problem_.robots.front().file.string()});
    }
    ControlList init(problem_.init);
    ControlList goal(problem_.goal);
    for (std::size_t r = 0; r < robots.size(); ++r) {
      const auto count = robots[r].controls.size();
      const Eigen::VectorXd middle =
          Eigen::VectorXd::Constant(static_cast<Eigen::Index>(count), 0.5);
      add_robot(problem_.robots[r], robots[r], has_query ? init.take(count) : middle,
                has_query ? goal.take(count) : middle, has_query);
    }
  }

  void add_robot(const KauthamProblem::PlacedRobot& placed, const KauthamRobot& robot,
                 const Eigen::VectorXd& init, const Eigen::VectorXd& goal, bool has_query) {
    const auto model = make_robot_model(robot, placed.scale, meshes_);
    const geometric::Configuration start = configuration_at(robot, *model, init);
    const bool is_planned = scene_->robots.empty();
    const std::vector<std::string>& said = model->description().warnings;
    scene_->robots.push_back({unique_name(scene_->robots, robot.name), placed.file, model,
                              placed.X_WH * root_pose(robot), start});
    for (const std::string& warning : said) {
      scene_->warnings.push_back("robot " + scene_->robots.back().name + ": " + warning);
    }
    if (is_planned) {
      basis_ = make_hand_basis(robot, *model, scene_->warnings);
    } else if (init != goal) {
      scene_->warnings.push_back("robot " + scene_->robots.back().name +
                                 " stays at its <Init>: plans are made for the first robot");
    }
    if (is_planned && has_query) {
      scene_->start = start;
      scene_->goal = configuration_at(robot, *model, goal);
    }
  }

  // The file of this name, as the problem writes it or, with a warning, in other letters.
  [[nodiscard]] std::filesystem::path found(const std::filesystem::path& written) {
    std::filesystem::path file = geometric::existing_file(folder_ / written);
    if (geometric::differs_in_case(written, file)) {
      scene_->warnings.push_back("file " + written.string() + ": its name has other letters, \"" +
                                 file.filename().string() + "\"");
    }
    return file;
  }

  void add_obstacle(const KauthamProblem::Obstacle& obstacle) {
    const std::filesystem::path mesh_file = found(obstacle.mesh);
    const std::filesystem::path file = std::filesystem::absolute(mesh_file).lexically_normal();
    const InventorMesh& mesh = meshes_.load(mesh_file, obstacle.scale);
    scene_->objects.push_back(
        {unique_name(scene_->objects, obstacle.mesh.stem().string()),
         geometric::Mesh{file, Eigen::Vector3d::Constant(obstacle.scale), mesh.triangles},
         obstacle.X_WO, mesh.color, std::nullopt});
  }

  // A problem asks for a path; whichever planner finds it best is the default.
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

  // Nothing that planning needs: reported once, with the first of them.
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
  InventorMeshes meshes_;
};

/// Opens all files that the problem names and puts the scene together. The first
/// robot is the one to plan for; `basis` is its hand's.
/// @throws InputError if one of the files can't be read, or the query's number
/// of controls is not that of the robots.
planning::LoadedScene make_scene(const KauthamProblem& problem) {
  return SceneBuilder(problem).build();
}

/// A scene with just this robot, all controls in the middle, nothing around it.
/// @param file a `.rob` file.
planning::LoadedScene make_robot_scene(const std::filesystem::path& file) {
  KauthamProblem problem;
  problem.file = file;
  problem.name = file.stem().string();
  problem.robots.push_back({file.filename()});
  return make_scene(problem);
}

}  // namespace

std::string KauthamImporter::name() const { return "Kautham 2013 (.xml, .rob)"; }

bool KauthamImporter::can_read(const std::filesystem::path& file) const {
  const bool is_robot = geometric::has_extension(file, ".rob");
  if (!is_robot && !geometric::has_extension(file, ".xml")) {
    return false;
  }
  std::array<char, 4096> head{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), head.size());
  const std::string_view begin(head.data(), static_cast<std::size_t>(stream.gcount()));
  return begin.find(is_robot ? "<Robot" : "<Problem") != std::string_view::npos;
}

planning::LoadedScene KauthamImporter::read(const std::filesystem::path& file) const {
  return geometric::has_extension(file, ".rob") ? make_robot_scene(file)
                                                : make_scene(read_kautham_problem(file));
}

}  // namespace handway::import_kautham
