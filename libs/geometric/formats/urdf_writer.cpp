#include "formats/xml_document.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/obj_writer.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <variant>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

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
