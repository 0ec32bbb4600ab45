#pragma once

#include "handway/planning/core/planning_problem.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Opened preshapes of a problem's hand, drawn from its PMD box, and how each finger closes.
class HandClosing {
 public:
  /// @pre the problem has a basis. @param palm the link of the hand.
  HandClosing(const PlanningProblem& problem, int palm);

  /// An opened hand and what closes it; normalised joints in the basis' order.
  struct Preshape {
    Eigen::VectorXd open;
    Eigen::VectorXd closing;  ///< A whole stroke of every finger.
    Eigen::Vector3d grip;     ///< Between the fingertips; palm frame, m.
  };
  [[nodiscard]] const std::vector<Preshape>& preshapes() const { return preshapes_; }

  /// The part of the hand that one branch of the palm carries.
  struct Finger {
    std::vector<int> joints;  ///< Indices in the basis' order.
    std::vector<int> links;
    Eigen::Vector3d p_LTip = Eigen::Vector3d::Zero();  ///< Middle of the last one, in its frame.
  };
  [[nodiscard]] const std::vector<Finger>& fingers() const { return fingers_; }

  /// `q` with the hand in `posture`, brought within limits.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& posture) const;
  /// The hand of `q`, normalised.
  [[nodiscard]] Eigen::VectorXd hand_of(const Configuration& q) const;

 private:
  void find_fingers();
  void make_preshapes();
  /// Of every finger, in the palm's frame.
  [[nodiscard]] std::vector<Eigen::Vector3d> tips(const Eigen::VectorXd& posture) const;
  [[nodiscard]] Eigen::VectorXd closing_of(const Preshape& shape) const;

  const PlanningProblem& problem_;
  int palm_;
  std::vector<Finger> fingers_;
  std::vector<Preshape> preshapes_;
};

}  // namespace handway::planning
