#include "modified_dh.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::test {
namespace {

constexpr double kDegree = M_PI / 180.0;

double value(pugi::xml_node node, const char* name) { return node.attribute(name).as_double(); }

Eigen::Isometry3d turn_and_shift(pugi::xml_node node) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axis(value(node, "WX"), value(node, "WY"), value(node, "WZ"));
  X.translation() << value(node, "X"), value(node, "Y"), value(node, "Z");
  if (axis.norm() > 0.0) {
    X.linear() =
        Eigen::AngleAxisd(value(node, "TH") * kDegree, axis.normalized()).toRotationMatrix();
  }
  return X;
}

// Craig's matrix of the modified convention, written out.
Eigen::Isometry3d craig(const ModifiedDhRobot::Row& row, double q) {
  const double alpha = row.alpha * kDegree;
  const double theta = row.theta * kDegree + q;
  const double ca = std::cos(alpha);
  const double sa = std::sin(alpha);
  const double ct = std::cos(theta);
  const double st = std::sin(theta);
  Eigen::Isometry3d X;
  X.matrix() << ct, -st, 0, row.a,         //
      st * ca, ct * ca, -sa, -sa * row.d,  //
      st * sa, ct * sa, ca, ca * row.d,    //
      0, 0, 0, 1;
  return X;
}

}  // namespace

ModifiedDhRobot::ModifiedDhRobot(const std::filesystem::path& file) {
  pugi::xml_document document;
  if (!document.load_file(file.c_str())) {
    throw std::runtime_error("cannot read " + file.string());
  }
  const pugi::xml_node robot = document.child("Robot");
  for (const pugi::xml_node joint : robot.child("Joints").children("Joint")) {
    const pugi::xml_node dh = joint.child("DHPars");
    rows_.push_back({joint.attribute("name").value(),
                     joint.child("Parent").attribute("name").value(), value(dh, "alpha"),
                     value(dh, "a"), value(dh, "theta"), value(dh, "d"),
                     value(joint.child("Limits"), "Low"), value(joint.child("Limits"), "Hi"),
                     turn_and_shift(joint.child("PreTrans"))});
  }
  const pugi::xml_node set = robot.child("ControlSet");
  for (const pugi::xml_node dof : set.child("Offset").children()) {
    offset_[dof.attribute("name").value()] = value(dof, "value");
  }
  for (const pugi::xml_node control : set.children("Control")) {
    auto& factors = controls_.emplace_back();
    for (const pugi::xml_node dof : control.children()) {
      factors[dof.attribute("name").value()] = value(control, "eigValue") * value(dof, "value");
    }
  }
}

std::map<std::string, Eigen::Isometry3d> ModifiedDhRobot::poses(
    const std::map<std::string, double>& q) const {
  std::map<std::string, Eigen::Isometry3d> result;
  for (const Row& row : rows_) {
    const auto angle = q.find(row.name);
    const Eigen::Isometry3d parent =
        row.parent.empty() ? Eigen::Isometry3d::Identity() : result.at(row.parent);
    result[row.name] = parent * row.before * craig(row, angle == q.end() ? 0.0 : angle->second);
  }
  return result;
}

std::map<std::string, double> ModifiedDhRobot::values(const std::vector<double>& controls) const {
  std::map<std::string, double> result;
  for (const Row& row : rows_) {
    const auto offset = offset_.find(row.name);
    double p = offset == offset_.end() ? 0.0 : offset->second;
    for (std::size_t c = 0; c < controls_.size(); ++c) {
      if (const auto factor = controls_[c].find(row.name); factor != controls_[c].end()) {
        p += factor->second * (controls.at(c) - 0.5);
      }
    }
    result[row.name] = kDegree * (row.low + std::clamp(p, 0.0, 1.0) * (row.high - row.low));
  }
  return result;
}

}  // namespace handway::test
