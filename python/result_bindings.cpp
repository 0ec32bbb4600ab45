#include "arrays.h"
#include "bindings.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/paths/path_check.h"
#include "planner_model.h"

#include <pybind11/stl.h>

#include <optional>
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

// Returns a getter of a distance in mm.
template <typename Result>
auto in_millimetres(double Result::*distance) {
  return [distance](const Result& result) { return geometric::millimetres(result.*distance); };
}

void bind_certificate(py::module_& module) {
  py::class_<Certificate>(
      module, "Certificate",
      "Certificate of a path: it holds for every configuration on it and every checked pair.")
      .def_property_readonly("resolution_mm", in_millimetres(&Certificate::resolution),
                             "Distance that moving pairs keep at least along edges, mm.")
      .def_property_readonly(
          "resolution_at_start_mm", in_millimetres(&Certificate::resolution_at_start),
          "Resolution next to the start, mm; finer than elsewhere if the start itself has less\n"
          "than twice the resolution.")
      .def_property_readonly("resolution_at_goal_mm",
                             in_millimetres(&Certificate::resolution_at_goal),
                             "Resolution next to the goal, mm.")
      .def_property_readonly(
          "min_clearance_mm", in_millimetres(&Certificate::min_clearance),
          "Lower bound of the clearance over the whole path, mm; at most a fifth too low, and\n"
          "not more than 50 mm.")
      .def_readonly("checks", &Certificate::checks, "Number of configurations checked.");
}

void bind_result(py::module_& module) {
  py::class_<PlanOutcome>(
      module, "Result",
      "Result of planning: the path or the reason why there is none, and statistics.")
      .def_property_readonly(
          "solved", [](const PlanOutcome& outcome) { return outcome.result.solved(); },
          "True if there is a path.")
      .def_property_readonly(
          "status", [](const PlanOutcome& outcome) { return to_string(outcome.result.status); },
          "Outcome as one word: \"solved\", or the kind of failure.")
      .def_property_readonly(
          "reason", [](const PlanOutcome& outcome) { return outcome.result.reason; },
          "Explanation of the outcome, one sentence.")
      .def_property_readonly(
          "path",
          [](const PlanOutcome& outcome) {
            return to_array(outcome.result.path.waypoints, outcome.variables);
          },
          "Waypoints, [waypoints, variables], rad or m; [0, variables] without a path. Between\n"
          "two waypoints all joints move linearly together.")
      .def_property_readonly(
          "goal_pose", [](const PlanOutcome& outcome) { return outcome.goal_pose; },
          "Index of the goal pose where the path ends; None without goal poses.")
      .def_property_readonly(
          "certificate", [](const PlanOutcome& outcome) { return outcome.result.certificate; },
          "Certificate of the path's clearance.")
      .def_property_readonly(
          "statistics", &statistics_of,
          "Statistics as a dict with the keys of `handway plan --report`; rejections\n"
          "by pair of names.")
      .def_property_readonly(
          "time_s", [](const PlanOutcome& outcome) { return outcome.result.time_s; },
          "Wall-clock time of planning alone, s.")
      .def_property_readonly(
          "smoothing_s", [](const PlanOutcome& outcome) { return outcome.result.smoothing_s; },
          "Wall-clock time of smoothing, s.")
      .def_property_readonly(
          "cost",
          [](const PlanOutcome& outcome) -> std::optional<double> {
            const auto& cost = outcome.result.cost;
            return cost ? std::optional(cost->cost) : std::nullopt;
          },
          "Cost of an optimised path by the planner's objective; None if it was not optimised.")
      .def_property_readonly(
          "least_cost",
          [](const PlanOutcome& outcome) -> std::optional<double> {
            const auto& cost = outcome.result.cost;
            return cost ? std::optional(cost->least) : std::nullopt;
          },
          "A cost that no path between the same ends is below; None as `cost`.")
      .def_readonly("planner", &PlanOutcome::planner, "Name of the planner.")
      .def_readonly("seed", &PlanOutcome::seed, "Seed of all random choices.")
      .def("__repr__", &text_of);
}

void bind_check(py::module_& module) {
  py::class_<PathCheckResult>(module, "PathCheck", "Result of checking a path on the exact meshes.")
      .def_property_readonly("valid", &PathCheckResult::valid, "True if the path has no fault.")
      .def_readonly("faults", &PathCheckResult::faults, "Faults of the path, a sentence each.")
      .def_readonly("configurations", &PathCheckResult::configurations,
                    "Number of configurations checked.")
      .def_readonly("collisions", &PathCheckResult::collisions,
                    "Number of configurations in collision or violating a constraint.")
      .def_property_readonly(
          "min_clearance_mm", in_millimetres(&PathCheckResult::min_clearance),
          "Smallest clearance at the checked configurations, mm; 0 if one collides.")
      .def_readonly("closest_pair", &PathCheckResult::closest_pair,
                    "Pair with the smallest clearance, as \"A with B\".")
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
