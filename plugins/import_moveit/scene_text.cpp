#include "scene_text.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/pose.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::import_moveit {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::Pose;

std::string pose_text(const Pose& X) {
  const Eigen::Quaterniond q(X.linear());
  const Eigen::Vector3d p = X.translation();
  return fmt::format("{{position: [{}, {}, {}], orientation: [{}, {}, {}, {}]}}", p.x(), p.y(),
                     p.z(), q.x(), q.y(), q.z(), q.w());
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
    std::string objects;
    const std::string name = lines_.empty() ? "" : lines_.front();
    line_ = 1;
    while (line_ < lines_.size() && lines_[line_] != ".") {
      if (lines_[line_].empty()) {
        ++line_;
      } else if (lines_[line_].starts_with('*')) {
        objects += object(geometric::trimmed(std::string_view(lines_[line_]).substr(1)));
      } else {
        refuse("\"" + lines_[line_] + "\"", "\"* \" and the name of an object, or \".\"");
      }
    }
    return fmt::format("name: \"{}\"\nrobot_model_name: robot\nworld:\n  collision_objects:{}\n",
                       name, objects.empty() ? " []" : "\n" + objects);
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

  std::string object(std::string_view id) {
    words_.clear();
    at_ = 0;
    // Since Noetic an object has a pose of its own before its shapes.
    static_cast<void>(word());
    at_ = 0;
    const Pose X_WO = words_.size() > 1 ? pose() : Pose::Identity();
    const std::size_t shapes = count();
    std::array<std::vector<std::string>, 3> kinds;
    std::array<std::vector<std::string>, 3> poses;
    for (std::size_t i = 0; i < shapes; ++i) {
      const auto [kind, text] = shape();
      kinds.at(kind).push_back(text);
      poses.at(kind).push_back(pose_text(X_WO * pose()));
      static_cast<void>(numbers(4));  // colour
    }
    while (++line_ < lines_.size() && lines_[line_] != "." && !lines_[line_].starts_with('*')) {
    }
    return fmt::format(
        "    - {{id: \"{}\", primitives: [{}], primitive_poses: [{}], meshes: [{}], mesh_poses: "
        "[{}], planes: [{}], plane_poses: [{}]}}\n",
        id, fmt::join(kinds[0], ", "), fmt::join(poses[0], ", "), fmt::join(kinds[1], ", "),
        fmt::join(poses[1], ", "), fmt::join(kinds[2], ", "), fmt::join(poses[2], ", "));
  }

  // Its list (primitives, meshes, planes) and its message.
  std::pair<std::size_t, std::string> shape() {
    const std::string kind = word();
    if (kind == "box") {
      return {0, fmt::format("{{type: 1, dimensions: {}}}", numbers(3))};
    }
    if (kind == "sphere") {
      return {0, fmt::format("{{type: 2, dimensions: {}}}", numbers(1))};
    }
    if (kind == "cylinder" || kind == "cone") {
      const std::vector<double> size = numbers(2);  // radius, length
      return {0, fmt::format("{{type: {}, dimensions: [{}, {}]}}", kind == "cone" ? 4 : 3, size[1],
                             size[0])};
    }
    if (kind == "plane") {
      return {2, fmt::format("{{coef: {}}}", numbers(4))};
    }
    if (kind != "mesh") {
      refuse("\"" + kind + "\"", "box, sphere, cylinder, cone, mesh or plane");
    }
    const std::size_t vertices = count();
    const std::size_t triangles = count();
    std::string text = "{vertices: [";
    for (std::size_t i = 0; i < vertices; ++i) {
      text += fmt::format("{}{}", i == 0 ? "" : ", ", numbers(3));
    }
    text += "], triangles: [";
    for (std::size_t i = 0; i < triangles; ++i) {
      text += fmt::format("{}{}", i == 0 ? "" : ", ", numbers(3));
    }
    return {1, text + "]}"};
  }

  fs::path file_;
  std::vector<std::string> lines_;
  std::size_t line_ = 0;
  std::vector<std::string> words_;  ///< Of the line.
  std::size_t at_ = 0;              ///< The next of these.
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
