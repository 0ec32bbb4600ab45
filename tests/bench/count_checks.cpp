/// Fixed configurations and edges near a problem's segment, each checked once: a program whose
/// instructions `scripts/checker-instructions` counts. It prints the verdicts, too.
///
/// count_checks PROBLEM configurations|edges
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway_test/known_problems.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr int kConfigurations = 256;
constexpr int kEdges = 128;
constexpr double kResolution = 5e-5;  // m
constexpr double kLength = 0.1;       // of an edge, as a share of the segment

using Edge = std::pair<Configuration, Configuration>;

std::vector<Edge> edges_with_free_ends(ExactCollisionChecker& checker,
                                       const test::CollisionProblem& problem) {
  const Configuration along = kLength * (problem.goal - problem.start);
  std::vector<Edge> edges;
  for (const Configuration& q : near_segment(problem, kEdges)) {
    if (!checker.first_collision(q) && !checker.first_collision(q + along)) {
      edges.emplace_back(q, q + along);
    }
  }
  return edges;
}

}  // namespace

// The names that the script toggles counting by.
__attribute__((noinline)) std::string count_configurations(
    ExactCollisionChecker& checker, const std::vector<Configuration>& configurations) {
  std::string verdicts;
  for (const Configuration& q : configurations) {
    verdicts += checker.first_collision(q) ? 'x' : '.';
  }
  return verdicts;
}

__attribute__((noinline)) std::string count_edges(ContinuousCollisionChecker& checker,
                                                  const std::vector<Edge>& edges) {
  std::string verdicts;
  for (const auto& [from, to] : edges) {
    verdicts += checker.check(from, to).free ? '.' : 'x';
  }
  return verdicts;
}

namespace {

int run(const std::string& name, std::string_view kind) {
  const std::vector<test::KnownProblem> problems = test::known_problems();
  const auto found = std::ranges::find(problems, name, &test::KnownProblem::name);
  if (found == problems.end() || (kind != "configurations" && kind != "edges")) {
    std::fputs("usage: count_checks PROBLEM configurations|edges\n", stderr);
    return 2;
  }
  const test::CollisionProblem problem(*test::load(*found).scene);
  ExactCollisionChecker checker(problem.world);
  const std::vector<Configuration> configurations = near_segment(problem, kConfigurations);
  const std::vector<Edge> edges = edges_with_free_ends(checker, problem);
  ContinuousCollisionChecker continuous(
      checker, std::make_shared<const MotionBound>(*problem.world), kResolution);
  for (const Configuration& q : configurations) {  // what is made on demand is not counted
    static_cast<void>(checker.first_collision(q));
  }
  const std::string verdicts = kind == "edges" ? count_edges(continuous, edges)
                                               : count_configurations(checker, configurations);
  std::puts(verdicts.c_str());
  return 0;
}

}  // namespace
}  // namespace handway::geometric

int main(int argc, char** argv) {
  return argc == 3 ? handway::geometric::run(argv[1], argv[2]) : 2;
}
