#include "handway/geometric/formats/urdf.h"

#include "formats/urdf_elements.h"
#include "formats/urdf_geometry.h"
#include "formats/xml_document.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/obj_writer.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/robot/base_joint.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#include <urdf_world/types.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {
namespace {

JointLimits limits_of(const urdf::Joint& joint) {
  JointLimits limits;
  if (joint.limits) {
    limits.lower = joint.limits->lower;
    limits.upper = joint.limits->upper;
    limits.velocity = joint.limits->velocity > 0.0 ? joint.limits->velocity : limits.velocity;
  }
  if (joint.type == urdf::Joint::CONTINUOUS) {
    limits.lower = -std::numeric_limits<double>::infinity();
    limits.upper = std::numeric_limits<double>::infinity();
  }
  return limits;
}

bool is_base(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::PLANAR || joint.type == urdf::Joint::FLOATING;
}

void add_base(const urdf::Joint& joint, RobotDescription& robot) {
  const bool planar = joint.type == urdf::Joint::PLANAR;
  const Eigen::Vector3d normal(joint.axis.x, joint.axis.y, joint.axis.z);
  add_base_joint(robot, {joint.name, planar ? BaseMotion::kPlanar : BaseMotion::kFloating},
                 {joint.parent_link_name, joint.child_link_name,
                  pose_of(joint.parent_to_joint_origin_transform), normal.normalized()});
}

Joint joint_of(const urdf::Joint& joint) {
  Joint result;
  result.name = joint.name;
  result.parent = joint.parent_link_name;
  result.child = joint.child_link_name;
  result.X_PJ = pose_of(joint.parent_to_joint_origin_transform);
  if (joint.type == urdf::Joint::FIXED) {
    return result;
  }
  result.type = joint.type == urdf::Joint::PRISMATIC ? JointType::kPrismatic : JointType::kRevolute;
  result.axis = Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
  result.limits = limits_of(joint);
  if (joint.mimic) {
    result.mimic = Mimic{joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
  }
  return result;
}

// Follows `mimic` to an independent joint; q = m1 * (m2 * q2 + o2) + o1.
void resolve_mimic(Joint& joint, const std::vector<Joint>& joints, const std::string& where) {
  for (std::size_t steps = 0; joint.mimic; ++steps) {
    const auto leader = std::ranges::find(joints, joint.mimic->joint, &Joint::name);
    if (leader == joints.end() || !leader->mimic) {
      return;
    }
    if (steps > joints.size()) {
      throw InputError({where, "joint " + joint.name, "a mimic that leads back to itself",
                        "a joint that moves on its own",
                        "Take the mimic of one of the joints of the ring away"});
    }
    Mimic& mimic = *joint.mimic;
    mimic.offset += mimic.multiplier * leader->mimic->offset;
    mimic.multiplier *= leader->mimic->multiplier;
    mimic.joint = leader->mimic->joint;
  }
}

void note_joints(const std::vector<std::string>& names, const char* what, RobotDescription& robot) {
  if (!names.empty()) {
    robot.warnings.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
  }
}

/// Adds all joints in the order of the file; chains of `mimic` are resolved to the independent
/// joint. Adds to the robot's warnings.
/// @throws InputError if `mimic` forms a ring.
void add_joints(const XmlDocument& document, const urdf::ModelInterface& model,
                RobotDescription& robot) {
  std::vector<std::string> places;
  for (const pugi::xml_node& node : document.root("robot").children("joint")) {
    places.push_back(document.where(node));
    const std::string name = node.attribute("name").value();
    const urdf::JointConstSharedPtr joint = model.getJoint(name);
    if (!joint) {
      throw InputError({places.back(), "joint " + name, "a joint that urdfdom does not read",
                        "what ROS reads too", ""});
    }
    if (is_base(*joint)) {
      add_base(*joint, robot);
      places.resize(robot.joints.size(), places.back());
    } else {
      robot.joints.push_back(joint_of(*joint));
    }
  }
  const std::vector<Joint> as_written = robot.joints;
  std::vector<std::string> rangeless;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    Joint& joint = robot.joints[i];
    resolve_mimic(joint, as_written, places[i]);
    if (joint.type != JointType::kFixed && joint.limits.range() == 0.0) {
      rangeless.push_back(joint.name);
    }
  }
  note_joints(rangeless, "joints that can't move, as their limits leave no range", robot);
}

/// Result of urdfdom for a text, and its messages.
struct UrdfdomResult {
  urdf::ModelInterfaceSharedPtr model;  ///< Null if it refused the text.
  std::vector<std::string> messages;    ///< Errors and warnings, in order.
};

class Collector final : public console_bridge::OutputHandler {
 public:
  explicit Collector(std::vector<std::string>& messages) : messages_(messages) {
    console_bridge::useOutputHandler(this);
  }
  ~Collector() override { console_bridge::restorePreviousOutputHandler(); }
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
           int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) {
      messages_.push_back(text);
    }
  }

 private:
  std::vector<std::string>& messages_;
};

