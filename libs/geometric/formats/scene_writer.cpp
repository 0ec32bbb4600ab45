#include "formats/scene_sections.h"
#include "formats/yaml_text.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/obj_writer.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/robot/base_joint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace handway::geometric {
namespace {

/// Reference to a robot's file in a scene file.
struct RobotReference {
  std::filesystem::path file;
  bool is_saved = false;  ///< With its bases, in a file made for the scene.
};

/// References to all files that the scene needs, in the scene's order.
struct SceneReferences {
  std::vector<std::vector<RobotReference>> robots;  ///< References of each robot's parts, in order.
  std::vector<std::filesystem::path> meshes;        ///< Empty for objects of other shapes.
  std::vector<bool> is_scaled;                      ///< False: the mesh file already has the scale.
  std::vector<std::filesystem::path> grasps;        ///< Empty for objects without a file of grasps.
  std::filesystem::path hand_basis;
};

std::string configuration_text(const RobotModel& model, const Configuration& q,
                               const std::string& indent) {
  if (model.variable_count() == 0) {
    return " {}\n";
  }
  std::string text = "\n";
  for (int v = 0; v < model.variable_count(); ++v) {
    text +=
        fmt::format("{}{}: {}\n", indent, yaml_scalar(model.variable(v).name), number_text(q[v]));
  }
  return text;
}

std::string posture_text(const NamedPosture& posture) {
  std::string text =
      fmt::format("  {}:{}\n", yaml_scalar(posture.name), posture.values.empty() ? " {}" : "");
  for (const auto& [joint, value] : posture.values) {
    text += fmt::format("    {}: {}\n", yaml_scalar(joint), number_text(value));
  }
  return text;
}

// Text about bases: the root that moves, and the bases' ranges.
std::string bases_text(const RobotModel& model) {
  std::string text;
  std::string bounds;
  for (const BaseJoint& base : model.description().base_joints) {
    if (base.of_scene) {
      text += fmt::format("    moving_base: {}\n",
                          base.motion == BaseMotion::kPlanar ? "planar" : "floating");
    }
    for (const std::string& slide : slides_of(base)) {
      const JointLimits& limits = model.variable(model.find_variable(slide).value()).limits;
      bounds += fmt::format("      {}: {}\n", yaml_scalar(slide),
                            yaml_list(Eigen::Vector2d(limits.lower, limits.upper)));
    }
  }
  return bounds.empty() ? "" : text + "    bounds:\n" + bounds;
}

std::string xacro_text(const RobotModel& model) {
  std::string entries;
  for (const auto& [name, value] : model.description().xacro_arguments) {
    entries +=
        fmt::format("{}{}: {}", entries.empty() ? "" : ", ", yaml_scalar(name), yaml_scalar(value));
  }
  return entries.empty() ? "" : fmt::format("    xacro: {{{}}}\n", entries);
}

std::string couplings_text(const RobotModel& model) {
  std::string text;
  for (const JointCoupling& coupling : model.description().couplings) {
    if (!coupling.of_scene) {
      continue;
    }
    std::string terms;
    for (const auto& [joint, multiplier] : coupling.terms) {
      terms += fmt::format("{}{}: {}", terms.empty() ? "" : ", ", yaml_scalar(joint),
                           number_text(multiplier));
    }
    text += fmt::format("{}      {}: {{of: {{{}}}, offset: {}}}\n",
                        text.empty() ? "    couplings:\n" : "", yaml_scalar(coupling.joint), terms,
                        number_text(coupling.offset));
  }
  return text;
}

// The values of the part's own joints, by their own names.
std::string part_configuration_text(const RobotInstance& robot, const RobotPart& part) {
  Configuration q = part.model->neutral();
  for (int v = 0; v < part.model->variable_count(); ++v) {
    const std::string& composed = part.joints.at(part.model->variable(v).name);
    q[v] = robot.configuration[robot.model->find_variable(composed).value()];
  }
  return configuration_text(*part.model, q, "      ");
}

std::string mount_text(const RobotInstance& robot, const RobotPart& part) {
  return fmt::format("    mount: {{robot: {}, link: {}, pose: {}}}\n",
                     yaml_scalar(robot.parts[static_cast<std::size_t>(part.carrier)].name),
                     yaml_scalar(part.link), yaml_pose(part.X_LB));
}

std::string padding_text(const RobotInstance& robot) {
  std::string text = robot.padding.empty() ? "" : "    padding:\n";
  for (const auto& [link, padding] : robot.padding) {
    text += fmt::format("      {}: {{distance: {}, scale: {}}}\n", yaml_scalar(link),
                        number_text(padding.distance), number_text(padding.scale));
  }
  return text;
}

std::string collisions_text(const std::map<AllowedCollisions::Pair, bool>& allowed_collisions) {
  std::string text = allowed_collisions.empty() ? "" : "collisions:\n";
  for (const bool allowed : {true, false}) {
    std::string list;
    for (const auto& [pair, touch] : allowed_collisions) {
      if (touch == allowed) {
        list += fmt::format("    - [{}, {}]\n", yaml_scalar(pair.first), yaml_scalar(pair.second));
      }
    }
    text += list.empty() ? "" : fmt::format("  {}:\n{}", allowed ? "allowed" : "checked", list);
  }
  return text;
}

std::string robot_text(const RobotInstance& robot, const std::vector<RobotReference>& references) {
  std::string text;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const RobotPart* part = robot.parts.empty() ? nullptr : &robot.parts[i];
    text += fmt::format(
        "  - name: {}\n    model: {}\n{}{}{}{}{}    configuration:{}",
        yaml_scalar(part ? part->name : robot.name),
        yaml_scalar(references[i].file.generic_string()),
        references[i].is_saved ? "" : xacro_text(part ? *part->model : *robot.model),
        i == 0 ? fmt::format("    base: {}\n", yaml_pose(robot.X_WB)) : mount_text(robot, *part),
        references[i].is_saved ? "" : couplings_text(part ? *part->model : *robot.model),
        i > 0 || references[i].is_saved ? "" : bases_text(part ? *part->model : *robot.model),
        i > 0 ? "" : padding_text(robot),
        part ? part_configuration_text(robot, *part)
             : configuration_text(*robot.model, robot.configuration, "      "));
  }
  return text;
}

