#include "handway/geometric/io/scene_writer.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/mesh_reader.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/io/urdf_writer.h"
#include "io/saved_meshes.h"
#include "io/scene_text.h"

#include <algorithm>
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
        to_(folder_of(file)),
        meshes_(file) {}

  void write() {
    if (scene_.robots.empty()) {
      throw InputError({file_.string(), "robots", "a scene without a robot", "at least one", ""});
    }
    for (const RobotInstance& robot : scene_.robots) {
      add_robot_reference(robot);
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
  // A robot that comes from no robot file (an importer made it) is saved as one.
  void add_robot_reference(const RobotInstance& robot) {
    const fs::path& file = robot.file.empty() ? robot.model->description().file : robot.file;
    const bool is_other_file = file.has_extension() && !has_extension(file, ".urdf") &&
                               fs::exists(fs::absolute(from_ / file));
    const bool has_file = !file.empty() && !is_other_file;
    references_.is_saved_robot.push_back(!has_file);
    if (has_file) {
      references_.robots.push_back(moved_reference(ResourceKind::kRobot, file, from_, to_));
      return;
    }
    references_.robots.emplace_back(file_.stem().string() + "_" + file_name_of(robot.name) +
                                    ".urdf");
    write_urdf(*robot.model, to_ / references_.robots.back());
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
      references_.meshes.push_back(meshes_.save(object.name, *mesh->triangles));
    }
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
  SavedMeshes meshes_;
};

}  // namespace

void write_scene(const Scene& scene, const fs::path& file) { SceneFileWriter(scene, file).write(); }

}  // namespace handway::geometric
