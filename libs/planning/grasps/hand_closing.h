#pragma once

#include "handway/planning/core/planning_problem.h"

#include <optional>
#include <vector>

namespace handway::planning {

/// The point of the segment from `a` to `b` that is closest to `p`.
[[nodiscard]] Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                                 const Eigen::Vector3d& b);

/// Opened preshapes of a problem's hand, drawn from its PMD box, and how its fingers close.
class HandClosing {
 public:
  /// @pre the problem has a basis. @param palm the link of the hand.
  HandClosing(const PlanningProblem& problem, int palm);

  /// An opened hand, seen from its palm: a thumb against fingers side by side. Lengths in m.
  struct Preshape {
    Eigen::VectorXd open;        ///< Normalised joints in the basis' order.
    Eigen::Vector3d grip;        ///< Between the thumb's tip and the middle of the others.
    Eigen::Vector3d opposition;  ///< From the thumb to the others; of length 1.
    Eigen::Vector3d row;         ///< Along the others' tips, square to it; of length 1.
    double opening = 0.0;        ///< From the thumb's tip to the others.
  };
  /// The widest open first.
  [[nodiscard]] const std::vector<Preshape>& preshapes() const { return preshapes_; }

  /// The part of the hand that one branch of the palm carries.
  struct Finger {
    std::vector<int> joints;  ///< Indices in the basis' order, the nearest to the palm first.
    std::vector<int> links;
    Eigen::Vector3d p_LTip = Eigen::Vector3d::Zero();  ///< Middle of the last one, in its frame.
  };
  [[nodiscard]] const std::vector<Finger>& fingers() const { return fingers_; }

  /// `q` with the hand in `posture`, brought within limits.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& posture) const;
  /// The hand of `q`, normalised.
  [[nodiscard]] Eigen::VectorXd hand_of(const Configuration& q) const;

  /// How a finger's joints bring its tip closer to a segment: shape [joints of the finger], of
  /// length 1, or zero where none does. @param a, b ends of the segment in the palm's frame, m.
  [[nodiscard]] Eigen::VectorXd towards(const Finger& finger, const Eigen::VectorXd& posture,
                                        const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

 private:
  void find_fingers();
  void make_preshapes();
  [[nodiscard]] std::optional<Preshape> preshape(Eigen::VectorXd open) const;
  [[nodiscard]] Eigen::Vector3d tip(const Finger& finger, const Eigen::VectorXd& posture) const;

  const PlanningProblem& problem_;
  int palm_;
  std::vector<Finger> fingers_;
  std::vector<Preshape> preshapes_;
};

}  // namespace handway::planning