/// Runs urdfdom with its messages caught instead of printed. Any thread.
UrdfdomResult parse_by_urdfdom(const std::string& text) {
  static std::mutex one_at_a_time;  // the output handler is one for the whole program
  const std::lock_guard lock(one_at_a_time);
  UrdfdomResult result;
  const Collector collector(result.messages);
  try {
    result.model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    result.model.reset();
    result.messages.emplace_back(error.what());
  }
  return result;
}

namespace fs = std::filesystem;

constexpr std::size_t kMostLinks = 2000;  // a longer chain could exhaust the stack
constexpr const char* kWhat = "a robot file (URDF)";

// Finds the line of an error: urdfdom describes it without a line. Takes the first link, joint or
// material whose name it quotes.
std::string place_of(const XmlDocument& document, const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    for (const pugi::xml_node& node : document.root("robot").children()) {
      const std::string name = node.attribute("name").value();
      for (const char quote : {'\'', '"', '[', ' '}) {
        const std::size_t at = name.empty() ? std::string::npos : message.find(quote + name);
        if (at != std::string::npos && at + 1 + name.size() < message.size() &&
            !std::isalnum(static_cast<unsigned char>(message[at + 1 + name.size()])) &&
            message[at + 1 + name.size()] != '_') {
          return document.where(node);
        }
      }
    }
  }
  return document.where(document.root("robot"));
}

std::string joined(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& message : messages) {
    text += (text.empty() ? "" : "; ") + message;
  }
  return text;
}

void check_size(const XmlDocument& document) {
  std::size_t count = 0;
  for (const pugi::xml_node& link : document.root("robot").children("link")) {
    if (++count > kMostLinks) {
      throw InputError({document.where(link), "robot",
                        "more links than " + std::to_string(kMostLinks), "a robot of fewer links",
                        ""});
    }
  }
}

// Reads the link of a node. Collision elements that urdfdom drops are not lost.
Link read_link(const XmlDocument& document, const pugi::xml_node& node, std::ptrdiff_t collisions,
               const urdf::ModelInterface& model, const fs::path& folder, LinkFiles& files) {
  const std::string name = node.attribute("name").value();
  const urdf::LinkConstSharedPtr link = model.getLink(name);
  if (!link || std::ssize(link->collision_array) != collisions) {
    throw InputError({document.where(node), "link " + name,
                      "a link that urdfdom reads only in part", "what ROS reads too", ""});
  }
  Link result = link_of(*link, folder, document.where(node), files);
  if (result.visual.empty() && node.child("visual")) {
    result.visual = result.collision;
  }
  return result;
}

void note_links_without_collision(const XmlDocument& document, RobotDescription& robot) {
  std::vector<std::string> names;
  for (const pugi::xml_node& link : document.root("robot").children("link")) {
    if (link.child("visual") && !link.child("collision")) {
      names.emplace_back(link.attribute("name").value());
    }
  }
  if (!names.empty()) {
    robot.warnings.push_back(
        fmt::format("links with visual but no collision geometry, which collide with nothing: {}",
                    fmt::join(names, ", ")));
  }
}

