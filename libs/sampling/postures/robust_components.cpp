#include "handway/sampling/postures/robust_components.h"

#include "joint_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace handway::sampling {
namespace {

constexpr double kStill = 1e-9;                // standard deviation of what doesn't vary
constexpr double kMedianToDeviation = 1.4826;  // of a normal distribution
constexpr int kMostSteps = 100;
constexpr double kNormal975 = 1.959964;  // 97.5 % quantile of the normal distribution

using Rows = std::vector<Eigen::Index>;

double median(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Quantile of χ² with so many degrees of freedom (Wilson and Hilferty 1931).
double chi_squared(double freedom, double normal_quantile) {
  const double part = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - part + normal_quantile * std::sqrt(part), 3);
}

// The rows with the smallest distances, sorted.
Rows nearest(const Eigen::VectorXd& distances, Eigen::Index count) {
  Rows rows(static_cast<std::size_t>(distances.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::ranges::nth_element(rows, rows.begin() + count - 1, {},
                           [&](Eigen::Index row) { return std::pair(distances[row], row); });
  rows.resize(static_cast<std::size_t>(count));
  std::ranges::sort(rows);
  return rows;
}

Eigen::VectorXd median_distances(const Eigen::MatrixXd& samples) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(samples.rows());
  for (Eigen::Index j = 0; j < samples.cols(); ++j) {
    const Eigen::VectorXd off = (samples.col(j).array() - median(samples.col(j))).abs();
    const double deviation = kMedianToDeviation * median(off);
    if (deviation > kStill) {
      squares += (off / deviation).cwiseAbs2();
    }
  }
  return squares;
}

struct Distances {
  Eigen::VectorXd squares;   ///< Mahalanobis distances squared.
  Eigen::Index freedom = 0;  ///< Directions that vary.
};

Distances mahalanobis(const Eigen::MatrixXd& samples, const Rows& rows) {
  const PrincipalComponents of_rows = principal_components(samples(rows, Eigen::all));
  Distances result;
  result.squares = Eigen::VectorXd::Zero(samples.rows());
  const Eigen::MatrixXd along = (samples.rowwise() - of_rows.mean.transpose()) * of_rows.directions;
  for (Eigen::Index k = 0; k < of_rows.variances.size(); ++k) {
    if (std::sqrt(of_rows.variances[k]) > kStill) {
      result.squares += along.col(k).cwiseAbs2() / of_rows.variances[k];
      ++result.freedom;
    }
  }
  return result;
}

Rows within_quantile(const Distances& distances) {
  const auto freedom = static_cast<double>(std::max<Eigen::Index>(distances.freedom, 1));
  const double scale = median(distances.squares) / chi_squared(freedom, 0.0);
  const double limit = scale * chi_squared(freedom, kNormal975);
  Rows rows;
  for (Eigen::Index row = 0; row < distances.squares.size(); ++row) {
    if (distances.squares[row] <= limit) {
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

RobustComponents robust_principal_components(const Eigen::MatrixXd& samples,
                                             const std::vector<int>& left_out) {
  RobustComponents result;
  result.components = principal_components(samples, left_out);  // checks the samples
  const Eigen::MatrixXd taken = samples(Eigen::all, joints_taken(samples.cols(), left_out));
  const Eigen::Index half = std::max<Eigen::Index>(2, (samples.rows() + 1) / 2);
  const Eigen::Index most = std::max<Eigen::Index>(half, (3 * samples.rows() + 3) / 4);
  Rows rows = nearest(median_distances(taken), half);
  Distances distances = mahalanobis(taken, rows);
  for (int step = 0; step < kMostSteps; ++step) {
    Rows next = nearest(distances.squares, most);
    if (next == rows) {
      break;
    }
    rows = std::move(next);
    distances = mahalanobis(taken, rows);
  }
  rows = within_quantile(distances);
  result.kept.assign(static_cast<std::size_t>(samples.rows()), false);
  for (const Eigen::Index row : rows) {
    result.kept[static_cast<std::size_t>(row)] = true;
  }
  result.outliers = samples.rows() - static_cast<Eigen::Index>(rows.size());
  if (result.outliers > 0) {
    result.components = principal_components(samples(rows, Eigen::all), left_out);
  }
  return result;
}

}  // namespace handway::sampling
