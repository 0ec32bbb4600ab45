#include "plan_report.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/core/plan_result.h"
#include "version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <variant>

namespace handway::tools {
namespace {

using Json = nlohmann::ordered_json;

Json value_of(const geometric::Parameter& parameter) {
  return std::visit(
      [&](const auto& value) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, geometric::Choice>) {
          return to_text(parameter);
        } else {
          return value;
        }
      },
      parameter.value);
}

// Returns a length in mm, such as 15.7, without the rounding errors of its conversion to metres.
double as_given(double millimetres) {
  constexpr double kDigits = 1e9;
  return std::round(millimetres * kDigits) / kDigits;
}

Json statistics_of(const planning::PlanStatistics& statistics) {
  Json rejections = Json::array();
  for (const auto& [pair, count] : statistics.rejections) {
    rejections.push_back({{"a", pair.first}, {"b", pair.second}, {"samples", count}});
  }
  return {{"samples", statistics.samples},
          {"nodes", statistics.nodes},
          {"edges", statistics.edges},
          {"passes", statistics.passes},
          {"max_trials", statistics.max_trials},
          {"final_rho_a", statistics.final_rho_a},
          {"nodes_per_pmds", statistics.nodes_per_pmds},
          {"checks",
           {{"nodes", statistics.node_checks},
            {"edges", statistics.edge_checks},
            {"edges_tested", statistics.edges_tested}}},
          {"sampling_s", statistics.sampling_s},
          {"connection_s", statistics.connection_s},
          {"rejections", rejections},
          {"rejections_per_tenth", statistics.rejections_per_tenth}};
}

Json distance_of(const planning::DistanceAlong& distance) {
  return {{"mean", distance.mean}, {"largest", distance.largest}};
}

Json likeness_of(const std::optional<planning::PathLikeness>& likeness) {
  if (!likeness) {
    return nullptr;
  }
  return {
      {"to_subspace", distance_of(likeness->to_subspace)},
      {"to_recorded", likeness->to_recorded ? distance_of(*likeness->to_recorded) : Json(nullptr)}};
}

Json smoothness_of(const std::optional<planning::MovementSmoothness>& smoothness) {
  if (!smoothness) {
    return nullptr;
  }
  return {{"log_dimensionless_jerk", smoothness->log_dimensionless_jerk},
          {"spectral_arc_length", smoothness->spectral_arc_length}};
}

std::vector<std::string> names_of(const geometric::RobotModel& model,
                                  const std::vector<int>& variables) {
  std::vector<std::string> names;
  std::ranges::transform(variables, std::back_inserter(names),
                         [&](int v) { return model.variable(v).name; });
  return names;
}

Json cost_json(const std::optional<planning::PathCost>& cost) {
  if (!cost) {
    return nullptr;
  }
  return {{"cost", cost->cost}, {"least", cost->least}, {"gap", cost->gap()}};
}

// Goal pose that the path reaches, in a problem whose goal is given by poses.
Json goal_of(const planning::PlanningProblem& problem, const planning::PlanResult& result) {
  if (!result.goal) {
    return nullptr;
  }
  const std::size_t pose = problem.goals[*result.goal].pose;
  return {{"pose", pose + 1},
          {"link", problem.scene->goal_poses[pose].link},
          {"configuration", *result.goal + 1},
          {"configurations", problem.goals.size()}};
}

}  // namespace

std::string plan_report(planning::Planner& planner, const planning::PlanningProblem& problem,
                        const planning::PlanRequest& request, const planning::PlanResult& result,
                        double load_s, const std::optional<planning::PathLikeness>& likeness,
                        const std::optional<planning::PathQuality>& quality,
                        const std::optional<MotionMeasures>& motion) {
  Json parameters = Json::object();
  for (const geometric::Parameter& parameter : planner.parameters()) {
    parameters[parameter.key] = value_of(parameter);
  }
  Json departures = Json::object();
  for (const geometric::Parameter& parameter : geometric::departures(planner.parameters())) {
    departures[parameter.key] = {{"value", value_of(parameter)},
                                 {"as_printed", parameter.as_printed}};
  }
  Json out_of_margin = Json::array();
  for (const planning::OutOfMargin& near : result.out_of_margin) {
    out_of_margin.push_back({{"end", near.at_goal ? "goal" : "start"},
                             {"pair", {near.pair.a, near.pair.b}},
                             {"distance_mm", geometric::millimetres(near.pair.distance)}});
  }
  const Json report = {
      {"solved", result.solved()},
      {"status", to_string(result.status)},
      {"reason", result.reason},
      {"explanation", planning::explain_failure(result)},
      {"planner", planner.name()},
      {"seed", request.seed},
      {"threads", request.threads},
      {"time_s", result.time_s},
      {"smoothing_s", result.smoothing_s},
      {"optimize_checks", result.optimize_checks},
      {"cost", cost_json(result.cost)},
      {"load_s", load_s},
      {"goal", goal_of(problem, result)},
      {"group", problem.scene->group},
      {"moving", names_of(problem.model(), problem.joints.moving)},
      {"path_nodes", result.path.waypoints.size()},
      {"certificate",
       {{"resolution_mm", geometric::millimetres(result.certificate.resolution)},
        {"resolution_at_start_mm", geometric::millimetres(result.certificate.resolution_at_start)},
        {"resolution_at_goal_mm", geometric::millimetres(result.certificate.resolution_at_goal)},
        {"min_clearance_mm", geometric::millimetres(result.certificate.min_clearance)},
        {"checks", result.certificate.checks}}},
      {"margin_mm", as_given(geometric::millimetres(request.margin))},
      {"out_of_margin", out_of_margin},
      {"objective", path_quality_json(quality)},
      {"human_likeness", likeness_of(likeness)},
      {"motion", motion_json(motion)},
      {"statistics", statistics_of(result.statistics)},
      {"parameters", parameters},
      {"departures", departures},
      {"version", kVersion},
  };
  return report.dump(2) + "\n";
}

