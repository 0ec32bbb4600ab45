#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace handway::gui {

/// Coverage of the range of one joint, normalised to [0, 1].
struct JointVisits {
  static constexpr int kBins = 25;

  std::string joint;
  bool driven = true;  ///< By a sensor; else it stays where it is.
  std::array<bool, kBins> visited{};
  double least = 1.0;
  double most = 0.0;
  double now = 0.5;

  /// Returns the share of visited bins, in [0, 1].
  [[nodiscard]] double share() const;
  /// Returns the range from least to most; 0 before the first posture.
  [[nodiscard]] double range() const { return most > least ? most - least : 0.0; }
};

/// Coverage of the joints' ranges by the captured postures.
class JointCoverage {
 public:
  /// @param driven whether a sensor drives the joint, shape [joints].
  void restart(const std::vector<std::string>& joints, const std::vector<bool>& driven);

  /// @param posture normalised, shape [joints].
  void add(const Eigen::VectorXd& posture);

  [[nodiscard]] const std::vector<JointVisits>& joints() const { return joints_; }
  /// Returns the mean share of the driven joints; 0 if there are none.
  [[nodiscard]] double share() const;

 private:
  std::vector<JointVisits> joints_;
};

}  // namespace handway::gui
