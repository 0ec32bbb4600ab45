#pragma once

#include "handway/sampling/postures/principal_components.h"

#include <Eigen/Core>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// The postures that a hand took while it was captured, normalised to [0, 1] per joint, and
/// whether the subspace of their principal motion directions still turns.
class CapturedPostures {
 public:
  static constexpr double kWindow = 10.0;                ///< s, between the subspaces compared.
  static constexpr double kSettledAngle = 0.0872664626;  ///< rad, 5°.
  static constexpr double kLeastTime = 30.0;             ///< s, before it can have settled.

  CapturedPostures() = default;
  /// @param joints names, in the postures' order.
  /// @param left_out joints that take no part in the principal components.
  CapturedPostures(std::vector<std::string> joints, std::vector<int> left_out);

  /// @param time s, never falling.
  /// @param posture shape [joints].
  void add(double time, const Eigen::VectorXd& posture);

  [[nodiscard]] const std::vector<std::string>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<int>& left_out() const { return left_out_; }
  [[nodiscard]] Eigen::Index count() const { return count_; }
  /// Returns the time from the first posture to the last, s.
  [[nodiscard]] double duration() const { return last_time_ - first_time_; }
  /// Returns evenly chosen ones of all that were added, at most some thousand.
  [[nodiscard]] const std::vector<Eigen::VectorXd>& samples() const { return samples_; }
  /// Returns the samples as rows, shape [samples, joints].
  [[nodiscard]] Eigen::MatrixXd table() const;

  /// Returns the components of all postures. @throws geometric::InputError if there are fewer than
  /// two.
  [[nodiscard]] sampling::PrincipalComponents components() const { return components(left_out_); }
  /// Returns the components with other joints left out.
  [[nodiscard]] sampling::PrincipalComponents components(const std::vector<int>& left_out) const;
  /// Correlation of every pair of joints; 0 where one does not vary. Shape [joints, joints].
  /// @throws as components().
  [[nodiscard]] Eigen::MatrixXd correlations() const;

  /// Largest angle by which the subspace of the directions that hold three quarters of the
  /// variance has turned within the last kWindow, rad; nothing if it is too early to tell.
  [[nodiscard]] std::optional<double> turn() const { return turn_; }
  [[nodiscard]] bool has_settled() const;

 private:
  struct Subspace {
    double time;
    Eigen::MatrixXd directions;
  };

  void keep(const Eigen::VectorXd& posture);
  void compare(double time);

  std::vector<std::string> joints_;
  std::vector<int> left_out_;
  std::optional<sampling::IncrementalComponents> components_;
  Eigen::Index count_ = 0;
  double first_time_ = 0.0;
  double last_time_ = 0.0;
  std::vector<Eigen::VectorXd> samples_;
  Eigen::Index stride_ = 1;  ///< One of so many postures is kept.
  std::deque<Subspace> subspaces_;
  std::optional<double> turn_;
};

}  // namespace handway::gui
