#include "kautham_robot.h"

#include "handway/geometric/io/number_text.h"
#include "handway/geometric/math/units.h"
#include "xml_file.h"

#include <algorithm>
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
    } else {
      robot_.warnings.push_back("no <ControlSet>: no control moves a joint");
    }
    return std::move(robot_);
  }

 private:
  [[nodiscard]] Eigen::Index joint_count() const {
    return static_cast<Eigen::Index>(robot_.joints.size());
  }

  void check_conventions() {
    const std::string_view convention = geometric::trimmed(xml_.root().attribute("DHType").value());
    if (convention != "Modified") {
      xml_.refuse(xml_.root(), "DHType", in_quotes(convention), "\"Modified\"",
                  "Rewrite the joints with modified Denavit-Hartenberg parameters");
    }
    const std::string_view type = geometric::trimmed(xml_.root().attribute("robType").value());
    if (type != "Tree" && type != "Chain") {
      xml_.refuse(xml_.root(), "robType", in_quotes(type), "\"Tree\" or \"Chain\"",
                  "A free-flying body has no joints: describe it as an object of the scene");
    }
    is_chain_ = type == "Chain";
  }

  void read_joints() {
    xml_.refuse_slips(xml_.root(), {"Joints", "ControlSet"});
    const pugi::xml_node list = xml_.child(xml_.root(), "Joints");
    xml_.refuse_slips(list, {"Joint"});
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
    const pugi::xml_node dh = xml_.child(node, "DHPars");
    joint.alpha = xml_.number(dh, "alpha") * kDegree;
    joint.a = xml_.number(dh, "a") * kMillimetre;
    joint.theta = xml_.number(dh, "theta") * kDegree;
    joint.d = xml_.number(dh, "d") * kMillimetre;
    const pugi::xml_node description = xml_.child(node, "Description");
    joint.rotational = xml_.flag(description, "rotational");
    joint.movable = xml_.flag(description, "movable");
    const pugi::xml_node limits = xml_.child(node, "Limits");
    const double unit = joint.rotational ? kDegree : kMillimetre;
    joint.lower = xml_.number(limits, "Low") * unit;
    joint.upper = xml_.number(limits, "Hi") * unit;
    if (joint.lower > joint.upper) {
      xml_.refuse(limits, "Low", "a lower limit above the upper one", "Low ≤ Hi", "Swap them");
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
    if (is_chain_ && !element) {
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
    robot_.offset = read_factors(xml_.child(set, "Offset"));
    for (const pugi::xml_node node : set.children("Control")) {
      KauthamControl control;
      control.name = xml_.text(node, "name");
      control.eig_value = xml_.number(node, "eigValue");
      if (control.eig_value < 0.0) {
        xml_.refuse(node, "eigValue", "a negative number", "the side of an interval, 0 or more");
      }
      control.factors = read_factors(node);
      robot_.controls.push_back(std::move(control));
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

  // The DOF elements of a control or of the offset; joints not named get 0.
  Eigen::VectorXd read_factors(pugi::xml_node node) const {
    xml_.refuse_slips(node, {"DOF"});
    Eigen::VectorXd factors = Eigen::VectorXd::Zero(joint_count());
    for (const pugi::xml_node dof : node.children("DOF")) {
      const std::string name = xml_.text(dof, "name");
      const std::optional<int> joint = find_joint(robot_, name);
      if (!joint) {
        xml_.refuse(dof, "name", in_quotes(name), "the name of a joint of this file",
                    "Controls that move the whole robot (X, Y, Z, X1, X2, X3) can't be imported");
      }
      factors[*joint] = xml_.number(dof, "value");
    }
    return factors;
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

double joint_value(const KauthamJoint& joint, double parameter) {
  return joint.lower + parameter * (joint.upper - joint.lower);
}

}  // namespace handway::import_kautham
