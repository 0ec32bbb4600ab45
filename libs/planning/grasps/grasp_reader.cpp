#include "grasps/grasping_hand.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/grasps/given_grasps.h"

#include <Eigen/Geometry>

#include <cmath>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::YamlElement;

constexpr double kRotationTolerance = 1e-3;  // of numbers that others round

// `{xyz: […], rpy: […]}` of Handway's grasp files, m and degrees.
Pose pose_of_map(const YamlElement& element) {
  element.allow_keys({"xyz", "rpy"});
  const Vector3d p = element.need("xyz").numbers(3);
  const Vector3d rpy = element.numbers_or("rpy", Vector3d::Zero());
  return geometric::pose_from_rpy(p, geometric::radians(rpy.x()), geometric::radians(rpy.y()),
                                  geometric::radians(rpy.z()));
}

Pose pose_of_rows(const YamlElement& element) {
  Eigen::Matrix4d X;
  for (int row = 0; row < 4; ++row) {
    X.row(row) = element.items()[static_cast<std::size_t>(row)].numbers(4).transpose();
  }
  const Eigen::Matrix3d R = X.topLeftCorner<3, 3>();
  const bool is_rigid = (R.transpose() * R).isIdentity(kRotationTolerance) &&
                        R.determinant() > 0.0 &&
                        X.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kRotationTolerance);
  if (!is_rigid) {
    element.refuse("a matrix that is no rotation and translation",
                   "rows of a rigid transform, the last of them [0, 0, 0, 1]");
  }
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  pose.translation() = X.topRightCorner<3, 1>();
  return pose;
}

Pose pose_of_numbers(const YamlElement& element) {
  const Eigen::VectorXd numbers = element.numbers(7);
  const Eigen::Quaterniond rotation(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(rotation.norm() - 1.0) > kRotationTolerance) {
    element.refuse("a quaternion whose length is not 1",
                   "[x, y, z, qx, qy, qz, qw] with a unit quaternion");
  }
  return Eigen::Translation3d(numbers.head<3>()) * rotation.normalized();
}

Pose pose_of(const YamlElement& element) {
  if (element.is_map()) {
    return pose_of_map(element);
  }
  if (element.is_list() && element.items().size() == 4) {
    return pose_of_rows(element);
  }
  if (element.is_list() && element.items().size() == 7) {
    return pose_of_numbers(element);
  }
  element.refuse(element.found(),
                 "[x, y, z, qx, qy, qz, qw], four rows of a matrix, or xyz and rpy");
}

Configuration with_joints(const YamlElement& element, const geometric::RobotModel& model,
                          Configuration q) {
  for (const auto& [name, value] : element.entries()) {
    const std::optional<int> variable = model.find_variable(name);
    if (!variable) {
      std::vector<std::string> names;
      names.reserve(static_cast<std::size_t>(model.variable_count()));
      for (int v = 0; v < model.variable_count(); ++v) {
        names.push_back(model.variable(v).name);
      }
      value.refuse("joint \"" + name + "\"", "a joint of " + model.name() + " that moves by itself",
                   geometric::advise_name(name, names));
    }
    q[*variable] = value.number();
  }
  return q;
}

YamlElement need_one_of(const YamlElement& element, const char* name, const char* other) {
  const std::optional<YamlElement> found = element.find(name);
  return found ? *found : element.need(other);
}

// Pose of the palm in that of a link.
Pose palm_in_link(const geometric::RobotModel& model, int palm, int link, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(link)].inverse() * X_BL[static_cast<std::size_t>(palm)];
}

int link_of(const std::optional<YamlElement>& element, const geometric::RobotModel& model,
            int palm) {
  if (!element) {
    return palm;
  }
  const std::optional<int> link = model.find_link(element->text());
  if (!link) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(model.link_count()));
    for (int i = 0; i < model.link_count(); ++i) {
      names.push_back(model.link(i).name);
    }
    element->refuse("link \"" + element->text() + "\"", "a link of " + model.name(),
                    geometric::advise_name(element->text(), names));
  }
  return *link;
}

}  // namespace

std::vector<GivenGrasp> read_given_grasps(const std::filesystem::path& file,
                                          const PlanningProblem& problem, std::string_view object) {
  const geometric::RobotModel& model = problem.model();
  const PlanningProblem of_hand = with_nearest_hand(problem, graspable_object(problem, object));
  const YamlElement top = YamlElement::read(file, "a file of grasps");
  const std::vector<YamlElement> items = top.is_list() ? top.items() : top.need("grasps").items();
  const int palm = of_hand.hand.palm;
  const std::optional<YamlElement> own_palm = top.is_map() ? top.find("palm") : std::nullopt;
  const std::optional<YamlElement> named = top.is_map() ? top.find("link") : std::nullopt;
  const int link = link_of(named ? named : own_palm, model, palm);
  std::vector<GivenGrasp> grasps;
  for (const YamlElement& item : items) {
    GivenGrasp grasp{item.where(), pose_of(need_one_of(item, "pose", "palm_in_object")),
                     with_joints(need_one_of(item, "joints", "grasp"), model, problem.start)};
    grasp.X_OP = grasp.X_OP * palm_in_link(model, palm, link, grasp.q);
    grasps.push_back(std::move(grasp));
  }
  if (grasps.empty()) {
    top.refuse("no grasps", "one or more");
  }
  return grasps;
}

}  // namespace handway::planning
