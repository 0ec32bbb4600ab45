#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/principal_components.h"

#include <Eigen/Core>

#include <vector>

namespace handway::sampling {

/// Principal components of postures that come one by one, such as from a glove in use. Mean and
/// scatter are updated with each posture (Welford 1962; merging: Chan, Golub and LeVeque 1979), so
/// that after n postures the components are those of all n, up to rounding, in memory
/// and time per posture that don't grow. For one thread at a time.
class HANDWAY_SAMPLING_EXPORT IncrementalComponents {
 public:
  /// @param joints length of every posture, ≥ 1.
  /// @throws std::invalid_argument for fewer.
  explicit IncrementalComponents(int joints);

  /// @param posture joints normalised to [0, 1], shape [joints].
  /// @throws std::invalid_argument for another length or a value that isn't finite.
  void add(const Eigen::VectorXd& posture);

  /// As if all postures of `other` had been added too.
  /// @throws std::invalid_argument for another number of joints.
  void merge(const IncrementalComponents& other);

  [[nodiscard]] Eigen::Index count() const { return count_; }

  /// What principal_components() finds for the same postures.
  /// @throws as that function.
  [[nodiscard]] PrincipalComponents components(const std::vector<int>& left_out = {}) const;

 private:
  Eigen::Index count_ = 0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd scatter_;  ///< Σ (x - mean)(x - mean)'.
};

}  // namespace handway::sampling
