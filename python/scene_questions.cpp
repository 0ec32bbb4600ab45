#include "scene_questions.h"

#include "bindings.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/jacobian.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/robot/robot_state.h"

#include <algorithm>
#include <iterator>
#include <stop_token>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::CollisionChecker;
using geometric::Configuration;
using geometric::InputError;
using geometric::NamedPair;

Batch configurations(const SceneModel& scene, const Array& q) {
  return batch_from(q, scene.robot().variable_count(), "q");
}

constexpr std::size_t kFewRows = 200;  // answered too fast for Ctrl+C

/// Answers to all rows, from a separate checker, without the interpreter's lock. Many rows can be
/// interrupted.
template <typename Value, typename Question>
std::vector<Value> ask_each(const SceneModel& scene, const Batch& batch, const Question& question) {
  std::vector<Value> answers;
  answers.reserve(batch.rows.size());
  const auto ask = [&](const std::stop_token& stop) {
    scene.checkers().lend([&](CollisionChecker& checker) {
      for (const Configuration& q : batch.rows) {
        geometric::end_if_stopped(stop);
        answers.push_back(question(checker, q));
      }
    });
  };
  if (batch.rows.size() > kFewRows) {
    run_interruptible(ask);
  } else {
    const py::gil_scoped_release release;
    ask({});
  }
  return answers;
}

py::object truths(const Batch& batch, const std::vector<char>& values) {
  if (batch.is_single) {
    return py::bool_(values.front() != 0);
  }
  py::array_t<bool> array(static_cast<py::ssize_t>(values.size()));
  std::ranges::transform(values, array.mutable_data(), [](char value) { return value != 0; });
  return array;
}

}  // namespace

py::object collides(const SceneModel& scene, const Array& q) {
  const Batch batch = configurations(scene, q);
  return truths(batch, ask_each<char>(scene, batch, [](CollisionChecker& checker, const auto& row) {
                  return static_cast<char>(checker.first_collision(row).has_value());
                }));
}

py::object clearance(const SceneModel& scene, const Array& q, double enough) {
  if (!(enough > 0.0)) {
    throw InputError({"enough", "", std::to_string(enough), "a distance above 0 m", ""});
  }
  const Batch batch = configurations(scene, q);
  return to_answer(batch, ask_each<double>(scene, batch, [&](auto& checker, const auto& row) {
                     return std::min(enough, find_clearance(checker, row, enough).distance);
                   }));
}

py::object within_limits(const SceneModel& scene, const Array& q) {
  const Batch batch = configurations(scene, q);
  const geometric::RobotModel& robot = scene.robot();
  std::vector<char> answers;
  for (const Configuration& row : batch.rows) {
    answers.push_back(static_cast<char>(limit_violations(robot, row).empty()));
  }
  return truths(batch, answers);
}

py::array_t<double> link_pose(const SceneModel& scene, const std::string& link, const Array& q) {
  const geometric::RobotModel& robot = scene.robot();
  const auto index = static_cast<std::size_t>(needed_link(robot, link));
  const Batch batch = configurations(scene, q);
  const geometric::Pose& X_WB = scene.scene().robots.front().X_WB;
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.link_count()));
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(batch.rows.size()), 4, 4};
  if (batch.is_single) {
    shape.erase(shape.begin());
  }
  py::array_t<double> poses(shape);
  double* out = poses.mutable_data();
  for (const Configuration& row : batch.rows) {
    robot.forward_kinematics(row, X_BL);
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> X_WL = (X_WB * X_BL[index]).matrix();
    out = std::copy_n(X_WL.data(), X_WL.size(), out);
  }
  return poses;
}

py::list collisions(const SceneModel& scene, const Array& q) {
  const Configuration row = vector_from(q, scene.robot().variable_count(), "q");
  std::vector<NamedPair> pairs;
  {
    const py::gil_scoped_release release;
    scene.checkers().lend(
        [&](CollisionChecker& checker) { pairs = find_collisions(checker, row); });
  }
  py::list names;
  for (const NamedPair& pair : pairs) {
    names.append(py::make_tuple(pair.a, pair.b));
  }
  return names;
}

py::list violations(const SceneModel& scene, const Array& q) {
  const Configuration row = vector_from(q, scene.robot().variable_count(), "q");
  std::vector<std::string> violated;
  {
    const py::gil_scoped_release release;
    scene.checkers().lend(
        [&](CollisionChecker& checker) { violated = violated_constraints(checker, row); });
  }
  py::list texts;
  for (const std::string& text : violated) {
    texts.append(text);
  }
  return texts;
}

py::tuple closest_pair(const SceneModel& scene, const Array& q) {
  const Configuration row = vector_from(q, scene.robot().variable_count(), "q");
  NamedPair pair;
  {
    const py::gil_scoped_release release;
    scene.checkers().lend([&](CollisionChecker& checker) { pair = find_clearance(checker, row); });
  }
  return py::make_tuple(pair.a, pair.b, pair.distance);
}

namespace {

using geometric::Pose;
using geometric::PoseGoal;

using RowMajorPose = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

// Reads one number for all axes, or three.
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

py::array_t<double> pose_array(const Pose& X) {
  const RowMajorPose matrix = X.matrix();
  return py::array_t<double>({4, 4}, matrix.data());
}

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
                       "Goal as a pose: the tool frame T, fixed to a link L, is brought to G.")
      .def(py::init(&make_goal), py::arg("link"), py::arg("X_WG"), py::kw_only(),
           py::arg("X_LT") = py::none(), py::arg("position_tolerance") = py::none(),
           py::arg("rotation_tolerance") = py::none(),
           "Describes the target pose of a link's tool frame.\n\n"
           "link: a link of the scene's robot. X_WG: target pose of the tool frame in the world,\n"
           "[4, 4].\n"
           "X_LT: pose of the tool frame in the link, [4, 4]; the link's frame if None.\n"
           "position_tolerance: along G's axes, m, one number or three; 0.1 mm if None.\n"
           "rotation_tolerance: limit of the rotation vector from G to T about G's axes, rad, one\n"
           "number or three; pi: that axis is free. 0.1 degrees if None.")
      .def_readonly("link", &PoseGoal::link, "Name of the link.")
      .def_property_readonly(
          "X_WG", [](const PoseGoal& goal) { return pose_array(goal.X_WG); },
          "Target pose of the tool frame in the world, [4, 4].")
      .def_property_readonly(
          "X_LT", [](const PoseGoal& goal) { return pose_array(goal.X_LT); },
          "Pose of the tool frame in the link, [4, 4].")
      .def_property_readonly(
          "position_tolerance",
          [](const PoseGoal& goal) { return to_array(Eigen::VectorXd(goal.position_tolerance)); },
          "Tolerance of the position along the axes of G, [3], m.")
      .def_property_readonly(
          "rotation_tolerance",
          [](const PoseGoal& goal) { return to_array(Eigen::VectorXd(goal.rotation_tolerance)); },
          "Tolerance of the rotation about the axes of G, [3], rad.");
}

}  // namespace handway::python
