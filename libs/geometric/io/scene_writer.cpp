#include "handway/geometric/io/scene_writer.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/mesh_reader.h"
#include "handway/geometric/io/obj_writer.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/text_file.h"
#include "io/scene_text.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <string>
#include <system_error>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) { return fs::absolute(file).parent_path(); }

// `reference`, as a scene in folder `from` names a file, for a scene in folder `to`.
fs::path moved_reference(ResourceKind kind, const fs::path& reference, const fs::path& from,
                         const fs::path& to) {
  fs::path file;
  try {
    file = find_resource(kind, reference, from);
    if (find_resource(kind, reference, to) == file) {
      return reference;
    }
  } catch (const InputError&) {
    if (file.empty()) {
      return reference;  // it was broken before
    }
  }
  return resource_reference(kind, file, to);
}

class SceneFileWriter {
 public:
  SceneFileWriter(const Scene& scene, const fs::path& file)
      : scene_(scene),
        file_(file),
        from_(scene.file.empty() ? fs::current_path() : folder_of(scene.file)),
        to_(folder_of(file)) {}

  void write() {
    if (scene_.robots.empty()) {
      throw InputError({file_.string(), "robots", "a scene without a robot", "at least one", ""});
    }
    for (const RobotInstance& robot : scene_.robots) {
      references_.robots.push_back(robot_reference(robot));
    }
    if (!scene_.hand_basis.empty()) {
      references_.hand_basis =
          moved_reference(ResourceKind::kHandBasis, scene_.hand_basis, from_, to_);
    }
    for (const SceneObject& object : scene_.objects) {
      add_mesh_reference(object);
    }
    replace_file(file_, leading_comments() + scene_text(scene_, references_));
  }

 private:
  [[nodiscard]] fs::path robot_reference(const RobotInstance& robot) const {
    const fs::path& file = robot.file.empty() ? robot.model->description().file : robot.file;
    if (file.empty() || (file.has_extension() && file.extension() != ".urdf" &&
                         fs::exists(fs::absolute(from_ / file)))) {
      throw InputError({file_.string(), "robot " + robot.name,
                        file.empty() ? "a model without a file" : "a model from " + file.string(),
                        "a URDF file or a robot of the library",
                        "Save the robot as URDF and choose that as its model"});
    }
    return moved_reference(ResourceKind::kRobot, file, from_, to_);
  }

  void add_mesh_reference(const SceneObject& object) {
    const Mesh* mesh = std::get_if<Mesh>(&object.shape);
    const bool has_file = mesh && !mesh->file.empty() && is_mesh_file(mesh->file);
    references_.is_scaled.push_back(has_file);
    if (!mesh) {
      references_.meshes.emplace_back();
    } else if (has_file) {
      references_.meshes.push_back(resource_reference(ResourceKind::kObject, mesh->file, to_));
    } else {
      references_.meshes.push_back(save_mesh(object.name, *mesh->triangles));
    }
  }

  // Writes the mesh beside the scene and returns its relative path.
  [[nodiscard]] fs::path save_mesh(const std::string& object, const TriangleMesh& mesh) {
    std::string stem = object;
    std::ranges::replace_if(
        stem, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '_'; }, '_');
    std::string unique = stem;
    for (int i = 2; !saved_.insert(unique).second; ++i) {
      unique = stem + "_" + std::to_string(i);
    }
    const fs::path folder = file_.stem().string() + "_meshes";
    std::error_code error;
    fs::create_directories(to_ / folder, error);
    if (error) {
      throw InputError({(to_ / folder).string(), "", error.message(), "a folder for meshes",
                        "Save the scene where you may write"});
    }
    write_obj(mesh, to_ / folder / (unique + ".obj"));
    return folder / (unique + ".obj");
  }

  // Comments and blank lines at the top of the file that is there now.
  [[nodiscard]] std::string leading_comments() const {
    std::string text;
    try {
      text = read_text_file(file_, "a scene file");
    } catch (const InputError&) {
      return "";  // a new file, or one that is no scene
    }
    std::istringstream lines(text);
    std::string comments;
    std::string line;
    for (std::string blank; std::getline(lines, line); blank += '\n') {
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first != std::string::npos && line[first] != '#') {
        break;
      }
      if (first != std::string::npos) {
        comments += blank + line;
        blank.clear();
      }
    }
    if (!comments.empty()) {
      comments += '\n';
    }
    return comments;
  }

  const Scene& scene_;
  fs::path file_;
  fs::path from_;
  fs::path to_;
  SceneReferences references_;
  std::set<std::string> saved_;
};

}  // namespace

void write_scene(const Scene& scene, const fs::path& file) { SceneFileWriter(scene, file).write(); }

}  // namespace handway::geometric
