#include "scene_questions.h"

#include "handway/geometric/io/input_error.h"

#include <algorithm>
#include <iterator>
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

/// Answers to all rows, from a checker of one's own, without the interpreter's lock.
template <typename Value, typename Question>
std::vector<Value> ask_each(const SceneModel& scene, const Batch& batch, const Question& question) {
  const py::gil_scoped_release release;
  std::vector<Value> answers;
  answers.reserve(batch.rows.size());
  scene.checkers().lend([&](CollisionChecker& checker) {
    for (const Configuration& q : batch.rows) {
      answers.push_back(question(checker, q));
    }
  });
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
  constexpr double kTolerance = 1e-9;  // rad or m
  const Batch batch = configurations(scene, q);
  const geometric::RobotModel& robot = scene.robot();
  std::vector<char> answers;
  for (const Configuration& row : batch.rows) {
    answers.push_back(
        static_cast<char>(((robot.clamped(row) - row).array().abs() <= kTolerance).all()));
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

}  // namespace handway::python
