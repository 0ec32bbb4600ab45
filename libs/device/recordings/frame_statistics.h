#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace handway::device {

/// Statistics of rows of numbers, column by column, which can be merged.
class FrameStatistics {
 public:
  FrameStatistics() = default;
  /// @param rows at least one.
  explicit FrameStatistics(const Eigen::MatrixXd& rows);

  /// Adds the rows of other statistics. @pre they have the same columns, or there is no row yet.
  void merge(const FrameStatistics& other);

  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] const Eigen::RowVectorXd& least() const { return least_; }
  [[nodiscard]] const Eigen::RowVectorXd& most() const { return most_; }
  [[nodiscard]] const Eigen::RowVectorXd& mean() const { return mean_; }
  /// Returns the standard deviation, with the number of rows as divisor.
  [[nodiscard]] Eigen::RowVectorXd deviation() const;

 private:
  std::int64_t count_ = 0;
  Eigen::RowVectorXd least_;
  Eigen::RowVectorXd most_;
  Eigen::RowVectorXd mean_;
  Eigen::RowVectorXd squares_;  ///< Sums of squared distances from the mean.
};

}  // namespace handway::device
