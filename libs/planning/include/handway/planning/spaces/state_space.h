#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// Coordinates in which a planner samples configurations, measures distances and moves: a box of
/// real numbers, Euclidean distances, straight lines; those of continuous joints are periodic. It
/// ignores obstacles.
class HANDWAY_PLANNING_EXPORT StateSpace {
 public:
  virtual ~StateSpace();
  StateSpace(const StateSpace&) = delete;
  StateSpace& operator=(const StateSpace&) = delete;

  [[nodiscard]] const PlanningProblem& problem() const { return problem_; }
  [[nodiscard]] int dimension() const { return static_cast<int>(lower_.size()); }
  /// Periods of continuous joints.
  [[nodiscard]] const geometric::Periods& periods() const { return periods_; }
  /// Corners of the box, shape [dimension()]; a coordinate without limits is infinite there.
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }

  /// Shape [dimension()]; within the box up to rounding.
  [[nodiscard]] virtual Eigen::VectorXd coordinates(const Configuration& q) const = 0;

  /// The configuration at `x`, nearest to `reference` if there are several; joints that have no
  /// coordinate are as there. Nothing if `x` has no configuration.
  [[nodiscard]] virtual std::optional<Configuration> configuration(
      const Eigen::VectorXd& x, const Configuration& reference) const = 0;

 protected:
  /// @param problem must outlive this object.
  explicit StateSpace(const PlanningProblem& problem);

  /// Joints of the arm, and those of neither arm nor hand whose values at start and goal differ:
  /// they have to move, too.
  [[nodiscard]] const geometric::JointIndices& arm() const { return arm_; }

  /// To be called by the derived constructor.
  void set_bounds(Eigen::VectorXd lower, Eigen::VectorXd upper, geometric::Periods periods = {});

 private:
  const PlanningProblem& problem_;
  geometric::JointIndices arm_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  geometric::Periods periods_;
};

/// Space of the arm's sampling region along the straight motion.
enum class CorridorForm {
  kJoint,      ///< Arm joints, as printed (paper, section 5.1).
  kCartesian,  ///< Poses of the arm's tool.
};

/// A space of the arm's coordinates followed by the hand's joints, normalised to [0, 1], with a
/// corridor around the arm's straight motion from start to goal (paper, section 5.1).
class HANDWAY_PLANNING_EXPORT CorridorSpace : public StateSpace {
 public:
  [[nodiscard]] Eigen::VectorXd coordinates(const Configuration& q) const final;
  [[nodiscard]] std::optional<Configuration> configuration(
      const Eigen::VectorXd& x, const Configuration& reference) const final;

  /// Hypercubes of half side `rho` that the corridor is cut into, minus one: STEPS of section 5.3,
  /// the smallest power of two n such that n + 1 evenly spaced points of the straight motion are at
  /// most `rho` apart; at most 2^20. Powers of two, so that sampling::sweep_position() visits each
  /// point once.
  [[nodiscard]] int steps(double rho) const;
  /// Size of the points that corridor_point() takes.
  [[nodiscard]] virtual int corridor_dimension() const = 0;
  /// The arm's coordinates in the hypercube of half side `rho` at `step` (0: start, 1: goal).
  /// @param u in [0,1]^corridor_dimension(): place in the hypercube (Algorithm 1's sample).
  [[nodiscard]] virtual Eigen::VectorXd corridor_point(double step, double rho,
                                                       const Eigen::VectorXd& u) const = 0;

 protected:
  using StateSpace::StateSpace;

  /// To be called by the derived constructor. @param joints whose normalised joints are the
  /// arm's coordinates; -1 for a coordinate without limits.
  void set_arm_coordinates(geometric::JointIndices joints);

