#include "arrays.h"
#include "bindings.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/grasps/grasp_list.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/timing/time_path.h"
#include "handway/planning/timing/timing_settings.h"
#include "handway/sampling/postures/principal_components.h"
#include "keyword_settings.h"
#include "planner_model.h"
#include "scene_model.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::InputError;
using planning::TimedPath;

/// Describes the settings of timing, in SI units.
std::vector<geometric::BoundParameter> keywords_of(planning::TimingSettings& settings) {
  return in_si_units(parameters_of(settings));
}

TimedPath time_path(const SceneModel& scene, const Array& array, const std::string& name,
                    const py::kwargs& keywords) {
  const planning::Path path{batch_from(array, scene.robot().variable_count(), "path").rows};
  planning::TimingSettings settings;
  set_from_keywords(keywords_of(settings), keywords);
  planning::TimingOptions options = timing_options(settings, scene.robot());
  TimedPath timed;
  run_interruptible([&](const std::stop_token& stop) {
    options.stop = stop;
    timed = planning::time_path(scene.problem(), path, planning::motion_name(name), options);
  });
  return timed;
}

py::array_t<double> rows(
    const TimedPath& timed,
    const std::function<Eigen::VectorXd(const planning::TrajectoryPoint&)>& of) {
  std::vector<Eigen::VectorXd> all;
  for (const planning::TrajectoryPoint& point : timed.motion.trajectory.points) {
    all.push_back(of(point));
  }
  return to_array(all, timed.motion.model->variable_count());
}

py::array_t<double> times(const TimedPath& timed) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(timed.motion.trajectory.points.size()));
  Eigen::Index i = 0;
  for (const planning::TrajectoryPoint& point : timed.motion.trajectory.points) {
    all[i++] = point.time;
  }
  return to_array(all);
}

std::vector<std::string> faults(const TimedPath& timed) {
  std::vector<std::string> texts;
  for (const planning::TrajectoryFault& fault : timed.preflight.faults) {
    texts.push_back(fault.text);
  }
  if (!timed.blends.path) {
    texts.push_back(timed.blends.fault);
  }
  return texts;
}

std::vector<std::string> export_motion(const TimedPath& timed, const std::string& format,
                                       const py::object& folder, bool any_robot) {
  if (!timed.cleared()) {
    throw InputError({"the motion", "", "a motion that is not cleared", "one without faults",
                      faults(timed).empty() ? "" : faults(timed).front()});
  }
  std::vector<std::string> files;
  planning::ExportOptions options;
  options.any_robot = any_robot;
  for (const std::filesystem::path& file : plugin_manager().exporter(format).write(
           timed.motion, file_name_from(folder, "folder"), options)) {
    files.push_back(file.string());
  }
  return files;
}

py::list contacts_of(const planning::Pregrasp& grasp) {
  py::list contacts;
  for (const planning::HandContact& contact : grasp.contacts) {
    py::dict answer;
    answer["finger"] = contact.finger;
    answer["link"] = contact.link;
    answer["point"] = to_array(contact.contact.p_O);
    answer["normal"] = to_array(contact.contact.normal_O);
    answer["distance"] = contact.distance;
    contacts.append(answer);
  }
  return contacts;
}

py::dict slip_of(const planning::HoldSlip& slip) {
  py::dict answer;
  answer["held"] = slip.held;
  answer["shift"] = slip.shift;
  answer["turn"] = slip.turn;
  return answer;
}

py::dict hold_of(const planning::HoldResult& result) {
  py::dict answer;
  py::list directions;
  for (const planning::HoldSlip& slip : result.directions) {
    directions.append(slip_of(slip));
  }
  answer["held"] = result.held();
  answer["squeeze"] = slip_of(result.squeeze);
  answer["directions"] = directions;
  answer["lift"] = slip_of(*result.lift);
  return answer;
}

planning::MakeHoldTest need_hold_test() {
  const planning::MakeHoldTest make = plugin_manager().hold_test_maker();
  if (make == nullptr) {
    throw InputError({"test", "", "no plugin that simulates grasps", "simulate_mujoco",
                      "Build Handway with libmujoco-dev"});
  }
  return make;
}