class ShapeText {
 public:
  ShapeText(const std::filesystem::path& mesh, bool is_scaled)
      : mesh_(mesh), is_scaled_(is_scaled) {}

  std::string operator()(const Box& box) const {
    return fmt::format("box: {{size: {}}}", yaml_list(box.size));
  }
  std::string operator()(const Sphere& sphere) const {
    return fmt::format("sphere: {{radius: {}}}", number_text(sphere.radius));
  }
  std::string operator()(const Cylinder& cylinder) const {
    return fmt::format("cylinder: {{radius: {}, length: {}}}", number_text(cylinder.radius),
                       number_text(cylinder.length));
  }
  std::string operator()(const Cone& cone) const {
    return fmt::format("cone: {{radius: {}, length: {}}}", number_text(cone.radius),
                       number_text(cone.length));
  }
  std::string operator()(const Mesh& mesh) const {
    const bool uniform = (mesh.scale.array() == mesh.scale.x()).all();
    const std::string scale = uniform ? number_text(mesh.scale.x()) : yaml_list(mesh.scale);
    return fmt::format("mesh: {{file: {}{}}}", yaml_scalar(mesh_.generic_string()),
                       is_scaled_ && scale != "1" ? ", scale: " + scale : "");
  }
  std::string operator()(const Cloud& cloud) const {
    const std::string radius =
        cloud.cells.radius > 0.0 ? ", radius: " + number_text(cloud.cells.radius) : "";
    return fmt::format("cloud: {{file: {}, cell: {}{}}}", yaml_scalar(mesh_.generic_string()),
                       number_text(cloud.cells.size), radius);
  }

 private:
  const std::filesystem::path& mesh_;
  bool is_scaled_;
};

std::string color_text(const Color& color) {
  const auto number = [](float value) { return fmt::format("{}", value); };
  return fmt::format("[{}, {}, {}{}]", number(color.red), number(color.green), number(color.blue),
                     color.alpha == 1.0F ? "" : ", " + number(color.alpha));
}

