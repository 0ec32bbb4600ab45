#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/planning/core/planning_problem.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace handway::sampling {
class RandomStream;
}

namespace handway::planning {

[[nodiscard]] bool has_directions(const PlanningProblem& problem);

/// The point of a box that is nearest to another one, in the box's frame.
[[nodiscard]] Eigen::Vector3d nearest_in(const geometric::Aabb& box, const Eigen::Vector3d& p);

/// Opened preshapes of a problem's hand, drawn from its PMD box or else from its joints' ranges,
/// and how its fingers close.
class HandClosing {
 public:
  static constexpr double kLeastOpening = 0.04;  ///< m, of a preshape.

  /// An opened hand, seen from its palm: a thumb against fingers side by side. Lengths in m.
  struct Preshape {
    Eigen::VectorXd open;  ///< Normalised joints in the basis' order.
    /// Between the ends of the thumb and of the others.
    Eigen::Vector3d grip = Eigen::Vector3d::Zero();
    /// From the thumb to the others; of length 1.
    Eigen::Vector3d opposition = Eigen::Vector3d::Zero();
    /// Along the others' tips, square to it; of length 1.
    Eigen::Vector3d row = Eigen::Vector3d::Zero();
    double opening = 0.0;  ///< From the thumb's tip to the others.
  };
  /// A finger as far as closing needs it.
  struct Finger {
    std::vector<int> joints;  ///< Indices in the basis' order, the nearest to the palm first.
    geometric::LinkIndices links;
    int tip = -1;                                      ///< The link of the fingertip.
    Eigen::Vector3d p_LTip = Eigen::Vector3d::Zero();  ///< The tip's middle, in its frame.
    Eigen::Vector3d p_LEnd =
        Eigen::Vector3d::Zero();  ///< Its end, as far from the joint as it goes.
  };

  /// @param problem must outlive this object.
  explicit HandClosing(const PlanningProblem& problem);

  [[nodiscard]] bool opens() const { return !preshapes_.empty(); }
  /// m; of a hand that opens.
  [[nodiscard]] double widest() const { return preshapes_.back().opening; }
  /// Preshapes that are opened to a width (m) or a little wider.
  [[nodiscard]] std::span<const Preshape> opened_to(double width) const;
  [[nodiscard]] const std::vector<Finger>& fingers() const { return fingers_; }

  /// `q` with the hand in `posture`, brought within limits.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& posture) const;

  /// The hand of `q`, normalised.
  [[nodiscard]] Eigen::VectorXd hand_of(const Configuration& q) const;

  /// The middle of a finger's tip in the palm's frame, m.
  [[nodiscard]] Eigen::Vector3d tip_in_palm(const Finger& finger, const Configuration& q) const;

  /// Direction of a finger's joints that brings its tip closer to a box: shape [joints of the
  /// finger], of length 1, or zero where none does.
  /// @param box m, in a frame O. @param X_PO that frame in the palm's.
  [[nodiscard]] Eigen::VectorXd towards(const Finger& finger, const Eigen::VectorXd& posture,
                                        const geometric::Aabb& box,
                                        const geometric::Pose& X_PO) const;

 private:
  [[nodiscard]] Finger closing_finger(const geometric::HandFinger& found) const;
  [[nodiscard]] std::vector<geometric::Pose> link_poses(const Eigen::VectorXd& posture) const;
  [[nodiscard]] geometric::Pose tip_link(const Finger& finger,
                                         const std::vector<geometric::Pose>& X_BL) const;
  [[nodiscard]] std::optional<Preshape> preshape(Eigen::VectorXd open) const;
  [[nodiscard]] Eigen::VectorXd drawn_posture(sampling::RandomStream& random) const;
  void make_preshapes();

  const PlanningProblem& problem_;
  int palm_;
  std::vector<Finger> fingers_;
  std::vector<Preshape> preshapes_;
};

}  // namespace handway::planning
