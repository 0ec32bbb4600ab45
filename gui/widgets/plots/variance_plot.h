#pragma once

#include <Eigen/Core>

#include <memory>

class QwtPlot;

namespace handway::gui {

/// How much of the variance the first principal directions cover together (line), and each by
/// itself (bars). @param shares of each direction, in [0, 1], falling, shape [directions].
[[nodiscard]] std::unique_ptr<QwtPlot> make_variance_plot(const Eigen::VectorXd& shares);

}  // namespace handway::gui