/// Describes the settings of search and simulation but the number of grasps, which is `most`.
std::vector<geometric::BoundParameter> keywords_of(planning::GraspRequest& request) {
  std::vector<geometric::BoundParameter> keywords = parameters_of(request.search);
  std::erase_if(keywords, [](const auto& keyword) { return keyword.key == "count"; });
  std::ranges::move(parameters_of(request.hold), std::back_inserter(keywords));
  return keywords;
}

py::list grasps(const SceneModel& scene, const std::string& object, int most, std::uint64_t seed,
                std::optional<int> test, const std::optional<std::filesystem::path>& given,
                const py::kwargs& settings) {
  if (most < 1) {
    throw InputError({"most", "", std::to_string(most), "1 or more", ""});
  }
  if (test.value_or(0) < 0) {
    throw InputError({"test", "", std::to_string(*test), "0 or more", ""});
  }
  planning::GraspRequest request;
  set_from_text(find_parameter(parameters_of(request.search), "count"), std::to_string(most));
  set_from_keywords(keywords_of(request), settings);
  request.search.seed = seed;
  request.holding = test;
  request.from = given.value_or(std::filesystem::path());
  const planning::MakeHoldTest make_hold_test =
      test.value_or(0) > 0 ? need_hold_test() : plugin_manager().hold_test_maker();
  planning::GraspList list;
  run_interruptible([&](const std::stop_token& stop) {
    list = planning::list_grasps(scene.problem(), object, request, make_hold_test, stop);
  });
  for (const std::string& sentence : list.left_out) {
    warn(sentence);
  }
  py::list answers;
  for (const auto& [grasp, hold] : list.grasps) {
    py::dict answer;
    answer["q"] = to_array(grasp.q);
    answer["score"] = grasp.score;
    answer["fingers"] = grasp.fingers;
    answer["enclosure"] = grasp.enclosure;
    answer["clearance"] = grasp.clearance;
    answer["closed"] = to_array(grasp.closed);
    answer["squeezed"] = to_array(grasp.squeezed);
    answer["epsilon"] = grasp.quality.epsilon;
    answer["volume"] = grasp.quality.volume;
    answer["holding_force"] = grasp.holding_force;
    answer["doubt"] = grasp.doubt;
    answer["source"] = grasp.source;
    answer["contacts"] = contacts_of(grasp);
    answer["hold"] = hold ? py::object(hold_of(*hold)) : py::none();
    answers.append(answer);
  }
  return answers;
}

std::shared_ptr<sampling::PmdBasis> find_pmds(const Array& postures,
                                              const std::vector<std::string>& joints,
                                              const std::vector<std::string>& free, int directions,
                                              const std::string& hand) {
  const auto width = static_cast<Eigen::Index>(joints.size());
  const Batch batch = batch_from(postures, width, "postures");
  Eigen::MatrixXd samples(static_cast<Eigen::Index>(batch.rows.size()), width);
  for (std::size_t i = 0; i < batch.rows.size(); ++i) {
    samples.row(static_cast<Eigen::Index>(i)) = batch.rows[i].transpose();
  }
  sampling::PmdBasisOptions options;
  options.directions = directions;
  for (const std::string& name : free) {
    const auto joint = std::ranges::find(joints, name);
    if (joint == joints.end()) {
      throw InputError({"free", "", "\"" + name + "\"", "one of the joints",
                        geometric::advise_name(name, joints)});
    }
    options.free_joints.push_back(static_cast<int>(joint - joints.begin()));
  }
  const sampling::PrincipalComponents components =
      sampling::principal_components(samples, options.free_joints);
  return std::make_shared<sampling::PmdBasis>(
      sampling::make_pmd_basis(hand, "Python", joints, components, options));
}

}  // namespace

