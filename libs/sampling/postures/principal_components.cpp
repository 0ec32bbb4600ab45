#include "handway/sampling/postures/principal_components.h"

#include "handway/geometric/io/input_error.h"
#include "joint_selection.h"

#include <Eigen/SVD>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace handway::sampling {
namespace {

constexpr double kStill = 1e-9;  // standard deviation of a direction that doesn't vary

void check_samples(const Eigen::MatrixXd& samples) {
  if (samples.rows() < 2) {
    throw geometric::InputError({"postures", "", std::to_string(samples.rows()) + " samples",
                                 "at least 2", "Record more postures"});
  }
  for (Eigen::Index row = 0; row < samples.rows(); ++row) {
    if (!samples.row(row).allFinite()) {
      throw geometric::InputError({"postures", "sample " + std::to_string(row + 1),
                                   "a value that isn't finite", "numbers", ""});
    }
  }
}

}  // namespace

PrincipalComponents principal_components(const Eigen::MatrixXd& samples,
                                         const std::vector<int>& left_out) {
  check_samples(samples);
  const std::vector<int> columns = joints_taken(samples.cols(), left_out);
  PrincipalComponents result;
  result.mean = samples.colwise().mean();
  const Eigen::MatrixXd centred =
      (samples.rowwise() - result.mean.transpose())(Eigen::all, columns);
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeThinV);

  result.variances =
      svd.singularValues().array().square() / static_cast<double>(samples.rows() - 1);
  result.shares = shares_of(result.variances);
  result.directions = Eigen::MatrixXd::Zero(samples.cols(), result.variances.size());
  for (Eigen::Index k = 0; k < result.variances.size(); ++k) {
    result.directions(columns, k) = with_fixed_sign(svd.matrixV().col(k));
  }
  return result;
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

}  // namespace handway::sampling
