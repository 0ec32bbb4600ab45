#include "formats/urdf_elements.h"

#include "formats/xml_document.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/base_joint.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <string_view>

namespace handway::geometric {
void DrawingFaults::add(const InputError& fault) {
  const InputProblem& problem = fault.problem();
  faults_.push_back(fmt::format("{}: {}: {}", problem.source, problem.element, problem.found));
}

std::string DrawingFaults::summary() const {
  constexpr std::size_t kMostNamed = 3;
  if (faults_.empty()) {
    return "";
  }
  std::string text = fmt::format(
      "{} visual element{} can't be read, the collision geometry is drawn where nothing else is: ",
      faults_.size(), faults_.size() == 1 ? "" : "s");
  const std::size_t named = std::min(kMostNamed, faults_.size());
  for (std::size_t i = 0; i < named; ++i) {
    text += (i == 0 ? "" : "; ") + faults_[i];
  }
  if (faults_.size() > named) {
    text += fmt::format("; and {} more", faults_.size() - named);
  }
  return text;
}

namespace {

constexpr double kLargestNumber = 1e6;  // m or rad: what is beyond is a slip

const std::vector<std::string> kShapes = {"box", "sphere", "cylinder", "capsule", "mesh"};
const std::vector<std::string> kJointTypes = {"revolute", "continuous", "prismatic",
                                              "fixed",    "planar",     "floating"};

// http://wiki.ros.org/urdf/XML
const XmlVocabulary& vocabulary() {
  static const XmlVocabulary kVocabulary = {
      {"robot", {.children = {"link", "joint", "material", "mujoco"}}},
      {"mujoco", {.children = {"compiler"}}},
      {"link", {.children = {"inertial", "visual", "collision"}}},
      {"inertial", {.children = {"origin", "mass", "inertia"}}},
      {"visual", {.children = {"origin", "geometry", "material"}}},
      {"collision", {.children = {"origin", "geometry"}}},
      {"geometry", {.children = kShapes}},
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

class ElementReader {
 public:
  explicit ElementReader(const XmlDocument& document) : document_(document) {}

  [[nodiscard]] UrdfElements read() {
    const pugi::xml_node robot = document_.root("robot");
    note_unread(unread_elements(document_, robot, vocabulary(), kNeeded));
    read_joint_names(robot);
    robot_ = text_.append_child("robot");
    copy_name(robot);
    read_materials(robot);
    const std::set<std::string> alone = links_on_their_own(robot);
    for (const pugi::xml_node& link : robot.children("link")) {
      if (!alone.contains(link.attribute("name").value())) {
        read_link(link);
      }
    }
    for (const pugi::xml_node& joint : robot.children("joint")) {
      read_joint(joint);
    }
    note_undefined_materials();
    note({alone.begin(), alone.end()}, "links that no joint connects are left out");
    note(second_origins_, "elements with a second <origin>, of which the first is taken");
    note(sizeless_, "collision shapes without size, which collide with nothing");
    note(endless_, "joints whose limits are beyond ±1000000 turn without end");
    note(endless_slides_,
         fmt::format("slides whose limits are beyond ±1000000 go ±{:g} m", kDefaultBaseReach));
    result_.text = xml_text(text_);
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& element,
                           const std::string& found, const std::string& expected,
                           const std::string& advice = "") const {
    throw InputError({document_.where(node), element, found, expected, advice});
  }

  static void copy_attribute(const pugi::xml_node& from, const char* name, pugi::xml_node to) {
    if (const pugi::xml_attribute attribute = from.attribute(name)) {
      to.append_attribute(name) = attribute.value();
    }
  }

  void note(const std::vector<std::string>& names, const std::string& what) {
    if (!names.empty()) {
      result_.warnings.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
    }
  }

  void note_unread(const std::vector<std::string>& unread) {
    note(unread, "elements that are not read");
    if (std::ranges::any_of(unread,
                            [](const std::string& name) { return name.starts_with("<xacro:"); })) {
      result_.warnings.emplace_back(
          "macros that xacro did not know are left out: what they stand for is missing");
    }
  }

  void copy_name(const pugi::xml_node& robot) {
    std::string name = robot.attribute("name").value();
    if (name.empty()) {
      name = document_.file().stem().string();
      result_.warnings.push_back("the robot has no name; it is called after its file");
    }
    robot_.append_attribute("name") = name.c_str();
  }

  // The tree's links.

  // Returns links that no joint connects, if the other links form a robot by joints.
  [[nodiscard]] std::set<std::string> links_on_their_own(const pugi::xml_node& robot) const {
    std::set<std::string> parents;
    std::set<std::string> children;
    for (const pugi::xml_node& joint : robot.children("joint")) {
      parents.insert(joint.child("parent").attribute("link").value());
      children.insert(joint.child("child").attribute("link").value());
    }
    std::set<std::string> alone;
    std::vector<std::string> roots;
    pugi::xml_node second;
    for (const pugi::xml_node& link : robot.children("link")) {
      const std::string name = link.attribute("name").value();
      if (children.contains(name)) {
        continue;
      }
      if (!parents.contains(name) && !parents.empty()) {
        alone.insert(name);
        continue;
      }
      roots.push_back(name);
      second = roots.size() == 2 ? link : second;
    }
    if (second) {
      refuse(second, "robot",
             fmt::format("several links that no joint carries: \"{}\"", fmt::join(roots, "\", \"")),
             "one, the root", "Connect them by a fixed joint");
    }
    return alone;
  }

  // Numbers.

  [[nodiscard]] std::vector<double> numbers(const pugi::xml_node& node, const std::string& element,
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
      values.push_back(*value);
      begin = text.find_first_not_of(kBlanks, end);
    }
    if (values.size() != count || begin != std::string::npos) {
      refuse(node, element, fmt::format("{}=\"{}\"", attribute, text),
             count == 1 ? "a number within ±1000000"
                        : fmt::format("{} numbers within ±1000000", count),
             text.find(',') == std::string::npos ? "" : "Write 0.5 for 0,5, and blanks between");
    }
    return values;
  }

  [[nodiscard]] double number(const pugi::xml_node& node, const std::string& element,
                              const char* attribute) const {
    return numbers(node, element, attribute, 1).front();
  }

  static void set(pugi::xml_node node, const char* attribute, const std::vector<double>& values) {
    std::string text;
    for (const double value : values) {
      text += text.empty() ? "" : " ";
      text += number_text(value);
    }
    node.append_attribute(attribute) = text.c_str();
  }

  void need(const pugi::xml_node& node, const std::string& element, const char* attribute) const {
    if (*node.attribute(attribute).value() == '\0') {
      refuse(node, element, fmt::format("<{}> without {}", node.name(), attribute),
             fmt::format("{}=\"…\"", attribute));
    }
  }

  void copy_positive(const pugi::xml_node& from, const std::string& element, const char* attribute,
                     std::size_t count, pugi::xml_node to) const {
    need(from, element, attribute);
    const std::vector<double> values = numbers(from, element, attribute, count);
    if (std::ranges::any_of(values, [](double value) { return value <= 0.0; })) {
      refuse(from, element, fmt::format("{}=\"{}\"", attribute, from.attribute(attribute).value()),
             "a size above 0 m");
    }
    set(to, attribute, values);
  }

  void copy_numbers(const pugi::xml_node& from, const std::string& element, const char* attribute,
                    std::size_t count, pugi::xml_node to) const {
    if (from.attribute(attribute)) {
      set(to, attribute, numbers(from, element, attribute, count));
    }
  }

  /// Returns the only child of this name; an empty node if it is missing.
  [[nodiscard]] pugi::xml_node only(const pugi::xml_node& parent, const std::string& element,
                                    const char* name) const {
    const pugi::xml_node child = parent.child(name);
    if (const pugi::xml_node second = child.next_sibling(name)) {
      refuse(second, element, fmt::format("a second <{}>", name), "one at most",
             "Make an element of its own for each");
    }
    return child;
  }

  // Links.

  void copy_origin(const pugi::xml_node& from, const std::string& element, pugi::xml_node to) {
    const pugi::xml_node origin = from.child("origin");
    if (!origin) {
      return;
    }
    if (const pugi::xml_node second = origin.next_sibling("origin")) {
      second_origins_.push_back(fmt::format("{} ({})", element, document_.where(second)));
    }
    pugi::xml_node copy = to.append_child("origin");
    copy_numbers(origin, element, "xyz", 3, copy);
    if (!origin.attribute("quat_xyzw")) {
      copy_numbers(origin, element, "rpy", 3, copy);
      return;
    }
    // The attribute quat_xyzw is of URDF 1.2, which urdfdom doesn't know yet.
    const std::vector<double> q = numbers(origin, element, "quat_xyzw", 4);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (turn.norm() < 1e-6 || origin.attribute("rpy")) {
      refuse(origin, element, "a quat_xyzw without direction or beside an rpy",
             "rpy, or a quat_xyzw other than 0");
    }
    const Eigen::Vector3d rpy = rpy_from_rotation(turn.normalized().toRotationMatrix());
    set(copy, "rpy", {rpy.x(), rpy.y(), rpy.z()});
  }

  void copy_geometry(const pugi::xml_node& from, const std::string& element,
                     pugi::xml_node to) const {
    const pugi::xml_node geometry = only(from, element, "geometry");
    pugi::xml_node shape;
    for (const pugi::xml_node& child : geometry.children()) {
      if (std::ranges::find(kShapes, std::string_view(child.name())) == kShapes.end()) {
        continue;
      }
      if (shape) {
        refuse(child, element, fmt::format("a second shape, <{}>", child.name()), "one shape",
               "Make an element of its own for each");
      }
      shape = child;
    }
    if (!shape) {
      refuse(geometry ? geometry : from, element, "no shape that can be read",
             "a <geometry> with a box, sphere, cylinder, capsule or mesh");
    }
    const std::string_view kind = shape.name();
    const bool capsule = kind == kCapsule;
    if (capsule) {
      to.append_attribute("name") = kCapsule;
    }
    pugi::xml_node copy =
        to.append_child("geometry").append_child(capsule ? "cylinder" : shape.name());
    if (kind == "box") {
      copy_positive(shape, element, "size", 3, copy);
    } else if (kind == "mesh") {
      copy_mesh(shape, element, copy);
    } else {
      copy_positive(shape, element, "radius", 1, copy);
      if (kind != "sphere") {
        copy_positive(shape, element, "length", 1, copy);
      }
    }
  }

  // Returns whether a shape is a mere point, as converters give to links that are frames.
  [[nodiscard]] static bool has_no_size(const pugi::xml_node& collision) {
    const pugi::xml_node geometry = collision.child("geometry");
    const auto zero = [&](const char* shape, const char* attribute) {
      const std::string text = geometry.child(shape).attribute(attribute).value();
      return text.find('0') != std::string::npos &&
             text.find_first_not_of("0. \t\r\n") == std::string::npos;
    };
    return zero("box", "size") || zero("sphere", "radius") ||
           (zero("cylinder", "radius") && zero("cylinder", "length"));
  }

  void copy_mesh(const pugi::xml_node& mesh, const std::string& element,
                 pugi::xml_node copy) const {
    need(mesh, element, "filename");
    copy.append_attribute("filename") = mesh.attribute("filename").value();
    copy_numbers(mesh, element, "scale", 3, copy);
    for (const double factor :
         mesh.attribute("scale") ? numbers(mesh, element, "scale", 3) : std::vector<double>()) {
      if (factor == 0.0) {
        refuse(mesh, element, fmt::format("scale=\"{}\"", mesh.attribute("scale").value()),
               "three numbers other than 0");
      }
    }
  }

  void read_link(const pugi::xml_node& link) {
    const std::string name = document_.need(link, "name");
    pugi::xml_node copy = robot_.append_child("link");
    copy.append_attribute("name") = name.c_str();
    std::ptrdiff_t& collisions = result_.links[name];
    for (const pugi::xml_node& collision : link.children("collision")) {
      if (has_no_size(collision)) {
        sizeless_.push_back(name);
        continue;
      }
      ++collisions;
      pugi::xml_node target = copy.append_child("collision");
      const std::string element = "link " + name + ", collision";
      copy_origin(collision, element, target);
      copy_geometry(collision, element, target);
    }
    for (const pugi::xml_node& visual : link.children("visual")) {
      pugi::xml_node target = copy.append_child("visual");
      const std::string element = "link " + name + ", visual";
      try {
        copy_origin(visual, element, target);
        copy_geometry(visual, element, target);
        copy_material(visual, target);
      } catch (const InputError& fault) {
        result_.drawing.add(fault);
        copy.remove_child(target);
      }
    }
  }

  // Reads materials: errors in them are no reason for a refusal.

  [[nodiscard]] static std::optional<std::string> rgba_of(const pugi::xml_node& material) {
    std::string text = material.child("color").attribute("rgba").value();
    std::vector<double> parts;
    for (std::size_t begin = text.find_first_not_of(kBlanks); begin != std::string::npos;) {
      const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
      const std::optional<double> part = parse_number(text.substr(begin, end - begin));
      if (!part) {
        return std::nullopt;
      }
      parts.push_back(std::clamp(*part, 0.0, 1.0));
      begin = text.find_first_not_of(kBlanks, end);
    }
    if (parts.size() == 3) {
      parts.push_back(1.0);  // opaque
    }
    if (parts.size() != 4) {
      return std::nullopt;
    }
    return fmt::format("{} {} {} {}", number_text(parts[0]), number_text(parts[1]),
                       number_text(parts[2]), number_text(parts[3]));
  }

  static void append_material(pugi::xml_node to, const std::string& name, const std::string& rgba) {
    pugi::xml_node material = to.append_child("material");
    material.append_attribute("name") = name.c_str();
    if (!rgba.empty()) {
      material.append_child("color").append_attribute("rgba") = rgba.c_str();
    }
  }

  // The colours that the file defines by name, at the top or where they are first used.
  void read_materials(const pugi::xml_node& robot) {
    const auto define = [&](const pugi::xml_node& material) {
      const std::string name = material.attribute("name").value();
      const std::optional<std::string> rgba = rgba_of(material);
      if (!name.empty() && rgba && materials_.insert(name).second) {
        append_material(robot_, name, *rgba);
      }
    };
    for (const pugi::xml_node& material : robot.children("material")) {
      define(material);
    }
    for (const pugi::xml_node& link : robot.children("link")) {
      for (const pugi::xml_node& visual : link.children("visual")) {
        define(visual.child("material"));
      }
    }
  }

  void copy_material(const pugi::xml_node& visual, pugi::xml_node to) {
    const pugi::xml_node material = visual.child("material");
    if (!material) {
      return;
    }
    std::string name = material.attribute("name").value();
    const std::optional<std::string> rgba = rgba_of(material);
    if (rgba) {
      name = name.empty() ? fmt::format("unnamed {}", ++unnamed_materials_) : name;
      append_material(to, name, *rgba);
    } else if (materials_.contains(name)) {
      append_material(to, name, "");
    } else if (!name.empty() && !material.child("texture")) {
      undefined_materials_.insert(name);
    }
  }

  void note_undefined_materials() {
    if (!undefined_materials_.empty()) {
      result_.warnings.push_back(fmt::format("materials without a colour that can be read: \"{}\"",
                                             fmt::join(undefined_materials_, "\", \"")));
    }
  }

  // Joints.

  void read_joint_names(const pugi::xml_node& robot) {
    for (const pugi::xml_node& joint : robot.children("joint")) {
      joint_names_.emplace_back(joint.attribute("name").value());
    }
    for (const pugi::xml_node& link : robot.children("link")) {
      const std::string name = document_.need(link, "name");
      if (std::ranges::count(link_names_, name) > 0) {
        refuse(link, "robot", "a second link \"" + name + "\"", "unique names");
      }
      link_names_.push_back(name);
    }
  }

  void read_joint(const pugi::xml_node& joint) {
    const std::string element = "joint " + document_.need(joint, "name");
    const std::string type = document_.need(joint, "type");
    if (std::ranges::count(kJointTypes, type) == 0) {
      refuse(joint, element, "type \"" + type + "\"",
             fmt::format("{}", fmt::join(kJointTypes, ", ")));
    }
    pugi::xml_node copy = robot_.append_child("joint");
    copy_attribute(joint, "name", copy);
    copy_attribute(joint, "type", copy);
    for (const char* end : {"parent", "child"}) {
      const pugi::xml_node link = only(joint, element, end);
      if (!link) {
        refuse(joint, element, std::string("no <") + end + ">",
               std::string("<") + end + " link=\"…\"/>");
      }
      const std::string name = document_.need(link, "link");
      if (std::ranges::count(link_names_, name) == 0) {
        refuse(link, element, fmt::format("the unknown {} link \"{}\"", end, name),
               "a link of the robot", advise_name(name, link_names_));
      }
      copy.append_child(end).append_attribute("link") = name.c_str();
    }
    copy_origin(joint, element, copy);
    if (type == "planar" || type == "floating") {
      if (const pugi::xml_node mimic = joint.child("mimic")) {
        refuse(mimic, element, "<mimic> of a joint of type " + type, "none");
      }
      // Without a normal a planar joint moves across z, as in MoveIt.
      copy_axis(joint, element, copy);
      if (!copy.child("axis")) {
        set(copy.append_child("axis"), "xyz", {0.0, 0.0, 1.0});
      }
    } else if (type != "fixed") {
      copy_axis(joint, element, copy);
      copy_limit(joint, element, type, copy);
      copy_mimic(joint, element, copy);
    }
  }

  void copy_axis(const pugi::xml_node& joint, const std::string& element,
                 pugi::xml_node copy) const {
    if (const pugi::xml_node axis = only(joint, element, "axis")) {
      static_cast<void>(document_.need(axis, "xyz"));
      const std::vector<double> xyz = numbers(axis, element, "xyz", 3);
      if (Eigen::Vector3d(xyz[0], xyz[1], xyz[2]).norm() < 1e-9) {
        refuse(axis, element, "an axis without direction", "an axis such as \"0 0 1\"");
      }
      set(copy.append_child("axis"), "xyz", xyz);
    }
  }

  // A continuous joint has no limits but of its velocity.
  void copy_limit(const pugi::xml_node& joint, const std::string& element, const std::string& type,
                  pugi::xml_node copy) {
    const pugi::xml_node limit = only(joint, element, "limit");
    const bool ends = type != "continuous";
    if (!limit) {
      if (ends) {
        refuse(joint, element, "no <limit>",
               R"(<limit lower="…" upper="…" effort="…" velocity="…"/>)",
               "A joint that turns without end is of type continuous");
      }
      return;
    }
    const auto value = [&](const char* attribute) {
      return limit.attribute(attribute) ? number(limit, element, attribute) : 0.0;
    };
    pugi::xml_node target = copy.append_child("limit");
    const double velocity = is_beyond(limit, "velocity") ? 0.0 : value("velocity");
    if (velocity < 0.0) {
      refuse(limit, element, fmt::format("velocity=\"{}\"", limit.attribute("velocity").value()),
             "0 or more", "Write 0 if it is not known");
    }
    set(target, "velocity", {velocity});
    set(target, "effort", {0.0});
    if (ends && is_beyond(limit, "lower", -1.0) && is_beyond(limit, "upper")) {
      leave_without_end(joint, type, copy, target);
    } else if (ends) {
      const double lower = value("lower");
      const double upper = value("upper");
      if (lower > upper) {
        refuse(limit, element,
               fmt::format("a lower limit of {} above the upper one of {}",
                           limit.attribute("lower").value(), limit.attribute("upper").value()),
               "lower below upper", "Swap them");
      }
      set(target, "lower", {lower});
      set(target, "upper", {upper});
    }
  }

  // Returns whether a limit is so large that it means "no limit".
  [[nodiscard]] static bool is_beyond(const pugi::xml_node& limit, const char* attribute,
                                      double side = 1.0) {
    const std::string text = limit.attribute(attribute).value();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0' && side * value > kLargestNumber;
  }

  void leave_without_end(const pugi::xml_node& joint, const std::string& type, pugi::xml_node copy,
                         pugi::xml_node limit) {
    const std::string name = joint.attribute("name").value();
    if (type == "prismatic") {
      set(limit, "lower", {-kDefaultBaseReach});
      set(limit, "upper", {kDefaultBaseReach});
      endless_slides_.push_back(name);
    } else {
      copy.attribute("type") = "continuous";
      endless_.push_back(name);
    }
  }

  void copy_mimic(const pugi::xml_node& joint, const std::string& element,
                  pugi::xml_node copy) const {
    const pugi::xml_node mimic = only(joint, element, "mimic");
    if (!mimic) {
      return;
    }
    const std::string leader = document_.need(mimic, "joint");
    if (std::ranges::count(joint_names_, leader) == 0) {
      refuse(mimic, element, "a mimic of the unknown joint \"" + leader + "\"",
             "a joint of the robot", advise_name(leader, joint_names_));
    }
    pugi::xml_node target = copy.append_child("mimic");
    target.append_attribute("joint") = leader.c_str();
    copy_numbers(mimic, element, "multiplier", 1, target);
    copy_numbers(mimic, element, "offset", 1, target);
  }

  static constexpr const char* kBlanks = " \t\r\n";

  const XmlDocument& document_;
  UrdfElements result_;
  pugi::xml_document text_;
  pugi::xml_node robot_;  ///< The <robot> element of the text.
  std::set<std::string> materials_;
  std::set<std::string> undefined_materials_;
  int unnamed_materials_ = 0;
  std::vector<std::string> joint_names_;
  std::vector<std::string> link_names_;
  std::vector<std::string> second_origins_;  ///< The elements that have one, and where.
  std::vector<std::string> sizeless_;        ///< Links, once for each shape.
  std::vector<std::string> endless_;         ///< Joints.
  std::vector<std::string> endless_slides_;
};

}  // namespace

UrdfElements check_urdf_elements(const XmlDocument& document) {
  return ElementReader(document).read();
}

}  // namespace handway::geometric