void bind_motion(py::module_& module) {
  py::class_<TimedPath> motion(module, "Motion", "A path with times, checked before it may run.");
  motion.def_property_readonly("cleared", &TimedPath::cleared, "True if it may run.")
      .def_property_readonly("faults", &faults,
                             "Reasons why it may not run, a sentence each; empty if it is cleared.")
      .def_property_readonly(
          "duration", [](const TimedPath& t) { return t.preflight.duration; }, "Duration, s.")
      .def_property_readonly(
          "min_clearance_mm",
          [](const TimedPath& t) { return geometric::millimetres(t.preflight.min_clearance); },
          "Smallest clearance, mm; 50 means 50 or more.")
      .def_property_readonly(
          "warning",
          [](const TimedPath& t) -> std::optional<std::string> {
            if (!t.cleared() || !t.preflight.is_tight()) {
              return std::nullopt;
            }
            return to_string(*t.preflight.shortfall) + ". " + t.preflight.advice();
          },
          "Place of the largest shortfall in clearance, compared with the following errors, and\n"
          "advice; None if the clearance suffices everywhere.")
      .def_property_readonly(
          "assumed_limits",
          [](const TimedPath& t) {
            std::vector<std::string> joints;
            for (const planning::AssumedLimit& limit : t.preflight.assumed) {
              joints.push_back(limit.joint);
            }
            return joints;
          },
          "Names of the joints with an assumed limit, because no file gives it.")
      .def_property_readonly("times", &times, "Times of the points, [points], s.")
      .def_property_readonly(
          "positions",
          [](const TimedPath& t) { return rows(t, [](const auto& p) { return p.position; }); },
          "Positions at the points, [points, variables], rad or m.")
      .def_property_readonly(
          "velocities",
          [](const TimedPath& t) { return rows(t, [](const auto& p) { return p.velocity; }); },
          "Velocities at the points, [points, variables], rad/s or m/s.")
      .def_property_readonly(
          "accelerations",
          [](const TimedPath& t) { return rows(t, [](const auto& p) { return p.acceleration; }); },
          "Accelerations at the points, [points, variables], rad/s² or m/s².")
      .def("export", &export_motion, py::arg("format"), py::arg("folder"), py::kw_only(),
           py::arg("any_robot") = false,
           "Writes the motion for a controller.\n\n"
           "format: csv, split, val3, ros, moveit, or a plugin's. folder: created if it does not\n"
           "exist. any_robot: export even if the format does not seem to suit the robot.\n"
           "Returns the files. Raises InputError if the motion is not cleared.")
      .def("__repr__", [](const TimedPath& t) {
        return "<handway.Motion of " + std::to_string(t.preflight.duration) + " s, " +
               (t.cleared() ? "cleared>" : "not cleared>");
      });
  planning::TimingSettings timing;
  planning::GraspRequest request;
  auto scene = py::reinterpret_borrow<py::class_<SceneModel>>(module.attr("Scene"));
  scene
      .def("time", &time_path, py::arg("path"), py::kw_only(), py::arg("name") = "path",
           ("Returns the fastest motion along a path within the robot's limits.\n\n"
            "path: [waypoints, variables], rad or m. name: name of exported files.\n" +
            keywords_text(keywords_of(timing)))
               .c_str())
      .def("grasps", &grasps, py::arg("object"), py::kw_only(), py::arg("most") = 8,
           py::arg("seed") = 1, py::arg("test") = std::nullopt, py::arg("given") = std::nullopt,
           ("Returns grasps of an object, the best first.\n\n"
            "object: name of a fixed object. most: largest number of grasps of a search. seed: "
            "seed\n"
            "of the samples. test: simulate until so many hold, and rank these first; None: as\n"
            "most, where MuJoCo is installed; 0: simulate none. given: file of grasps (YAML or\n"
            "JSON) to measure instead of a search.\n" +
            keywords_text(keywords_of(request)) +
            "\nReturns dicts: q, closed and squeezed\n"
            "[variables], the configurations before contact, in contact and pushing; score;\n"
            "epsilon (N) and volume of the grasp wrench space; holding_force (N, the largest\n"
            "contact force that holds the payload, or None); contacts, dicts with finger, link,\n"
            "point and normal (in the object's frame) and distance (m); doubt, a reason to\n"
            "distrust it, or empty; source, where a given grasp is in its file; fingers,\n"
            "enclosure, clearance (m); hold, None or a dict of the simulation: held (in all six\n"
            "directions), squeeze, directions and lift, each with held, shift (m) and turn (rad).")
               .c_str());
  module.def(
      "find_pmds", &find_pmds, py::arg("postures"), py::arg("joints"), py::kw_only(),
      py::arg("free") = std::vector<std::string>(), py::arg("directions") = 4, py::arg("hand") = "",
      "Returns the principal motion directions of hand postures, as a Basis.\n\n"
      "postures: [n, joints], each joint from 0 to 1 between its limits. joints: their names.\n"
      "free: joints that are no part of the directions. directions: their largest number.\n"
      "hand: name of the hand.");
}

}  // namespace handway::python
