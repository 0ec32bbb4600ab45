#include "scene_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/jacobian.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/robot/robot_state.h"

#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::Configuration;
using geometric::InputError;
using geometric::Pose;
using geometric::PoseGoal;

using RowMajorPose = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

py::array_t<double> pose_array(const Pose& X) {
  const RowMajorPose matrix = X.matrix();
  return py::array_t<double>({4, 4}, matrix.data());
}

// One number for all axes, or three.
Eigen::Vector3d tolerance_from(const Array& array, const std::string& argument) {
  const Eigen::Vector3d tolerance = array.ndim() == 0
                                        ? Eigen::Vector3d::Constant(*array.data()).eval()
                                        : Eigen::Vector3d(vector_from(array, 3, argument));
  if (!(tolerance.array() >= 0.0).all()) {
    throw InputError({argument, "", "a number below 0", "0 or more, one number or three", ""});
  }
  return tolerance;
}

PoseGoal make_goal(const std::string& link, const Array& X_WG, const std::optional<Array>& tool,
                   const std::optional<Array>& position, const std::optional<Array>& rotation) {
  PoseGoal goal;
  goal.link = link;
  goal.X_WG = pose_from(X_WG, "X_WG");
  goal.X_LT = tool ? pose_from(*tool, "X_LT") : Pose::Identity();
  if (position) {
    goal.position_tolerance = tolerance_from(*position, "position_tolerance");
  }
  if (rotation) {
    goal.rotation_tolerance = tolerance_from(*rotation, "rotation_tolerance");
  }
  return goal;
}

Eigen::MatrixXd jacobian_at(const SceneModel& scene, int link, const Configuration& q) {
  const geometric::RobotInstance& robot = scene.scene().robots.front();
  geometric::RobotState state(robot.model, robot.X_WB);
  state.set_configuration(q);
  return point_jacobian(state, link);
}

}  // namespace

geometric::Pose pose_from(const Array& array, const std::string& argument) {
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
    throw InputError({argument, "", "another shape", "a pose [4, 4]", ""});
  }
  geometric::Pose X = geometric::Pose::Identity();
  X.matrix() = Eigen::Map<const RowMajorPose>(array.data());
  const Eigen::Matrix3d R = X.linear();
  constexpr double kTolerance = 1e-6;
  const bool is_rigid = X.matrix().allFinite() && (R * R.transpose()).isIdentity(kTolerance) &&
                        R.determinant() > 0.0 &&
                        X.matrix().row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1));
  if (!is_rigid) {
    throw InputError({argument, "", "no rigid transform",
                      "finite numbers, a rotation, and [0, 0, 0, 1] below", ""});
  }
  return X;
}

py::array_t<double> inverse_kinematics(const SceneModel& scene, const std::string& link,
                                       const Array& X_WL, const std::optional<Array>& near,
                                       int most, bool free) {
  if (most < 1) {
    throw InputError({"most", "", std::to_string(most), "1 or more", ""});
  }
  const geometric::RobotInstance& robot = scene.scene().robots.front();
  static_cast<void>(needed_link(*robot.model, link));
  const Pose X_BL = robot.X_WB.inverse() * pose_from(X_WL, "X_WL");
  const int variables = robot.model->variable_count();
  const Configuration reference =
      near ? vector_from(*near, variables, "near") : robot.configuration;
  geometric::NumericIkOptions options;
  options.stay_near = true;
  const geometric::NumericInverseKinematics ik(robot.model, link, {}, options);
  std::vector<Configuration> found;
  {
    const py::gil_scoped_release release;
    scene.checkers().lend([&](geometric::CollisionChecker& checker) {
      found = ik.find_several(X_BL, reference, most, [&](const Configuration& q) {
        return !free || !checker.first_collision(q);
      });
    });
  }
  return to_array(found, variables);
}

py::array_t<double> jacobian(const SceneModel& scene, const std::string& link, const Array& q) {
  const int index = needed_link(scene.robot(), link);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J =
      jacobian_at(scene, index, vector_from(q, scene.robot().variable_count(), "q"));
  return py::array_t<double>({J.rows(), J.cols()}, J.data());
}

py::object manipulability(const SceneModel& scene, const std::string& link, const Array& q) {
  const int index = needed_link(scene.robot(), link);
  const Batch batch = batch_from(q, scene.robot().variable_count(), "q");
  std::vector<double> answers;
  for (const Configuration& row : batch.rows) {
    answers.push_back(geometric::manipulability(jacobian_at(scene, index, row).topRows(3)));
  }
  return to_answer(batch, answers);
}

std::vector<PoseGoal> goal_poses_from(const py::object& goals) {
  if (goals.is_none()) {
    return {};
  }
  if (py::isinstance<PoseGoal>(goals)) {
    return {goals.cast<PoseGoal>()};
  }
  std::vector<PoseGoal> list;
  for (const py::handle& goal : goals) {
    list.push_back(goal.cast<PoseGoal>());
  }
  if (list.empty()) {
    throw InputError({"goal_pose", "", "an empty list", "at least one PoseGoal", ""});
  }
  return list;
}

void bind_pose_goal(py::module_& module) {
  py::class_<PoseGoal>(module, "PoseGoal",
                       "A goal as a pose: the tool frame T, fixed to a link L, is brought to G.")
      .def(
          py::init(&make_goal), py::arg("link"), py::arg("X_WG"), py::kw_only(),
          py::arg("X_LT") = py::none(), py::arg("position_tolerance") = py::none(),
          py::arg("rotation_tolerance") = py::none(),
          "link: of the scene's robot. X_WG: where the tool frame has to be in the world, [4, 4].\n"
          "X_LT: the tool frame in the link's, [4, 4]; the link's own if None.\n"
          "position_tolerance: along G's axes, m, one number or three; 0.1 mm if None.\n"
          "rotation_tolerance: of the rotation vector from G to T about G's axes, rad, one number\n"
          "or three; pi: that axis is free. 0.1 degrees if None.")
      .def_readonly("link", &PoseGoal::link, "Name of the link.")
      .def_property_readonly(
          "X_WG", [](const PoseGoal& goal) { return pose_array(goal.X_WG); },
          "Where the tool frame has to be in the world, [4, 4].")
      .def_property_readonly(
          "X_LT", [](const PoseGoal& goal) { return pose_array(goal.X_LT); },
          "The tool frame in the link's, [4, 4].")
      .def_property_readonly(
          "position_tolerance",
          [](const PoseGoal& goal) { return to_array(Eigen::VectorXd(goal.position_tolerance)); },
          "Along the axes of G, [3], m.")
      .def_property_readonly(
          "rotation_tolerance",
          [](const PoseGoal& goal) { return to_array(Eigen::VectorXd(goal.rotation_tolerance)); },
          "About the axes of G, [3], rad.");
}

}  // namespace handway::python
