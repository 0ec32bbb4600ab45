#pragma once

#include "handway/report/document/figure.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <array>
#include <filesystem>

namespace handway::tools {

/// Joints that the paper's Fig. 7 plots over each other, with its results.
struct JointPair {
  const char* first;
  const char* second;
  const char* joints;     ///< Their numbers in the paper.
  const char* published;  ///< Sign of their correlation.
};

/// Pairs of the paper's Fig. 7, from the top left.
inline constexpr std::array<JointPair, 6> kPaperJointPairs = {
    {{"middle_proximal", "ring_proximal", "8, 11", "positive"},
     {"index_abduction", "ring_abduction", "4, 10", "negative"},
     {"index_medial", "middle_medial", "6, 9", "positive"},
     {"middle_proximal", "ring_abduction", "8, 10", "positive"},
     {"thumb_base", "index_proximal", "0, 5", "none"},
     {"thumb_base", "ring_medial", "0, 12", "none"}}};

/// Returns Pearson's correlation coefficient of two joints; 0 if one of them doesn't vary.
[[nodiscard]] double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Returns six pairs of joints as scatter plots with their correlation (Fig. 7): those of the paper
/// for a hand with its joints, else those that correlate most. Of many postures evenly chosen ones
/// are drawn; the correlation is of all.
/// @param postures rad, shape [samples, joints of the basis].
[[nodiscard]] report::Figure correlation_figure(const sampling::PmdBasis& basis,
                                                const Eigen::MatrixXd& postures);

/// Returns the variance that the first directions cover together, and each by itself (Fig. 10).
/// @param shares of the variance, in [0, 1], shape [directions].
[[nodiscard]] report::Figure variance_figure(const Eigen::VectorXd& shares);

/// Writes `postures.csv` (rad), `basis.yaml`, `variance.csv` and the plots `correlations.svg` and
/// `variance.svg` to a folder, which is created if missing.
/// @param postures, shares as above.
/// @throws InputError or OutputError if a file can't be written.
void write_basis_plots(const std::filesystem::path& folder, const sampling::PmdBasis& basis,
                       const Eigen::MatrixXd& postures, const Eigen::VectorXd& shares);

}  // namespace handway::tools
