#include "handway/planning/queries/arm_progress.h"

#include <algorithm>

namespace handway::planning {

double arm_progress(const PlanningProblem& problem, const Configuration& q) {
  const Eigen::VectorXd motion = problem.goal(problem.arm) - problem.start(problem.arm);
  const double length = motion.squaredNorm();
  if (length == 0.0) {
    return 0.0;
  }
  return std::clamp((q(problem.arm) - problem.start(problem.arm)).dot(motion) / length, 0.0, 1.0);
}

}  // namespace handway::planning