  /// Length of the straight motion, in the arm's coordinates.
  [[nodiscard]] virtual double corridor_length() const = 0;
  [[nodiscard]] virtual Eigen::VectorXd arm_coordinates(const Configuration& q) const = 0;
  /// Returns `q`, with its hand posture, with the arm at `x`.
  [[nodiscard]] virtual std::optional<Configuration> with_arm(const Configuration& q,
                                                              const Eigen::VectorXd& x) const = 0;
};

/// Arm joints normalised to [0, 1], or the pose of the last arm link: its position and rotation
/// vector in units of 1 m and 3 rad. In a Cartesian corridor the arm's inverse kinematics is solved
/// in closed form or iteratively; for a redundant arm the configuration at a pose then depends on
/// the reference.
/// @throws InputError if a Cartesian corridor is requested and the arm has fewer than six joints,
/// or some that do not move its last link.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::unique_ptr<CorridorSpace> make_corridor_space(
    const PlanningProblem& problem, CorridorForm form);

/// Returns whether the inverse kinematics of the arm's last link is solved in closed form.
[[nodiscard]] HANDWAY_PLANNING_EXPORT bool has_closed_form_kinematics(
    const PlanningProblem& problem);

/// Hand postures from which a planner samples.
enum class HandSpace {
  kPrincipalDirections,  ///< SC^h: free joints and principal motion directions (the paper's
                         ///< method).
  kAllJoints,            ///< C^h: every joint over its range (its comparison, section 6.2).
};

/// Throws if a hand needs principal motion directions and the problem has no basis with them. A
/// hand that holds an object needs none.
/// @param user of the basis, for the message, as "planner pmd-prm".
/// @throws InputError
HANDWAY_PLANNING_EXPORT void require_directions(const PlanningProblem& problem,
                                                const std::string& user);

/// The axes of a space of hand postures: the problem's basis, or one of all joints of the hand,
/// which is also used if a hand holds an object and only few of its joints can move.
[[nodiscard]] HANDWAY_PLANNING_EXPORT sampling::PmdBasis hand_basis(const PlanningProblem& problem,
                                                                    HandSpace space);

/// The controls of the paper's method: along the arm's straight motion and across it up to
/// `half_width` (section 5.1), the hand's free joints and principal motion directions (section
/// 4.2). Two more coordinates lead from the subspace of the hand to the postures at start and goal,
/// which are seldom in it: the shares of the start's and of the goal's deviation.
///
/// Coordinates are lengths in joints normalised to [0, 1], so that distances are nearly those of
/// the joints; joints beyond their limits are clamped.
/// @param most_pmds principal directions that are used.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::unique_ptr<StateSpace> make_control_space(
    const PlanningProblem& problem, int most_pmds, double half_width);

/// The paper's sampling regions (section 5.1): the arm in a corridor around its straight motion,
/// the hand in the box of its axes.
class HANDWAY_PLANNING_EXPORT HandArmRegion {
 public:
  /// The hand's axes are those of the problem's basis, or, for kAllJoints and without a basis,
  /// every hand joint separately. @param problem must outlive this object.
  /// @throws InputError as make_corridor_space().
  HandArmRegion(const PlanningProblem& problem, HandSpace hand, CorridorForm form);

  [[nodiscard]] const CorridorSpace& space() const { return *space_; }
  [[nodiscard]] const sampling::PmdBasis& basis() const { return basis_; }

  /// Samples c_a from the hypercube at `step`, with the hand as at the start; nothing if the chosen
  /// tool pose is out of reach. Of several arm postures the one nearest to the straight motion is
  /// taken. @param u as CorridorSpace::corridor_point().
  [[nodiscard]] std::optional<Configuration> arm_at(double step, double rho,
                                                    const Eigen::VectorXd& u) const;

  /// (c_a, MAP(sc_h)): `q` with the hand at the posture of `u` in [0,1]^k, of the first k axes.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& u) const;

 private:
  const PlanningProblem& problem_;
  sampling::PmdBasis basis_;
  std::unique_ptr<CorridorSpace> space_;
};

}  // namespace handway::planning
