#include "handway/sampling/postures/recorded_postures.h"

#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/posture_subspace.h"
#include "postures/quantile.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace handway::sampling {
namespace {

using geometric::InputError;

// The table's columns in the basis' order, one posture a column.
Eigen::MatrixXd in_order_of(const PmdBasis& basis, const PostureTable& table,
                            const std::string& name) {
  if (table.hand != basis.hand) {
    throw InputError({name, "hand", '"' + table.hand + '"',
                      fmt::format("\"{}\", the basis' hand", basis.hand),
                      "Choose postures of the same hand."});
  }
  Eigen::MatrixXd postures(static_cast<Eigen::Index>(basis.joints.size()), table.postures.rows());
  for (Eigen::Index joint = 0; joint < postures.rows(); ++joint) {
    const std::string& wanted = basis.joints[static_cast<std::size_t>(joint)];
    const auto column = std::ranges::find(table.joints, wanted);
    if (column == table.joints.end()) {
      throw InputError({name, wanted, "no such column",
                        fmt::format("the basis' joints {}", fmt::join(basis.joints, ", ")), ""});
    }
    postures.row(joint) = table.postures.col(column - table.joints.begin()).transpose();
  }
  return postures;
}

// The unit vector along which the columns vary most.
Eigen::VectorXd widest_direction(const Eigen::MatrixXd& postures) {
  const Eigen::MatrixXd centred = postures.colwise() - postures.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred * centred.transpose());
  return solver.eigenvectors().rightCols<1>();
}

}  // namespace

RecordedPostures::RecordedPostures(const PmdBasis& basis, const PostureTable& table,
                                   const std::string& name)
    : source_(table.source) {
  constexpr double kUsualShare = 0.95;
  Eigen::MatrixXd postures = in_order_of(basis, table, name);
  if (postures.cols() == 0) {
    throw InputError({name, "", "no rows", "at least one posture", ""});
  }
  const PostureSubspace subspace(basis);
  std::vector<double> distances;
  for (const auto& posture : postures.colwise()) {
    distances.push_back(subspace.distance(posture));
  }
  usual_distance_ = quantile(std::move(distances), kUsualShare);
  for (const FreeJoint& free : basis.free_joints) {
    free_joints_.push_back(free.joint);
    postures.row(free.joint).setZero();
  }
  direction_ = widest_direction(postures);
  const Eigen::VectorXd along = postures.transpose() * direction_;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(postures.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, [&](Eigen::Index column) { return along[column]; });
  postures_ = postures(Eigen::all, order);
  coordinates_.reserve(order.size());
  for (const Eigen::Index column : order) {
    coordinates_.push_back(along[column]);
  }
}

NearestPosture RecordedPostures::nearest(const Eigen::VectorXd& posture) const {
  Eigen::VectorXd wanted = posture;
  for (const int joint : free_joints_) {
    wanted[joint] = 0.0;
  }
  const double coordinate = direction_.dot(wanted);
  auto above = std::ranges::lower_bound(coordinates_, coordinate);
  auto below = above;
  double best = std::numeric_limits<double>::infinity();  // squared
  Eigen::Index found = 0;
  const auto look = [&](std::vector<double>::const_iterator at) {
    const auto column = at - coordinates_.begin();
    const double squared = (postures_.col(column) - wanted).squaredNorm();
    if (squared < best) {
      best = squared;
      found = column;
    }
  };
  const auto near = [&](double other) {
    return (other - coordinate) * (other - coordinate) < best;
  };
  bool more_above = above != coordinates_.end();
  bool more_below = below != coordinates_.begin();
  while (more_above || more_below) {
    if (more_above) {
      look(above++);
      more_above = above != coordinates_.end() && near(*above);
    }
    if (more_below) {
      look(--below);
      more_below = below != coordinates_.begin() && near(*(below - 1));
    }
  }
  NearestPosture result{std::sqrt(best), postures_.col(found)};
  for (const int joint : free_joints_) {
    result.joints[joint] = posture[joint];
  }
  return result;
}

std::shared_ptr<const RecordedPostures> load_recorded_postures(const PmdBasis& basis) {
  return basis.postures.empty() ? nullptr : load_recorded_postures(basis, basis.postures);
}

std::shared_ptr<const RecordedPostures> load_recorded_postures(const PmdBasis& basis,
                                                               const std::filesystem::path& file) {
  return std::make_shared<const RecordedPostures>(basis, read_postures(file), file.string());
}

}  // namespace handway::sampling
