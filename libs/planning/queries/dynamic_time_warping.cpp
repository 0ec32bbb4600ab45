#include "handway/planning/queries/dynamic_time_warping.h"

#include "handway/sampling/postures/quantile.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace handway::planning {
namespace {

constexpr std::size_t kMostComparedMotions = 40;

}  // namespace

double warped_distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() == 0 || b.rows() == 0 || a.cols() != b.cols()) {
    throw std::invalid_argument("motions to compare need points of the same joints");
  }
  constexpr double kNone = std::numeric_limits<double>::infinity();
  // Least sums up to each point of b, for the last and for this point of a.
  Eigen::VectorXd last = Eigen::VectorXd::Constant(b.rows() + 1, kNone);
  Eigen::VectorXd here = last;
  last[0] = 0.0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const Eigen::VectorXd distances = (b.rowwise() - a.row(i)).rowwise().norm();
    here[0] = kNone;
    for (Eigen::Index j = 0; j < b.rows(); ++j) {
      here[j + 1] = std::min(
          {last[j + 1] + distances[j], here[j] + distances[j], last[j] + 2.0 * distances[j]});
    }
    std::swap(last, here);
  }
  return last[b.rows()] / static_cast<double>(a.rows() + b.rows());
}

std::optional<MotionSpread> motion_spread(const std::vector<Eigen::MatrixXd>& motions) {
  MotionSpread spread{std::min(motions.size(), kMostComparedMotions), 0.0, 0.0};
  if (spread.motions < 2) {
    return std::nullopt;
  }
  std::vector<double> distances;
  for (std::size_t i = 0; i < spread.motions; ++i) {
    for (std::size_t j = i + 1; j < spread.motions; ++j) {
      distances.push_back(warped_distance(motions[i], motions[j]));
    }
  }
  spread.largest = *std::ranges::max_element(distances);
  spread.median = sampling::quantile_of(std::move(distances), 0.5);
  return spread;
}

}  // namespace handway::planning
