#include "handway/sampling/regions/cartesian_corridor.h"
#include "planners/arm_tool.h"
#include "planners/search_space.h"

#include <Eigen/Geometry>

namespace handway::planning {
namespace {

using geometric::Pose;

class ToolSpace final : public SearchSpace {
 public:
  explicit ToolSpace(const PlanningProblem& problem)
      : SearchSpace(problem),
        tool_(problem),
        corridor_(tool_.pose(problem.start), tool_.pose(problem.goal), scale_),
        q_BM_(Eigen::Quaterniond(tool_.pose(problem.start).linear())
                  .slerp(0.5, Eigen::Quaterniond(tool_.pose(problem.goal).linear()))) {}

  [[nodiscard]] int steps(double rho) const override { return corridor_.steps(rho); }

  [[nodiscard]] int arm_draws() const override { return sampling::CartesianCorridor::kDimension; }

 protected:
  [[nodiscard]] Eigen::VectorXd arm_coordinates(const Configuration& q) const override {
    return chart(tool_.pose(q));
  }

  [[nodiscard]] std::optional<Configuration> with_arm(const Configuration& q,
                                                      const Eigen::VectorXd& x) const override {
    Pose X_BT = Pose::Identity();
    X_BT.translation() = scale_.position * x.head<3>();
    X_BT.linear() =
        q_BM_.toRotationMatrix() *
        geometric::turn_from_rotation_vector(scale_.orientation * x.tail<3>()).toRotationMatrix();
    return tool_.moved(q, X_BT);
  }

  [[nodiscard]] Eigen::VectorXd draw_arm(double step, double rho,
                                         const Eigen::VectorXd& u) const override {
    return chart(corridor_.pose(step, rho, u));
  }

 private:
  // Position, and the rotation vector from the orientation midway between start
  // and goal, so that the chart's border, half a turn, is far.
  [[nodiscard]] Eigen::VectorXd chart(const Pose& X_BT) const {
    const Eigen::AngleAxisd turn(q_BM_.conjugate() * Eigen::Quaterniond(X_BT.linear()));
    Eigen::VectorXd x(6);
    x << X_BT.translation() / scale_.position, turn.angle() * turn.axis() / scale_.orientation;
    return x;
  }

  sampling::CartesianScale scale_;
  ArmTool tool_;
  sampling::CartesianCorridor corridor_;
  Eigen::Quaterniond q_BM_;
};

}  // namespace

std::unique_ptr<SearchSpace> make_tool_space(const PlanningProblem& problem) {
  return std::make_unique<ToolSpace>(problem);
}

}  // namespace handway::planning
