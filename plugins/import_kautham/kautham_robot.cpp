#include "kautham_robot.h"

#include "handway/geometric/io/number_text.h"
#include "handway/geometric/math/units.h"
#include "xml_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace handway::import_kautham {
namespace {

using geometric::kDegree;
using geometric::kMillimetre;

std::optional<int> find_joint(const KauthamRobot& robot, std::string_view name) {
  const auto found = std::ranges::find(robot.joints, name, &KauthamJoint::name);
  if (found == robot.joints.end()) {
    return std::nullopt;
  }
  return static_cast<int>(found - robot.joints.begin());
}

constexpr std::array<std::string_view, 6> kBaseNames = {"X", "Y", "Z", "X1", "X2", "X3"};

enum class Names {
  kOwn,        ///< "Elbow"
  kWithRobot,  ///< "TX90/Elbow"
};

/// Values that DOF elements set.
struct Factors {
  Eigen::VectorXd& joints;
  BaseParameters& base;
};

KauthamRobot& robot_of(const XmlFile& xml, pugi::xml_node dof, std::span<KauthamRobot> robots,
                       std::string_view robot) {
  const auto found = std::ranges::find(robots, robot, &KauthamRobot::name);
  if (found == robots.end()) {
    xml.refuse(dof, "name", in_quotes(robot), "the name of a robot of the problem, before a /");
  }
  return *found;
}

// The DOF elements of a control or of the offset.
template <typename Get>
void read_factors(const XmlFile& xml, pugi::xml_node node, std::span<KauthamRobot> robots,
                  Names names, const Get& factors_of) {
  xml.refuse_slips(node, {"DOF"});
  for (const pugi::xml_node dof : node.children("DOF")) {
    std::string name = xml.text(dof, "name");
    KauthamRobot* robot = &robots.front();
    if (names == Names::kWithRobot) {
      const std::size_t slash = name.rfind('/');
      if (slash == std::string::npos) {
        xml.refuse(dof, "name", in_quotes(name), "ROBOT/JOINT");
      }
      robot = &robot_of(xml, dof, robots, name.substr(0, slash));
      name.erase(0, slash + 1);
    }
    const Factors factors = factors_of(*robot);
    const double value = xml.number(dof, "value");
    const auto base = std::ranges::find(kBaseNames, name);
    if (const std::optional<int> joint = find_joint(*robot, name)) {
      factors.joints[*joint] = value;
    } else if (base != kBaseNames.end()) {
      factors.base[base - kBaseNames.begin()] = value;
    } else {
      xml.refuse(dof, "name", in_quotes(name),
                 "the name of a joint of the robot, or X, Y, Z, X1, X2, X3 of its base");
    }
  }
}

// Adds the control to every robot, with the joints that it moves there.
void add_control(const XmlFile& xml, pugi::xml_node node, std::span<KauthamRobot> robots,
                 Names names) {
  KauthamControl control;
  control.name = xml.text(node, "name");
  control.eig_value = xml.number_or(node, "eigValue", 1.0);
  if (control.eig_value < 0.0) {
    xml.refuse(node, "eigValue", "a negative number", "the side of an interval, 0 or more");
  }
  for (KauthamRobot& robot : robots) {
    control.factors = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size()));
    robot.controls.push_back(control);
  }
  read_factors(xml, node, robots, names, [](KauthamRobot& robot) {
    return Factors{robot.controls.back().factors, robot.controls.back().base};
  });
}

class RobotReader {
 public:
  explicit RobotReader(const std::filesystem::path& file) : xml_(file, "Robot") {
    robot_.file = file;
    const std::string_view name = geometric::trimmed(xml_.root().attribute("name").value());
    robot_.name = name.empty() ? file.stem().string() : std::string(name);
  }

  KauthamRobot read() {
    check_conventions();
    read_joints();
    robot_.offset = Eigen::VectorXd::Zero(joint_count());
    if (const pugi::xml_node set = xml_.root().child("ControlSet")) {
      read_controls(set);
    }
    robot_.warnings.insert(robot_.warnings.end(), xml_.notes().begin(), xml_.notes().end());
    return std::move(robot_);
  }

 private:
  [[nodiscard]] Eigen::Index joint_count() const {
    return static_cast<Eigen::Index>(robot_.joints.size());
  }

  void check_conventions() {
    const std::string_view type = geometric::trimmed(xml_.root().attribute("robType").value());
    is_free_ = type == "Freeflying";
    if (type != "Tree" && type != "Chain" && !is_free_) {
      xml_.refuse(xml_.root(), "robType", in_quotes(type), R"("Tree", "Chain" or "Freeflying")");
    }
    is_chain_ = type == "Chain";
    const std::string_view convention = geometric::trimmed(xml_.root().attribute("DHType").value());
    if (convention != "Modified" && !is_free_) {
      xml_.refuse(xml_.root(), "DHType", in_quotes(convention), "\"Modified\"",
                  "Rewrite the joints with modified Denavit-Hartenberg parameters");
    }
  }

