#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/planning/extensions/plugin.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// The problems that the project is measured on: the scenes that ship, and the
/// published ones where they are.
namespace handway::test {

/// A problem file, not read yet.
struct KnownProblem {
  std::string name;
  std::filesystem::path file;
};

/// The scenes that ship, by name; then the published problems 1 to 4 ("TwoCanb",
/// "CanBox", "ShelfCan2", "shelfT2"), if reference_dir() has them.
[[nodiscard]] std::vector<KnownProblem> known_problems();

/// @throws InputError if the file can't be read.
[[nodiscard]] planning::SceneState load(const KnownProblem& problem);

/// Collision world and query of a scene with start and goal.
struct CollisionProblem {
  explicit CollisionProblem(const geometric::Scene& scene);

  std::shared_ptr<const geometric::CollisionWorld> world;
  geometric::Configuration start;
  geometric::Configuration goal;
};

/// Configurations around the segment from start to goal, uniform up to 5 % of every
/// joint's range off it: about as far as the planners' corridors reach.
[[nodiscard]] std::vector<geometric::Configuration> near_segment(const CollisionProblem& problem,
                                                                 int count, std::uint64_t seed = 1);

}  // namespace handway::test
