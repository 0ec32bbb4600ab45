#include "handway/sampling/postures/principal_components.h"

#include "handway/geometric/io/input_error.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace handway::sampling {

namespace {

constexpr double kStill = 1e-9;  // standard deviation of what doesn't vary

// Indices of the joints that aren't left out. Throws std::invalid_argument if left_out names an
// unknown joint, one twice, or all of them.
HandJointIndices joints_taken(Eigen::Index joints, const HandJointIndices& left_out) {
  HandJointIndices columns(static_cast<std::size_t>(joints));
  std::iota(columns.begin(), columns.end(), 0);
  for (const int joint : left_out) {
    if (std::erase(columns, joint) == 0) {
      throw std::invalid_argument("joint " + std::to_string(joint) +
                                  " to leave out is unknown or named twice");
    }
  }
  if (columns.empty()) {
    throw std::invalid_argument("every joint is left out of the principal component analysis");
  }
  return columns;
}

// `direction` or its opposite: the one whose largest entry is positive.
Eigen::VectorXd with_fixed_sign(const Eigen::VectorXd& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0.0 ? Eigen::VectorXd(-direction) : direction;
}

// @param taken joints used. @param variances falling. @param axes a column each, of those joints
// alone.
PrincipalComponents assembled(const Eigen::VectorXd& mean, const HandJointIndices& taken,
                              const Eigen::VectorXd& variances, const Eigen::MatrixXd& axes) {
  const double total = variances.sum();
  PrincipalComponents result{mean, Eigen::MatrixXd::Zero(mean.size(), variances.size()), variances,
                             Eigen::VectorXd::Zero(variances.size())};
  if (total > 0.0) {
    result.shares = variances / total;
  }
  for (Eigen::Index k = 0; k < variances.size(); ++k) {
    result.directions(taken, k) = with_fixed_sign(axes.col(k));
  }
  return result;
}

void check_count(Eigen::Index samples) {
  if (samples < 2) {
    throw geometric::InputError({"postures", "", std::to_string(samples) + " samples", "at least 2",
                                 "Record more postures"});
  }
}

void check_samples(const Eigen::MatrixXd& samples) {
  check_count(samples.rows());
  for (Eigen::Index row = 0; row < samples.rows(); ++row) {
    if (!samples.row(row).allFinite()) {
      throw geometric::InputError({"postures", "sample " + std::to_string(row + 1),
                                   "a value that isn't finite", "numbers", ""});
    }
  }
}

}  // namespace

PrincipalComponents principal_components(const Eigen::MatrixXd& samples,
                                         const HandJointIndices& left_out) {
  check_samples(samples);
  const HandJointIndices columns = joints_taken(samples.cols(), left_out);
  const Eigen::VectorXd mean = samples.colwise().mean();
  const Eigen::MatrixXd centred = (samples.rowwise() - mean.transpose())(Eigen::all, columns);
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeThinV);
  return assembled(mean, columns,
                   svd.singularValues().array().square() / static_cast<double>(samples.rows() - 1),
                   svd.matrixV());
}

PmdBasis make_pmd_basis(std::string hand, std::string source, std::vector<std::string> joints,
                        const PrincipalComponents& components, const PmdBasisOptions& options) {
  const Eigen::Index count = components.mean.size();
  if (static_cast<Eigen::Index>(joints.size()) != count) {
    throw std::invalid_argument(std::to_string(joints.size()) + " joint names for " +
                                std::to_string(count) + " joints");
  }
  if (options.directions < 0 || !(options.sigmas_per_half_side > 0.0)) {
    throw std::invalid_argument("a PMD basis needs no fewer than 0 directions, and sides above 0");
  }
  PmdBasis basis;
  basis.hand = std::move(hand);
  basis.source = std::move(source);
  basis.joints = std::move(joints);
  basis.mean = components.mean;
  for (const int joint : options.free_joints) {
    if (joint < 0 || joint >= count) {
      throw std::invalid_argument("unknown free joint " + std::to_string(joint));
    }
    basis.free_joints.push_back({joint, 0.5, 0.5});
  }
  for (Eigen::Index k = 0; k < components.variances.size() && k < options.directions; ++k) {
    const double sigma = std::sqrt(components.variances[k]);
    if (sigma < kStill) {
      break;
    }
    basis.directions.push_back({"PMD" + std::to_string(k + 1), components.directions.col(k),
                                options.sigmas_per_half_side * sigma, components.variances[k]});
  }
  return basis;
}

IncrementalComponents::IncrementalComponents(int joints) {
  if (joints < 1) {
    throw std::invalid_argument("principal components need a joint");
  }
  mean_ = Eigen::VectorXd::Zero(joints);
  scatter_ = Eigen::MatrixXd::Zero(joints, joints);
}

void IncrementalComponents::add(const Eigen::VectorXd& posture) {
  if (posture.size() != mean_.size() || !posture.allFinite()) {
    throw std::invalid_argument("a posture needs a finite value for every joint");
  }
  ++count_;
  const Eigen::VectorXd before = posture - mean_;
  mean_ += before / static_cast<double>(count_);
  scatter_ += before * (posture - mean_).transpose();
}

void IncrementalComponents::add(const IncrementalComponents& other) {
  if (other.mean_.size() != mean_.size()) {
    throw std::invalid_argument("components of hands with different numbers of joints");
  }
  if (other.count_ == 0) {
    return;
  }
  const auto before = static_cast<double>(count_);
  const auto more = static_cast<double>(other.count_);
  const Eigen::VectorXd apart = other.mean_ - mean_;
  count_ += other.count_;
  mean_ += apart * (more / (before + more));
  scatter_ += other.scatter_ + apart * apart.transpose() * (before * more / (before + more));
}

PrincipalComponents IncrementalComponents::components(const HandJointIndices& left_out) const {
  check_count(count_);
  const HandJointIndices taken = joints_taken(mean_.size(), left_out);
  const Eigen::MatrixXd scatter = scatter_(taken, taken);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 *
                                                              (scatter + scatter.transpose()));
  const Eigen::Index size = std::min(count_, solver.eigenvalues().size());
  return assembled(
      mean_, taken,
      solver.eigenvalues().reverse().head(size).cwiseMax(0.0) / static_cast<double>(count_ - 1),
      solver.eigenvectors().rowwise().reverse());
}

namespace {

constexpr double kMedianToDeviation = 1.4826;  // factor for a normal distribution
constexpr int kMostSteps = 100;
constexpr double kKept = 0.975;  // quantile of χ²

using Rows = std::vector<Eigen::Index>;

double median(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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
  const boost::math::chi_squared usual(
      static_cast<double>(std::max<Eigen::Index>(distances.freedom, 1)));
  const double scale = median(distances.squares) / boost::math::median(usual);
  const double limit = scale * boost::math::quantile(usual, kKept);
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
                                             const HandJointIndices& left_out) {
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