std::string attachment_text(const Attachment& attachment) {
  std::string text = fmt::format("{{robot: {}, link: {}", yaml_scalar(attachment.robot),
                                 yaml_scalar(attachment.link));
  if (!attachment.touching.empty()) {
    text += ", touching: [";
    for (const std::string& link : attachment.touching) {
      text += (text.ends_with('[') ? "" : ", ") + yaml_scalar(link);
    }
    text += ']';
  }
  return text + '}';
}

std::string object_text(const SceneObject& object, const ObjectDisplay& display,
                        const ShapeText& shape, const std::filesystem::path& grasps) {
  std::string text = fmt::format("  - name: {}\n    {}\n    pose: {}\n    color: {}\n",
                                 yaml_scalar(object.name), std::visit(shape, object.shape),
                                 yaml_pose(object.X_PO), color_text(object.color));
  if (object.attachment) {
    text += "    attach: " + attachment_text(*object.attachment) + '\n';
  }
  if (!grasps.empty()) {
    text += "    grasps: " + yaml_scalar(grasps.generic_string()) + '\n';
  }
  if (!display.group.empty()) {
    text += "    group: " + yaml_scalar(display.group) + '\n';
  }
  text += object.solid ? "" : "    solid: false\n";
  text += display.hidden ? "    hidden: true\n" : "";
  text += display.locked ? "    locked: true\n" : "";
  return text;
}

std::string constraint_text(const PathConstraint& constraint) {
  std::string text = fmt::format("  - name: {}\n    body: {}\n", yaml_scalar(constraint.name),
                                 yaml_scalar(constraint.body));
  if (const auto* orientation = std::get_if<OrientationConstraint>(&constraint.what)) {
    return text + fmt::format("    upright: {{axis: {}, direction: {}, angle_deg: {}}}\n",
                              yaml_list(orientation->axis), yaml_list(orientation->direction),
                              number_text(rounded_degrees(orientation->angle)));
  }
  const auto& position = std::get<PositionConstraint>(constraint.what);
  return text + fmt::format("    region: {{point: {}, size: {}, pose: {}}}\n",
                            yaml_list(position.point), yaml_list(position.size),
                            yaml_pose(position.X_WR));
}

std::string view_text(const SavedView& view) {
  return fmt::format(
      "  - {{name: {}, target: {}, distance: {}, azimuth_deg: {}, elevation_deg: {}}}\n",
      yaml_scalar(view.name), yaml_list(view.target), number_text(view.distance),
      number_text(rounded_degrees(view.azimuth)), number_text(rounded_degrees(view.elevation)));
}

std::string planner_text(const PlannerRequest& planner) {
  std::string text;
  if (!planner.name.empty()) {
    text += "  name: " + yaml_scalar(planner.name) + '\n';
  }
  for (const auto& [key, value] : planner.settings) {
    text += fmt::format("  {}: {}\n", yaml_scalar(key), yaml_scalar(value));
  }
  return text.empty() ? "" : "planner:\n" + text;
}

/// The text of a scene file, without comments.
std::string scene_text(const Scene& scene, const SceneReferences& references) {
  std::string text = fmt::format("handway: {}\n", kSceneVersion);
  if (!scene.name.empty()) {
    text += "name: " + yaml_scalar(scene.name) + '\n';
  }
  if (!scene.description.empty()) {
    text += "description: " + yaml_scalar(scene.description) + '\n';
  }
  text += "robots:\n";
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    text += robot_text(scene.robots[i], references.robots[i]);
  }
  text += scene.objects.empty() ? "" : "objects:\n";
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    text +=
        object_text(object, scene.display.of(object.name),
                    ShapeText(references.meshes[i], references.is_scaled[i]), references.grasps[i]);
  }
  text += frames_text(scene.frames);
  text += scene.constraints.empty() ? "" : "constraints:\n";
  for (const PathConstraint& constraint : scene.constraints) {
    text += constraint_text(constraint);
  }
  text += collisions_text(scene.allowed_collisions);
  if (!scene.group.empty()) {
    std::vector<std::string> names;
    std::ranges::transform(scene.group, std::back_inserter(names), yaml_scalar);
    text += fmt::format("group: [{}]\n", fmt::join(names, ", "));
  }
  if (scene.start) {
    text += "start:" + configuration_text(*scene.robots[0].model, *scene.start, "  ");
  }
  if (scene.goal) {
    text += "goal:" + configuration_text(*scene.robots[0].model, *scene.goal, "  ");
  }
  text += pose_goals_text(scene);
  text += scene.postures.empty() ? "" : "postures:\n";
  for (const NamedPosture& posture : scene.postures) {
    text += posture_text(posture);
  }
  text += scene.display.views.empty() ? "" : "views:\n";
  for (const SavedView& view : scene.display.views) {
    text += view_text(view);
  }
  if (!references.hand_basis.empty()) {
    text += "hand_basis: " + yaml_scalar(references.hand_basis.generic_string()) + '\n';
  }
  return text + planner_text(scene.planner) + programs_text(scene.programs);
}

