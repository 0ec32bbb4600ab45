#include "scene_text.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/pose.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <sstream>
#include <vector>

namespace handway::import_moveit {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::Pose;

// Writes numbers in a row, each as the shortest that reads back to the same.
YAML::Node list_of(std::span<const double> numbers) {
  YAML::Node list(YAML::NodeType::Sequence);
  list.SetStyle(YAML::EmitterStyle::Flow);
  for (const double number : numbers) {
    list.push_back(fmt::format("{}", number));
  }
  return list;
}

YAML::Node pose_message(const Pose& X) {
  const Eigen::Vector3d p = X.translation();
  const Eigen::Quaterniond q(X.linear());
  YAML::Node pose;
  pose["position"] = list_of({p.data(), 3});
  pose["orientation"] = list_of({q.coeffs().data(), 4});  // x, y, z, w
  return pose;
}

// A shape that is described by a list of numbers.
YAML::Node with_list(const char* key, std::span<const double> numbers) {
  YAML::Node shape;
  shape[key] = list_of(numbers);
  return shape;
}

YAML::Node primitive(int type, std::span<const double> dimensions) {
  YAML::Node shape = with_list("dimensions", dimensions);
  shape["type"] = type;
  return shape;
}

class SceneText {
 public:
  explicit SceneText(const fs::path& file) : file_(file) {
    std::istringstream in(geometric::read_text_file(file, "a MoveIt scene (.scene)"));
    for (std::string line; std::getline(in, line);) {
      lines_.emplace_back(geometric::trimmed(line));
    }
  }

  std::string message() {
    YAML::Node scene;
    scene["name"] = lines_.empty() ? "" : lines_.front();
    scene["robot_model_name"] = "robot";
    YAML::Node objects(YAML::NodeType::Sequence);
    line_ = 1;
    while (line_ < lines_.size() && lines_[line_] != ".") {
      if (lines_[line_].empty()) {
        ++line_;
      } else if (lines_[line_].starts_with('*')) {
        objects.push_back(object(lines_[line_].substr(1)));
      } else {
        refuse("\"" + lines_[line_] + "\"", "\"* \" and the name of an object, or \".\"");
      }
    }
    scene["world"]["collision_objects"] = objects;
    return YAML::Dump(scene);
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError({fmt::format("{}:{}", file_.string(), line_ + 1), "", found, expected, ""});
  }

  // The words up to the next object, one by one.
  std::string word() {
    while (at_ == words_.size()) {
      if (++line_ >= lines_.size() || lines_[line_] == "." || lines_[line_].starts_with('*')) {
        refuse("the end of an object", "more numbers");
      }
      words_.clear();
      std::istringstream in(lines_[line_]);
      for (std::string one; in >> one;) {
        words_.push_back(one);
      }
      at_ = 0;
    }
    return words_[at_++];
  }

  double number() {
    const std::string text = word();
    const auto value = geometric::parse_number(text);
    if (!value) {
      refuse("\"" + text + "\"", "a number");
    }
    return *value;
  }

  std::vector<double> numbers(std::size_t count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(number());
    }
    return values;
  }

  std::size_t count() {
    constexpr double kMost = 1e6;
    const double value = number();
    if (value < 0.0 || value > kMost || value != std::floor(value)) {
      refuse(fmt::format("{}", value), "how many there are");
    }
    return static_cast<std::size_t>(value);
  }

  Pose pose() {
    const std::vector<double> p = numbers(3);
    const std::vector<double> q = numbers(4);
    Pose X = Pose::Identity();
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(turn.norm() > 0.5)) {
      refuse("a quaternion of 0", "x, y, z and w of a turn");
    }
    X.linear() = turn.normalized().toRotationMatrix();
    X.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
    return X;
  }

  YAML::Node object(const std::string& id) {
    words_.clear();
    at_ = 0;
    // Since Noetic an object has a pose of its own before its shapes.
    static_cast<void>(word());
    at_ = 0;
    const Pose X_WO = words_.size() > 1 ? pose() : Pose::Identity();
    YAML::Node object;
    object["id"] = std::string(geometric::trimmed(id));
    for (const char* list :
         {"primitives", "primitive_poses", "meshes", "mesh_poses", "planes", "plane_poses"}) {
      object[list] = YAML::Node(YAML::NodeType::Sequence);
    }
    const std::size_t shapes = count();
    for (std::size_t i = 0; i < shapes; ++i) {
      const std::string kind = word();
      const bool is_mesh = kind == "mesh";
      const bool is_plane = kind == "plane";
      object[is_mesh ? "meshes" : is_plane ? "planes" : "primitives"].push_back(shape(kind));
      object[is_mesh    ? "mesh_poses"
             : is_plane ? "plane_poses"
                        : "primitive_poses"]
          .push_back(pose_message(X_WO * pose()));
      static_cast<void>(numbers(4));  // colour
    }
    while (++line_ < lines_.size() && lines_[line_] != "." && !lines_[line_].starts_with('*')) {
    }
    return object;
  }

  // A shape_msgs/SolidPrimitive, Mesh or Plane.
  YAML::Node shape(const std::string& kind) {
    if (kind == "box") {
      return primitive(1, numbers(3));
    }
    if (kind == "sphere") {
      return primitive(2, numbers(1));
    }
    if (kind == "cylinder" || kind == "cone") {
      std::vector<double> size = numbers(2);  // radius, length
      std::ranges::reverse(size);
      return primitive(kind == "cone" ? 4 : 3, size);
    }
    if (kind == "plane") {
      return with_list("coef", numbers(4));
    }
    if (kind != "mesh") {
      refuse("\"" + kind + "\"", "box, sphere, cylinder, cone, mesh or plane");
    }
    const std::size_t vertices = count();
    const std::size_t triangles = count();
    YAML::Node mesh;
    mesh["vertices"] = triples(vertices);
    mesh["triangles"] = triples(triangles);
    return mesh;
  }

  YAML::Node triples(std::size_t count) {
    YAML::Node list(YAML::NodeType::Sequence);
    for (std::size_t i = 0; i < count; ++i) {
      list.push_back(list_of(numbers(3)));
    }
    return list;
  }

  fs::path file_;
  std::vector<std::string> lines_;
  std::size_t line_ = 0;
  std::vector<std::string> words_;  ///< Words of the line.
  std::size_t at_ = 0;              ///< Index of the next word.
};

}  // namespace

bool is_scene_text(const fs::path& file) { return geometric::has_extension(file, ".scene"); }

std::string planning_scene_of(const fs::path& file) {
  if (const char* robot = std::getenv("HANDWAY_ROBOT"); robot == nullptr || *robot == '\0') {
    throw InputError({file.string(), "", "a scene that names no robot", "a robot for it",
                      "Name its URDF with --robot FILE"});
  }
  return SceneText(file).message();
}

}  // namespace handway::import_moveit
