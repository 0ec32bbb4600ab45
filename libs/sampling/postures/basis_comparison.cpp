#include "handway/sampling/postures/basis_comparison.h"

#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/posture_subspace.h"

#include <Eigen/QR>

#include <algorithm>
#include <string>
#include <vector>

namespace handway::sampling {
namespace {

/// Where each of `joints` is among `others`.
std::vector<Eigen::Index> places_of(const std::vector<std::string>& joints,
                                    const std::vector<std::string>& others, const std::string& of) {
  std::vector<Eigen::Index> places;
  for (const std::string& joint : joints) {
    const auto found = std::ranges::find(others, joint);
    if (found == others.end()) {
      throw geometric::InputError({of, "joints", "no joint \"" + joint + "\"",
                                   "all joints of the basis", "Compare what is of the same hand."});
    }
    places.push_back(found - others.begin());
  }
  return places;
}

/// Orthonormal columns that span what the basis does.
Eigen::MatrixXd span_of(const PmdBasis& basis) {
  if (basis.dimension() == 0) {
    throw geometric::InputError(
        {"basis of " + basis.hand, "directions", "no axis", "one or more", ""});
  }
  const Eigen::MatrixXd axes = box_axes(basis).colwise().normalized();
  return Eigen::HouseholderQR<Eigen::MatrixXd>(axes).householderQ() *
         Eigen::MatrixXd::Identity(axes.rows(), axes.cols());
}

}  // namespace

Eigen::VectorXd angles_between(const PmdBasis& a, const PmdBasis& b) {
  (void)places_of(b.joints, a.joints, "basis of " + a.hand);
  const std::vector<Eigen::Index> order = places_of(a.joints, b.joints, "basis of " + b.hand);
  return principal_angles(span_of(a), span_of(b)(order, Eigen::all));
}

Reconstruction reconstruct(const PmdBasis& basis, const PostureTable& postures) {
  const std::vector<Eigen::Index> order =
      places_of(basis.joints, postures.joints, "postures of " + postures.hand);
  const PostureSubspace subspace(basis);
  const Eigen::MatrixXd rows = postures.postures(Eigen::all, order);
  Eigen::MatrixXd missed(rows.rows(), rows.cols());
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    missed.row(row) = subspace.outside(rows.row(row).transpose()).transpose();
  }
  const double all = (rows.rowwise() - rows.colwise().mean()).squaredNorm();
  Reconstruction result;
  result.rms = (missed.colwise().squaredNorm() / static_cast<double>(rows.rows())).cwiseSqrt();
  result.held = all > 0.0 ? 1.0 - missed.squaredNorm() / all : 1.0;
  return result;
}

}  // namespace handway::sampling
