#include "planners/problem_log.h"

#include "handway/geometric/formats/scene_writer.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/sampling/postures/pmd_basis_io.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;

std::string command(Planner& planner, const PlanRequest& request) {
  std::string text = fmt::format("handway plan scene.yaml --planner {} --seed {} --threads {}",
                                 planner.name(), request.seed, request.threads);
  if (std::isfinite(request.time_limit_s)) {
    text += fmt::format(" --time-limit {}", request.time_limit_s);
  }
  if (request.margin_mm > 0.0) {
    text += fmt::format(" --margin {}", request.margin_mm);
  }
  if (request.optimize_s > 0.0) {
    text += fmt::format(" --optimize {}", request.optimize_s);
  }
  for (const Parameter& parameter : planner.parameters()) {
    text += fmt::format(" --set {}={}", parameter.key, to_text(parameter));
  }
  return text + "\n";
}

}  // namespace

void log_problem(Planner& planner, const PlanningProblem& problem, const PlanRequest& request) {
  const char* folder = std::getenv("HANDWAY_LOG_PROBLEMS");
  if (folder == nullptr || *folder == '\0') {
    return;
  }
  static std::atomic<int> number{0};
  try {
    const fs::path own =
        fs::absolute(folder) / fmt::format("{}-{:04}-{}", ::getpid(), ++number, planner.name());
    fs::create_directories(own);
    geometric::Scene scene = *problem.scene;
    scene.start = problem.start;
    if (!problem.has_pose_goals()) {
      scene.goal = problem.goal;
      scene.goal_poses.clear();
    }
    if (problem.basis) {
      scene.hand_basis = own / "hand.yaml";
      sampling::write_pmd_basis(*problem.basis, scene.hand_basis);
    }
    geometric::write_scene(scene, own / "scene.yaml");
    geometric::replace_file(own / "command.txt", command(planner, request));
  } catch (const std::exception& error) {
    spdlog::warn("The problem was not logged: {}", error.what());
  }
}

}  // namespace handway::planning