  void read_joints() {
    const pugi::xml_node joints = xml_.root().child("Joints");
    const pugi::xml_node list = joints ? joints : xml_.root();
    xml_.refuse_slips(xml_.root(), {"Joints", "Joint", "ControlSet", "WeightSE3"});
    if (joints) {
      xml_.refuse_slips(list, {"Joint"});
    }
    for (const pugi::xml_node node : list.children("Joint")) {
      robot_.joints.push_back(read_joint(node));
    }
    if (robot_.joints.empty()) {
      xml_.refuse(list, "", "no <Joint> in it", "at least one");
    }
    warn_of_count(list, robot_.joints.size());
  }

  KauthamJoint read_joint(pugi::xml_node node) {
    xml_.refuse_slips(node, {"DHPars", "Description", "Limits", "Weight", "Parent", "PreTrans"});
    KauthamJoint joint;
    joint.name = xml_.text(node, "name");
    if (find_joint(robot_, joint.name)) {
      xml_.refuse(node, "name", "a second joint of this name", "different names");
    }
    joint.mesh = robot_.file.parent_path() / xml_.text(node, "ivFile");
    if (node.attribute("collision_ivFile")) {
      joint.collision_mesh = robot_.file.parent_path() / xml_.text(node, "collision_ivFile");
    }
    const bool is_root = robot_.joints.empty();
    if (const pugi::xml_node dh = is_root ? node.child("DHPars") : xml_.child(node, "DHPars")) {
      joint.alpha = xml_.number(dh, "alpha") * kDegree;
      joint.a = xml_.number(dh, "a") * kMillimetre;
      joint.theta = xml_.number(dh, "theta") * kDegree;
      joint.d = xml_.number(dh, "d") * kMillimetre;
    }
    const pugi::xml_node description = xml_.child(node, "Description");
    joint.rotational =
        (!is_root || description.attribute("rotational")) && xml_.flag(description, "rotational");
    joint.movable = xml_.flag(description, "movable");
    if (const pugi::xml_node limits = is_root ? node.child("Limits") : xml_.child(node, "Limits")) {
      const double unit = joint.rotational ? kDegree : kMillimetre;
      joint.lower = xml_.number(limits, "Low") * unit;
      joint.upper = xml_.number(limits, "Hi") * unit;
      if (joint.lower > joint.upper) {
        xml_.refuse(limits, "Low", "a lower limit above the upper one", "Low ≤ Hi", "Swap them");
      }
    }
    if (const pugi::xml_node before = node.child("PreTrans")) {
      joint.X_PreTrans = read_location(xml_, before);
    }
    joint.parent = read_parent(node);
    if (joint.parent < 0 && moves(joint)) {
      robot_.warnings.push_back("the first joint, " + joint.name +
                                ", carries the base and stands still");
    }
    return joint;
  }

  [[nodiscard]] int read_parent(pugi::xml_node node) const {
    const int above = static_cast<int>(robot_.joints.size()) - 1;
    const pugi::xml_node element = node.child("Parent");
    if (!element && (is_chain_ || above < 0)) {
      return above;
    }
    const std::string name(
        geometric::trimmed(xml_.child(node, "Parent").attribute("name").value()));
    if (above < 0) {
      if (!name.empty()) {
        xml_.refuse(element, "name", in_quotes(name), "nothing: the first joint is the root");
      }
      return -1;
    }
    const std::optional<int> parent = find_joint(robot_, name);
    if (!parent) {
      xml_.refuse(element, "name", in_quotes(name), "the name of a joint further up in the file",
                  "The joint right above is \"" + robot_.joints.back().name + "\"");
    }
    return *parent;
  }

  void read_controls(pugi::xml_node set) {
    xml_.refuse_slips(set, {"Offset", "Control"});
    robot_.has_controls = true;
    read_factors(xml_, xml_.child(set, "Offset"), {&robot_, 1}, Names::kOwn,
                 [](KauthamRobot& robot) {
                   return Factors{robot.offset, robot.base_offset};
                 });
    for (const pugi::xml_node node : set.children("Control")) {
      add_control(xml_, node, {&robot_, 1}, Names::kOwn);
    }
    warn_of_count(set, robot_.controls.size());
    if (set.attribute("nTrunk")) {
      read_trunk(set);
    }
  }

  void read_trunk(pugi::xml_node set) {
    const double count = xml_.number(set, "nTrunk");
    const auto most = static_cast<double>(robot_.controls.size());
    if (count != static_cast<int>(count) || count < 0.0 || count > most) {
      xml_.refuse(set, "nTrunk", xml_.text(set, "nTrunk"),
                  "a whole number from 0 to the number of controls, " +
                      std::to_string(robot_.controls.size()));
    }
    robot_.trunk_controls = static_cast<int>(count);
  }