namespace fs = std::filesystem;

// The file that a shape is read from again; empty for a primitive, and if a program made the shape.
fs::path file_of(const Shape& shape) {
  if (const auto* cloud = std::get_if<Cloud>(&shape)) {
    return cloud->file;
  }
  const auto* mesh = std::get_if<Mesh>(&shape);
  return mesh && is_mesh_file(mesh->file) ? mesh->file : fs::path();
}

// Saves a shape that a program made. @returns its file; empty for a primitive.
fs::path save_shape(SavedMeshes& meshes, const std::string& name, const Shape& shape) {
  if (const auto* cloud = std::get_if<Cloud>(&shape)) {
    return meshes.save(name, *cloud->points);
  }
  const auto* mesh = std::get_if<Mesh>(&shape);
  return mesh ? meshes.save(name, *mesh->triangles) : fs::path();
}

fs::path folder_of(const fs::path& file) { return fs::absolute(file).parent_path(); }

// `reference`, as a file is named in a scene in folder `from`, for a scene in folder `to`.
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
      std::vector<RobotReference>& references = references_.robots.emplace_back();
      for (const RobotPart& part : robot.parts) {
        references.push_back(robot_reference(part.name, part.file, *part.model));
      }
      if (robot.parts.empty()) {
        references.push_back(robot_reference(robot.name, robot.file, *robot.model));
      }
    }
    if (!scene_.hand_basis.empty()) {
      references_.hand_basis =
          moved_reference(ResourceKind::kHandBasis, scene_.hand_basis, from_, to_);
    }
    for (const SceneObject& object : scene_.objects) {
      add_mesh_reference(object);
      references_.grasps.push_back(
          object.grasps.empty() ? object.grasps
                                : resource_reference(ResourceKind::kObject, object.grasps, to_));
    }
    replace_file(file_, leading_comments() + scene_text(scene_, references_));
  }

 private:
  // A robot without a robot file (an importer made it) is saved as one.
  RobotReference robot_reference(const std::string& name, const fs::path& known,
                                 const RobotModel& model) const {
    const fs::path& file = known.empty() ? model.description().file : known;
    const bool is_other_file = file.has_extension() && !has_extension(file, ".urdf") &&
                               !has_extension(file, ".xacro") &&
                               fs::exists(fs::absolute(from_ / file));
    if (!file.empty() && !is_other_file) {
      return {known.empty() ? resource_reference(ResourceKind::kRobot, file, to_)
                            : moved_reference(ResourceKind::kRobot, known, from_, to_)};
    }
    const fs::path saved = file_.stem().string() + "_" + file_name_of(name) + ".urdf";
    write_urdf(model, to_ / saved);
    return {saved, true};
  }

  void add_mesh_reference(const SceneObject& object) {
    const fs::path known = file_of(object.shape);
    references_.is_scaled.push_back(!known.empty());
    references_.meshes.push_back(known.empty()
                                     ? save_shape(meshes_, object.name, object.shape)
                                     : resource_reference(ResourceKind::kObject, known, to_));
  }

  // Comments and blank lines at the top of the existing file.
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

std::string objects_text(const Scene& scene, const fs::path& meshes_beside) {
  SavedMeshes meshes(meshes_beside);
  std::string text = "objects:\n";
  for (const SceneObject& object : scene.objects) {
    const fs::path known = file_of(object.shape);
    const fs::path saved = known.empty() ? save_shape(meshes, object.name, object.shape) : known;
    const fs::path file = saved.empty() ? saved : folder_of(meshes_beside) / saved;
    text += object_text(object, scene.display.of(object.name), ShapeText(file, !known.empty()),
                        object.grasps);
  }
  return text;
}

}  // namespace handway::geometric
