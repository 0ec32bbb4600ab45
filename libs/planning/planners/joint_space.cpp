#include "handway/geometric/robot/normalised_joints.h"
#include "handway/sampling/regions/arm_corridor.h"
#include "planners/search_space.h"

namespace handway::planning {
namespace {

class JointSpace final : public SearchSpace {
 public:
  explicit JointSpace(const PlanningProblem& problem)
      : SearchSpace(problem),
        corridor_(arm_coordinates(problem.start), arm_coordinates(problem.goal)) {}

  [[nodiscard]] int steps(double rho) const override { return corridor_.steps(rho); }

  [[nodiscard]] int arm_draws() const override { return corridor_.dimension(); }

  [[nodiscard]] Eigen::VectorXd within_limits(Eigen::VectorXd x) const override {
    return x.cwiseMax(0.0).cwiseMin(1.0);
  }

 protected:
  [[nodiscard]] Eigen::VectorXd arm_coordinates(const Configuration& q) const override {
    return geometric::normalised(problem().model(), q)(problem().arm);
  }

  [[nodiscard]] std::optional<Configuration> with_arm(const Configuration& q,
                                                      const Eigen::VectorXd& x) const override {
    Eigen::VectorXd joints = geometric::normalised(problem().model(), q);
    joints(problem().arm) = x;
    return geometric::denormalised(problem().model(), joints);
  }

  [[nodiscard]] Eigen::VectorXd draw_arm(double step, double rho,
                                         const Eigen::VectorXd& u) const override {
    return corridor_.sample(step, rho, u);
  }

 private:
  sampling::ArmCorridor corridor_;
};

}  // namespace

std::unique_ptr<SearchSpace> make_joint_space(const PlanningProblem& problem) {
  return std::make_unique<JointSpace>(problem);
}

}  // namespace handway::planning