nlohmann::ordered_json path_quality_json(const std::optional<planning::PathQuality>& quality) {
  if (!quality) {
    return nullptr;
  }
  Json likeness = nullptr;
  if (const auto& human = quality->human_likeness) {
    likeness = {{"to_subspace",
                 {{"mean", human->mean},
                  {"largest", human->largest},
                  {"share_beyond", human->share_beyond},
                  {"forced", human->forced}}},
                {"mahalanobis",
                 {{"mean", human->mahalanobis_mean}, {"largest", human->mahalanobis_largest}}}};
  }
  return {{"length", quality->length},
          {"human_likeness", likeness},
          {"clearance",
           {{"least_mm", geometric::millimetres(quality->least_clearance)},
            {"mean_mm", geometric::millimetres(quality->mean_clearance)}}},
          {"duration_s", quality->duration}};
}

nlohmann::ordered_json motion_json(const std::optional<MotionMeasures>& motion) {
  if (!motion || !motion->fault.empty()) {
    return nullptr;
  }
  const planning::MotionLikeness& likeness = motion->likeness;
  Json deviation = nullptr;
  if (likeness.deviation) {
    deviation = {{"arm", likeness.deviation->arm},
                 {"palm_mm", geometric::millimetres(likeness.deviation->palm)}};
  }
  Json components = nullptr;
  if (const auto& error = likeness.components) {
    components = {{"error_rad", error->error},
                  {"recorded_median_rad", error->recorded_median},
                  {"recorded_95_rad", error->recorded_95},
                  {"motions", error->motions},
                  {"components", error->components},
                  {"recordings", motion->recordings}};
  }
  return {{"duration_s", likeness.duration},
          {"hand", smoothness_of(likeness.hand)},
          {"palm", smoothness_of(likeness.palm)},
          {"deviation", deviation},
          {"components", components},
          {"no_components", likeness.no_components}};
}

std::shared_ptr<const sampling::RecordedPostures> recorded_postures(
    const planning::PlanningProblem& problem, const std::filesystem::path& postures) {
  if (!problem.basis && !postures.empty()) {
    throw geometric::InputError({problem.scene->file.string(), "hand_basis", "nothing",
                                 "a PMD basis with the joints of the postures",
                                 "Name one in the scene."});
  }
  if (!problem.basis) {
    return nullptr;
  }
  return postures.empty() ? sampling::load_recorded_postures(*problem.basis)
                          : sampling::load_recorded_postures(*problem.basis, postures);
}

std::optional<planning::PathLikeness> hand_likeness(
    const planning::PlanningProblem& problem, const planning::Path& path,
    const std::shared_ptr<const sampling::RecordedPostures>& recorded) {
  if (!problem.basis || path.empty()) {
    return std::nullopt;
  }
  const planning::HumanLikeness likeness(problem.model(), problem.joints.hand, *problem.basis,
                                         recorded);
  return planning::path_likeness(problem.model(), likeness, path);
}

std::optional<MotionMeasures> measure_motion(
    const planning::PlanningProblem& problem, const planning::Path& path,
    const std::shared_ptr<const sampling::RecordedPostures>& recorded) {
  if (path.empty()) {
    return std::nullopt;
  }
  MotionMeasures measures;
  const auto timed = planning::likeness_trajectory(problem, path);
  if (const auto* trajectory = std::get_if<planning::Trajectory>(&timed)) {
    measures.likeness = planning::motion_likeness(problem, *trajectory, recorded.get());
    measures.recordings = recorded ? recorded->source() : std::string();
    measures.motion = planning::comparable_motion(problem, *trajectory);
  } else {
    measures.fault = std::get<std::string>(timed);
  }
  return measures;
}

}  // namespace handway::tools