// Narrows joints to the limits of a <safety_controller>. Exporters without such limits write
// zeros.
void keep_soft_limits(const XmlDocument& document, RobotDescription& robot) {
  for (const pugi::xml_node& node : document.root("robot").children("joint")) {
    const pugi::xml_node safety = node.child("safety_controller");
    const auto joint =
        std::ranges::find(robot.joints, std::string(node.attribute("name").value()), &Joint::name);
    if (!safety || joint == robot.joints.end() || joint->type == JointType::kFixed) {
      continue;
    }
    const auto limit = [&](const char* name) {
      const pugi::xml_attribute attribute = safety.attribute(name);
      const std::optional<double> value = parse_number(attribute.value());
      if (attribute && !value) {
        robot.warnings.push_back(
            fmt::format("joint {}: <safety_controller {}=\"{}\"> is no number and is not kept",
                        joint->name, name, attribute.value()));
      }
      return value;
    };
    const std::optional<double> lower = limit("soft_lower_limit");
    const std::optional<double> upper = limit("soft_upper_limit");
    if (lower.value_or(0.0) != 0.0 || upper.value_or(0.0) != 0.0) {
      narrow_limits(robot, *joint, lower, upper, "<safety_controller>");
    }
  }
}

}  // namespace

namespace {

std::optional<MujocoCompiler> mujoco_compiler(const pugi::xml_node& robot) {
  const pugi::xml_node compiler = robot.child("mujoco").child("compiler");
  if (!compiler) {
    return std::nullopt;
  }
  const pugi::xml_attribute assets = compiler.attribute("assetdir");
  const pugi::xml_attribute meshes = compiler.attribute("meshdir");
  return MujocoCompiler{with_slashes(meshes ? meshes.value() : assets.value()),
                        std::string_view(compiler.attribute("strippath").value()) != "false"};
}

}  // namespace

RobotDescription read_urdf(const fs::path& file, const fs::path& place) {
  const XmlDocument document(file, kWhat);
  check_size(document);
  UrdfElements elements = check_urdf_elements(document);
  const UrdfdomResult parsed = parse_by_urdfdom(elements.text);
  if (!parsed.model) {
    const std::string reason = joined(parsed.messages);
    throw InputError({place_of(document, parsed.messages), "robot",
                      reason.empty() ? "something that makes no robot" : reason, kWhat, ""});
  }
  RobotDescription robot;
  robot.name = parsed.model->getName();
  robot.file = file;
  robot.warnings = parsed.messages;
  robot.warnings.insert(robot.warnings.end(), elements.warnings.begin(), elements.warnings.end());
  const fs::path folder =
      fs::absolute(place.empty() ? file.parent_path() : place).lexically_normal();
  LinkFiles files;
  files.drawing = std::move(elements.drawing);
  files.compiler = mujoco_compiler(document.root("robot"));
  for (const pugi::xml_node& node : document.root("robot").children("link")) {
    if (const auto read = elements.links.find(node.attribute("name").value());
        read != elements.links.end()) {
      robot.links.push_back(read_link(document, node, read->second, *parsed.model, folder, files));
    }
  }
  files.missing.refuse();
  add_joints(document, *parsed.model, robot);
  keep_soft_limits(document, robot);
  note_links_without_collision(document, robot);
  if (const std::string faults = files.drawing.summary(); !faults.empty()) {
    robot.warnings.push_back(faults);
  }
  if (!files.renamed.empty()) {
    robot.warnings.push_back(fmt::format("files whose names have other letters on the disk: {}",
                                         fmt::join(files.renamed, ", ")));
  }
  if (!files.by_compiler.empty()) {
    robot.warnings.push_back(fmt::format(
        "{} mesh{} where <mujoco><compiler meshdir=\"{}\"> says", files.by_compiler.size(),
        files.by_compiler.size() == 1 ? " is" : "es are", files.compiler->mesh_folder.string()));
  }
  if (const std::string found = files.found_elsewhere(); !found.empty()) {
    robot.warnings.push_back(found);
  }
  const fs::path srdf = existing_file(fs::path(file).replace_extension(".srdf"));
  if (place.empty() && fs::exists(srdf)) {
    read_srdf(srdf, robot);
  }
  return robot;
}

namespace {

std::string triple(const Eigen::Vector3d& v) {
  return number_text(v.x()) + ' ' + number_text(v.y()) + ' ' + number_text(v.z());
}

void set(pugi::xml_node node, const char* attribute, const std::string& value) {
  node.append_attribute(attribute) = value.c_str();
}

void append_origin(pugi::xml_node node, const Pose& X) {
  pugi::xml_node origin = node.append_child("origin");
  set(origin, "xyz", triple(X.translation()));
  set(origin, "rpy", triple(rpy_from_rotation(X.linear())));
}

class UrdfText {
 public:
  UrdfText(const RobotModel& model, const fs::path& file)
      : folder_(fs::absolute(file).parent_path()), meshes_(file) {
    root_ = document_.append_child("robot");
    set(root_, "name", model.name());
    for (int i = 0; i < model.link_count(); ++i) {
      append_link(model.link(i));
    }
    for (int i = 1; i < model.link_count(); ++i) {
      append_joint(model.joint(i));
    }
  }

