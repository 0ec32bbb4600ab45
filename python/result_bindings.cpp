#include "arrays.h"
#include "bindings.h"
#include "handway/planning/paths/path_check.h"
#include "planner_model.h"

#include <pybind11/stl.h>

#include <string>

namespace py = pybind11;

namespace handway::python {
namespace {

using planning::Certificate;
using planning::PathCheckResult;
using planning::PlanStatistics;

py::dict statistics_of(const PlanOutcome& outcome) {
  const PlanStatistics& statistics = outcome.result.statistics;
  py::dict checks;
  checks["nodes"] = statistics.node_checks;
  checks["edges"] = statistics.edge_checks;
  checks["edges_tested"] = statistics.edges_tested;
  py::dict rejections;
  for (const auto& [pair, count] : statistics.rejections) {
    rejections[py::make_tuple(pair.first, pair.second)] = count;
  }
  py::dict all;
  all["samples"] = statistics.samples;
  all["nodes"] = statistics.nodes;
  all["edges"] = statistics.edges;
  all["passes"] = statistics.passes;
  all["max_trials"] = statistics.max_trials;
  all["final_rho_a"] = statistics.final_rho_a;
  all["nodes_per_pmds"] = statistics.nodes_per_pmds;
  all["checks"] = checks;
  all["sampling_s"] = statistics.sampling_s;
  all["connection_s"] = statistics.connection_s;
  all["rejections"] = rejections;
  all["rejections_per_tenth"] = statistics.rejections_per_tenth;
  return all;
}

std::string text_of(const PlanOutcome& outcome) {
  return "<handway.Result of " + outcome.planner + ": " + to_string(outcome.result.status) + ", " +
         std::to_string(outcome.result.path.waypoints.size()) + " waypoints>";
}

void bind_certificate(py::module_& module) {
  py::class_<Certificate>(module, "Certificate",
                          "What holds for every configuration on a path, in every checked pair.")
      .def_readonly("resolution_mm", &Certificate::resolution_mm,
                    "Along edges, pairs that move keep at least this, mm.")
      .def_readonly("resolution_at_start_mm", &Certificate::resolution_at_start_mm,
                    "The same next to the start, mm; less if the start itself has less than twice.")
      .def_readonly("resolution_at_goal_mm", &Certificate::resolution_at_goal_mm,
                    "The same next to the goal, mm.")
      .def_readonly("min_clearance_mm", &Certificate::min_clearance_mm,
                    "A lower bound over the whole path, mm; at most a fifth too low, and not more\n"
                    "than 50 mm.")
      .def_readonly("checks", &Certificate::checks, "Configurations looked at.");
}

void bind_result(py::module_& module) {
  py::class_<PlanOutcome>(module, "Result", "What a planner found, and what it did.")
      .def_property_readonly(
          "solved", [](const PlanOutcome& outcome) { return outcome.result.solved(); },
          "Is there a path?")
      .def_property_readonly(
          "status", [](const PlanOutcome& outcome) { return to_string(outcome.result.status); },
          "A word: \"solved\", or why not.")
      .def_property_readonly(
          "reason", [](const PlanOutcome& outcome) { return outcome.result.reason; },
          "One sentence for a person.")
      .def_property_readonly(
          "path",
          [](const PlanOutcome& outcome) {
            return to_array(outcome.result.path.waypoints, outcome.variables);
          },
          "[waypoints, variables], rad or m; [0, variables] without a path. Between two\n"
          "waypoints all joints move linearly together.")
      .def_property_readonly(
          "goal_pose", [](const PlanOutcome& outcome) { return outcome.goal_pose; },
          "Of goals as poses: the index of the one where the path ends; else None.")
      .def_property_readonly(
          "certificate", [](const PlanOutcome& outcome) { return outcome.result.certificate; },
          "Clearance of the path.")
      .def_property_readonly("statistics", &statistics_of,
                             "A dict with the keys of `handway plan --report`; rejections by pair\n"
                             "of names.")
      .def_property_readonly(
          "time_s", [](const PlanOutcome& outcome) { return outcome.result.time_s; },
          "Planning alone, wall clock, s.")
      .def_property_readonly(
          "smoothing_s", [](const PlanOutcome& outcome) { return outcome.result.smoothing_s; },
          "Wall clock, s.")
      .def_readonly("planner", &PlanOutcome::planner, "Name of the planner.")
      .def_readonly("seed", &PlanOutcome::seed, "Seed of all random choices.")
      .def("__repr__", &text_of);
}

void bind_check(py::module_& module) {
  py::class_<PathCheckResult>(module, "PathCheck",
                              "What a walk along a path on the exact meshes found.")
      .def_property_readonly("valid", &PathCheckResult::valid, "Without any fault?")
      .def_readonly("faults", &PathCheckResult::faults, "A sentence each.")
      .def_readonly("configurations", &PathCheckResult::configurations, "Checked ones.")
      .def_readonly("collisions", &PathCheckResult::collisions, "Of these, in collision.")
      .def_readonly("min_clearance_mm", &PathCheckResult::min_clearance_mm,
                    "At the checked configurations, mm; 0 if one collides.")
      .def_readonly("closest_pair", &PathCheckResult::closest_pair,
                    "\"A with B\" at the smallest clearance.")
      .def("__repr__", [](const PathCheckResult& check) {
        return std::string("<handway.PathCheck: ") + (check.valid() ? "valid" : "not valid") + ">";
      });
}

}  // namespace

void bind_results(py::module_& module) {
  bind_certificate(module);
  bind_result(module);
  bind_check(module);
}

}  // namespace handway::python
