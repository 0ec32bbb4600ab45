#include "handway/planning/campaigns/run_executor.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/planning/paths/path_csv.h"

#include <utility>

namespace handway::planning {
namespace {

double length_of(const Path& path, const geometric::RobotModel& model) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    length += normalised_distance(model, path.waypoints[i - 1], path.waypoints[i]);
  }
  return length;
}

RunRecord record_of(const RunSpec& spec, const PlanResult& result,
                    const geometric::RobotModel& model) {
  RunRecord record;
  record.spec = spec;
  record.solved = result.solved();
  record.status = to_string(result.status);
  record.reason = result.reason;
  record.time_s = result.time_s;
  record.smoothing_s = result.smoothing_s;
  record.sampling_s = result.statistics.sampling_s;
  record.connection_s = result.statistics.connection_s;
  record.samples = result.statistics.samples;
  record.nodes = result.statistics.nodes;
  record.edges = result.statistics.edges;
  record.passes = result.statistics.passes;
  record.max_trials = result.statistics.max_trials;
  record.final_rho_a = result.statistics.final_rho_a;
  record.nodes_per_pmds = result.statistics.nodes_per_pmds;
  record.node_checks = result.statistics.node_checks;
  record.edge_checks = result.statistics.edge_checks;
  record.edges_tested = result.statistics.edges_tested;
  record.resolution_mm = result.certificate.resolution_mm;
  record.min_clearance_mm = result.certificate.min_clearance_mm;
  record.certificate_checks = result.certificate.checks;
  if (result.solved()) {
    record.path_nodes = result.path.waypoints.size();
    record.path_length = length_of(result.path, model);
    record.path = to_csv(result.path, model);
  }
  return record;
}

}  // namespace

RunExecutor::RunExecutor(Campaign campaign, const Extensions& extensions)
    : campaign_(std::move(campaign)), extensions_(extensions) {
  for (CampaignProblem& problem : campaign_.problems) {
    const geometric::FilesRead notes;
    const LoadedScene loaded = load_scene(problem.file, extensions);
    problem.files = notes.files();
    problems_.push_back(make_problem(loaded.scene, loaded.basis));
  }
}

std::optional<RunRecord> RunExecutor::run(const RunSpec& spec, std::stop_token stop) const {
  const PlanningProblem& problem = problems_[static_cast<std::size_t>(spec.problem)];
  const std::unique_ptr<Planner> planner = make_planner(
      campaign_.planners[static_cast<std::size_t>(spec.planner)], extensions_.planners());
  PlanRequest request;
  request.seed = spec.seed;
  request.threads = campaign_.threads;
  request.time_limit_s = campaign_.time_limit_s;
  try {
    const PlanResult result = planner->plan(problem, request, std::move(stop));
    if (result.status == PlanStatus::kCancelled) {
      return std::nullopt;
    }
    return record_of(spec, result, problem.model());
  } catch (const geometric::InputError& error) {  // it needs what the problem has not
    RunRecord record;
    record.spec = spec;
    record.status = "refused";
    record.reason = error.what();
    return record;
  }
}

}  // namespace handway::planning