  void warn_of_count(pugi::xml_node list, std::size_t found) {
    if (const pugi::xml_attribute size = list.attribute("size");
        size && geometric::parse_number(size.value()) != static_cast<double>(found)) {
      robot_.warnings.push_back(xml_.place(list) + ": " + list.name() + " says size " +
                                size.value() + " but has " + std::to_string(found));
    }
  }

  XmlFile xml_;
  KauthamRobot robot_;
  bool is_chain_ = false;
  bool is_free_ = false;
};

}  // namespace

KauthamRobot read_kautham_robot(const std::filesystem::path& file) {
  return RobotReader(file).read();
}

bool moves(const KauthamJoint& joint) { return joint.movable && joint.lower < joint.upper; }

Eigen::VectorXd joint_parameters(const KauthamRobot& robot, const Eigen::VectorXd& controls) {
  Eigen::VectorXd p = robot.offset;
  for (std::size_t j = 0; j < robot.controls.size(); ++j) {
    const KauthamControl& control = robot.controls[j];
    p += control.eig_value * (controls[static_cast<Eigen::Index>(j)] - 0.5) * control.factors;
  }
  return p.cwiseMax(0.0).cwiseMin(1.0);
}

void read_kautham_controls(const std::filesystem::path& file, std::span<KauthamRobot> robots) {
  const XmlFile xml(file, "ControlSet");
  xml.refuse_slips(xml.root(), {"Offset", "Control"});
  for (KauthamRobot& robot : robots) {
    robot.controls.clear();
    robot.trunk_controls = -1;
    robot.has_controls = true;
    robot.offset = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(robot.joints.size()), 0.5);
    robot.base_offset.setConstant(0.5);
  }
  read_factors(xml, xml.root().child("Offset"), robots, Names::kWithRobot, [](KauthamRobot& robot) {
    return Factors{robot.offset, robot.base_offset};
  });
  for (const pugi::xml_node node : xml.root().children("Control")) {
    add_control(xml, node, robots, Names::kWithRobot);
  }
}

void add_default_controls(std::span<KauthamRobot> robots,
                          std::span<const std::array<std::pair<double, double>, 3>> limits) {
  const auto add = [&](const std::string& name) {
    for (KauthamRobot& robot : robots) {
      robot.controls.push_back(
          {name, 1.0, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size()))});
    }
  };
  for (std::size_t r = 0; r < robots.size(); ++r) {
    KauthamRobot& robot = robots[r];
    robot.offset = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(robot.joints.size()), 0.5);
    robot.base_offset.setConstant(0.5);
    for (std::size_t i = 0; i < kBaseNames.size(); ++i) {
      if (i >= limits[r].size() || limits[r][i].first != limits[r][i].second) {
        add(robot.name + "/" + std::string(kBaseNames[i]));
        robot.controls.back().base[static_cast<Eigen::Index>(i)] = 1.0;
      }
    }
    for (std::size_t j = 1; j < robot.joints.size(); ++j) {
      if (moves(robot.joints[j])) {
        add(robot.name + "/" + robot.joints[j].name);
        robot.controls.back().factors[static_cast<Eigen::Index>(j)] = 1.0;
      }
    }
  }
}

std::array<bool, 6> moving_base(const KauthamRobot& robot) {
  std::array<bool, 6> moving{};
  for (const KauthamControl& control : robot.controls) {
    for (std::size_t i = 0; i < moving.size(); ++i) {
      moving[i] = moving[i] ||
                  (control.eig_value != 0.0 && control.base[static_cast<Eigen::Index>(i)] != 0.0);
    }
  }
  return moving;
}

BaseParameters base_parameters(const KauthamRobot& robot, const Eigen::VectorXd& controls) {
  BaseParameters p = robot.base_offset;
  for (std::size_t j = 0; j < robot.controls.size(); ++j) {
    const KauthamControl& control = robot.controls[j];
    p += control.eig_value * (controls[static_cast<Eigen::Index>(j)] - 0.5) * control.base;
  }
  return p.cwiseMax(0.0).cwiseMin(1.0);
}

Eigen::Quaterniond base_rotation(const BaseParameters& parameters) {
  const double first = 2.0 * std::numbers::pi * parameters[4];
  const double second = std::numbers::pi * parameters[5];
  const double r1 = std::sqrt(parameters[3]);
  const double r2 = std::sqrt(1.0 - parameters[3]);
  return {std::cos(second) * r2, std::sin(first) * r1, std::cos(first) * r1, std::sin(second) * r2};
}

double joint_value(const KauthamJoint& joint, double parameter) {
  return joint.lower + parameter * (joint.upper - joint.lower);
}

}  // namespace handway::import_kautham
