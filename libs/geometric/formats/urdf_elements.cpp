#include "formats/urdf_elements.h"

#include "formats/xml_vocabulary.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace handway::geometric {
namespace {

constexpr const char* kBlanks = " \t\r\n";

const XmlVocabulary& vocabulary() {
  static const XmlVocabulary kVocabulary = {
      {"robot", {.children = {"link", "joint", "material", "mujoco"}}},
      {"mujoco", {.children = {"compiler"}}},
      {"link", {.children = {"inertial", "visual", "collision"}}},
      {"inertial", {.children = {"origin", "mass", "inertia"}}},
      {"visual", {.children = {"origin", "geometry", "material"}}},
      {"collision", {.children = {"origin", "geometry"}}},
      {"geometry", {.children = {"box", "sphere", "cylinder", "capsule", "mesh"}}},
      {"box", {.attributes = {"size"}}},
      {"sphere", {.attributes = {"radius"}}},
      {"cylinder", {.attributes = {"radius", "length"}}},
      {"capsule", {.attributes = {"radius", "length"}}},
      {"mesh", {.attributes = {"filename", "scale"}}},
      {"origin", {.attributes = {"xyz", "rpy", "quat_xyzw"}}},
      {"material", {.children = {"color", "texture"}}},
      {"joint",
       {.children = {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics",
                     "calibration", "safety_controller"},
        .attributes = {"name", "type"}}},
      {"parent", {.attributes = {"link"}}},
      {"child", {.attributes = {"link"}}},
      {"axis", {.attributes = {"xyz"}}},
      {"limit", {.attributes = {"lower", "upper", "effort", "velocity"}}},
      {"mimic", {.attributes = {"joint", "multiplier", "offset"}}}};
  return kVocabulary;
}

// Elements that planning needs, so that they must not be misplaced.
const std::vector<std::string> kNeeded = {"link", "joint",  "collision", "geometry",
                                          "box",  "sphere", "cylinder",  "capsule",
                                          "mesh", "limit",  "mimic"};

// Returns the rotation Rz(yaw) Ry(pitch) Rx(roll) by the quaternion of the half angles, as ROS
// computes it: pose_from_rpy() differs from it by rounding.
Eigen::Matrix3d rotation_of(const std::vector<double>& rpy) {
  const double cr = std::cos(rpy[0] / 2.0);
  const double sr = std::sin(rpy[0] / 2.0);
  const double cp = std::cos(rpy[1] / 2.0);
  const double sp = std::sin(rpy[1] / 2.0);
  const double cy = std::cos(rpy[2] / 2.0);
  const double sy = std::sin(rpy[2] / 2.0);
  const double x = sr * cp * cy - cr * sp * sy;
  const double y = cr * sp * cy + sr * cp * sy;
  const double z = cr * cp * sy - sr * sp * cy;
  const double w = cr * cp * cy + sr * sp * sy;
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  return Eigen::Quaterniond(w / norm, x / norm, y / norm, z / norm).normalized().toRotationMatrix();
}

}  // namespace

void UrdfElements::refuse(const pugi::xml_node& node, const std::string& element,
                          const std::string& found, const std::string& expected,
                          const std::string& advice) const {
  throw InputError({document_.where(node), element, found, expected, advice});
}

std::vector<double> UrdfElements::numbers(const pugi::xml_node& node, const std::string& element,
                                          const char* attribute, std::size_t count) const {
  const std::string text = node.attribute(attribute).value();
  std::vector<double> values;
  std::size_t begin = text.find_first_not_of(kBlanks);
  while (begin != std::string::npos) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    const std::optional<double> value = parse_number(text.substr(begin, end - begin));
    if (!value || std::abs(*value) > kLargestNumber) {
      break;
    }
    values.push_back(*value + 0.0);  // -0 becomes 0
    begin = text.find_first_not_of(kBlanks, end);
  }
  if (values.size() != count || begin != std::string::npos) {
    refuse(
        node, element, fmt::format("{}=\"{}\"", attribute, text),
        count == 1 ? "a number within ±1000000" : fmt::format("{} numbers within ±1000000", count),
        text.find(',') == std::string::npos ? "" : "Write 0.5 for 0,5, and blanks between");
  }
  return values;
}

double UrdfElements::number(const pugi::xml_node& node, const std::string& element,
                            const char* attribute, double otherwise) const {
  return node.attribute(attribute) ? numbers(node, element, attribute, 1).front() : otherwise;
}

std::vector<double> UrdfElements::sizes(const pugi::xml_node& node, const std::string& element,
                                        const char* attribute, std::size_t count) const {
  need(node, element, attribute);
  std::vector<double> values = numbers(node, element, attribute, count);
  if (std::ranges::any_of(values, [](double value) { return value <= 0.0; })) {
    refuse(node, element, fmt::format("{}=\"{}\"", attribute, node.attribute(attribute).value()),
           "a size above 0 m");
  }
  return values;
}

Pose UrdfElements::origin(const pugi::xml_node& parent, const std::string& element) {
  Pose X = Pose::Identity();
  const pugi::xml_node origin = parent.child("origin");
  if (const pugi::xml_node second = origin.next_sibling("origin")) {
    second_origins_.push_back(fmt::format("{} ({})", element, document_.where(second)));
  }
  if (origin.attribute("xyz")) {
    const std::vector<double> xyz = numbers(origin, element, "xyz", 3);
    X.translation() = Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
  }
  if (origin.attribute("quat_xyzw")) {  // of URDF 1.2
    const std::vector<double> q = numbers(origin, element, "quat_xyzw", 4);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (turn.norm() < 1e-6 || origin.attribute("rpy")) {
      refuse(origin, element, "a quat_xyzw without direction or beside an rpy",
             "rpy, or a quat_xyzw other than 0");
    }
    X.linear() = turn.normalized().toRotationMatrix();
  } else if (origin.attribute("rpy")) {
    X.linear() = rotation_of(numbers(origin, element, "rpy", 3));
  }
  return X;
}

pugi::xml_node UrdfElements::only(const pugi::xml_node& parent, const std::string& element,
                                  const char* name) const {
  const pugi::xml_node child = parent.child(name);
  if (const pugi::xml_node second = child.next_sibling(name)) {
    refuse(second, element, fmt::format("a second <{}>", name), "one at most",
           "Make an element of its own for each");
  }
  return child;
}

void UrdfElements::need(const pugi::xml_node& node, const std::string& element,
                        const char* attribute) const {
  if (*node.attribute(attribute).value() == '\0') {
    refuse(node, element, fmt::format("<{}> without {}", node.name(), attribute),
           fmt::format("{}=\"…\"", attribute));
  }
}

void add_warning(const std::string& what, const std::vector<std::string>& names,
                 std::vector<std::string>& warnings) {
  if (!names.empty()) {
    warnings.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
  }
}

std::vector<std::string> check_urdf_names(const XmlDocument& document) {
  const std::vector<std::string> unread =
      unread_elements(document, document.root("robot"), vocabulary(), kNeeded);
  std::vector<std::string> warnings;
  add_warning("elements that are not read", unread, warnings);
  if (std::ranges::any_of(unread,
                          [](const std::string& name) { return name.starts_with("<xacro:"); })) {
    warnings.emplace_back(
        "macros that xacro did not know are left out: what they stand for is missing");
  }
  return warnings;
}

}  // namespace handway::geometric
