#include "hand_likeness.h"

#include "handway/geometric/io/input_error.h"

namespace handway::tools {

std::optional<planning::PathLikeness> hand_likeness(const planning::PlanningProblem& problem,
                                                    const planning::Path& path,
                                                    const std::filesystem::path& postures) {
  if (!problem.basis && !postures.empty()) {
    throw geometric::InputError({problem.scene->file.string(), "hand_basis", "nothing",
                                 "a PMD basis, whose joints the postures are of",
                                 "Name one in the scene."});
  }
  if (!problem.basis || path.empty()) {
    return std::nullopt;
  }
  const planning::HumanLikeness likeness(
      problem.model(), problem.hand, *problem.basis,
      postures.empty() ? sampling::load_recorded_postures(*problem.basis)
                       : sampling::load_recorded_postures(*problem.basis, postures));
  return planning::path_likeness(problem.model(), likeness, path);
}

}  // namespace handway::tools
