#pragma once

#include "handway/planning/tasks/task.h"

#include <cstddef>
#include <vector>

namespace handway::planning {

/// Steps of a task by their indices, in their order.
using Steps = std::vector<std::size_t>;

/// Returns the steps of a task, without those of alternatives.
[[nodiscard]] Steps steps_of(const Task& task);

/// Returns the steps of each alternative of a step; none if the step has no alternatives.
[[nodiscard]] std::vector<Steps> alternatives_of(const Task& task, std::size_t step);

/// Throws an InputError for steps that can't follow each other, and for names that the scene lacks.
void check_steps(const geometric::Scene& scene, const Task& task);

}  // namespace handway::planning