  [[nodiscard]] std::string text() const { return xml_text(document_); }

 private:
  void append_link(const Link& link) {
    pugi::xml_node element = root_.append_child("link");
    set(element, "name", link.name);
    for (const LinkGeometry& visual : link.visual) {
      pugi::xml_node child = element.append_child("visual");
      append_geometry(child, link.name + "_visual", visual);
      pugi::xml_node material = child.append_child("material");
      set(material, "name", link.name + "_" + std::to_string(++material_count_));
      const Color& c = visual.color;
      set(material.append_child("color"), "rgba",
          number_text(c.red) + ' ' + number_text(c.green) + ' ' + number_text(c.blue) + ' ' +
              number_text(c.alpha));
    }
    for (const LinkGeometry& collision : link.collision) {
      append_geometry(element.append_child("collision"), link.name + "_collision", collision);
    }
  }

  void append_geometry(pugi::xml_node parent, const std::string& name,
                       const LinkGeometry& geometry) {
    append_origin(parent, geometry.X_LG);
    pugi::xml_node element = parent.append_child("geometry");
    if (const auto* box = std::get_if<Box>(&geometry.shape)) {
      set(element.append_child("box"), "size", triple(box->size));
    } else if (const auto* sphere = std::get_if<Sphere>(&geometry.shape)) {
      set(element.append_child("sphere"), "radius", number_text(sphere->radius));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry.shape)) {
      pugi::xml_node child = element.append_child("cylinder");
      set(child, "radius", number_text(cylinder->radius));
      set(child, "length", number_text(cylinder->length));
    } else {
      append_mesh(element.append_child("mesh"), name, geometry.shape);
    }
  }

  void append_mesh(pugi::xml_node element, const std::string& name, const Shape& shape) {
    const Mesh* mesh = std::get_if<Mesh>(&shape);
    if (!mesh || mesh->file.empty() || !is_mesh_file(mesh->file)) {
      set(element, "filename", meshes_.save(name, *tessellate(shape)).generic_string());
      return;
    }
    const fs::path relative = fs::absolute(mesh->file).lexically_relative(folder_);
    const bool inside = !relative.empty() && *relative.begin() != "..";
    set(element, "filename", inside ? relative.generic_string() : "file://" + mesh->file.string());
    set(element, "scale", triple(mesh->scale));
  }

  void append_joint(const Joint& joint) {
    pugi::xml_node element = root_.append_child("joint");
    set(element, "name", joint.name);
    set(element, "type",
        joint.type == JointType::kFixed      ? "fixed"
        : joint.is_continuous()              ? "continuous"
        : joint.type == JointType::kRevolute ? "revolute"
                                             : "prismatic");
    append_origin(element, joint.X_PJ);
    set(element.append_child("parent"), "link", joint.parent);
    set(element.append_child("child"), "link", joint.child);
    if (joint.type == JointType::kFixed) {
      return;
    }
    set(element.append_child("axis"), "xyz", triple(joint.axis));
    pugi::xml_node limit = element.append_child("limit");
    if (!joint.is_continuous()) {
      set(limit, "lower", number_text(joint.limits.lower));
      set(limit, "upper", number_text(joint.limits.upper));
    }
    set(limit, "effort", "0");
    set(limit, "velocity",
        std::isfinite(joint.limits.velocity) ? number_text(joint.limits.velocity) : "0");
    if (joint.mimic) {
      pugi::xml_node mimic = element.append_child("mimic");
      set(mimic, "joint", joint.mimic->joint);
      set(mimic, "multiplier", number_text(joint.mimic->multiplier));
      set(mimic, "offset", number_text(joint.mimic->offset));
    }
  }

  fs::path folder_;
  SavedMeshes meshes_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  int material_count_ = 0;
};

}  // namespace

void write_urdf(const RobotModel& model, const fs::path& file) {
  const UrdfText urdf(model, file);
  write_srdf(model.description(), fs::path(file).replace_extension(".srdf"));
  replace_file(file, urdf.text());
}

}  // namespace handway::geometric
