#include "handway_test/known_problems.h"

#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"
#include "kautham_importer.h"

#include <algorithm>
#include <random>

namespace handway::test {

namespace fs = std::filesystem;
using geometric::Configuration;

std::vector<KnownProblem> known_problems() {
  std::vector<KnownProblem> problems;
  for (const fs::directory_entry& entry : fs::directory_iterator(source_dir() / "scenes")) {
    if (entry.path().extension() == ".yaml") {
      problems.push_back({entry.path().stem().string(), entry.path()});
    }
  }
  std::sort(problems.begin(), problems.end(),
            [](const KnownProblem& a, const KnownProblem& b) { return a.name < b.name; });
  if (const std::optional<fs::path> reference = reference_dir()) {
    const std::string prefix = "TX90_RHand_ICRA10_5PMD";
    for (const char* name : {"_TwoCanb", "_CanBox", "_ShelfCan2", "-shelfT2"}) {
      const fs::path file = *reference / "auro" / (prefix + name + "_new.xml");
      if (fs::exists(file)) {
        problems.push_back({name + 1, file});
      }
    }
  }
  return problems;
}

planning::SceneState load(const KnownProblem& problem) {
  return problem.file.extension() == ".xml"
             ? import_kautham::KauthamImporter().read(problem.file)
             : planning::load_scene(problem.file, planning::PluginManager());
}

CollisionProblem::CollisionProblem(const geometric::Scene& scene)
    : world(std::make_shared<const geometric::CollisionWorld>(scene)),
      start(scene.start.value()),
      goal(scene.goal.value()) {}

std::vector<Configuration> near_segment(const CollisionProblem& problem, int count,
                                        std::uint64_t seed) {
  constexpr double kSpread = 0.05;
  const geometric::RobotModel& model = problem.world->model();
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Configuration> configurations;
  for (int k = 0; k < count; ++k) {
    Configuration q = problem.start + uniform(engine) * (problem.goal - problem.start);
    for (int v = 0; v < model.variable_count(); ++v) {
      q[v] += kSpread * (2.0 * uniform(engine) - 1.0) * (model.upper()[v] - model.lower()[v]);
    }
    configurations.push_back(q);
  }
  return configurations;
}

}  // namespace handway::test
