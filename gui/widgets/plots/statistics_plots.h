#pragma once

#include <QString>

#include <Eigen/Core>

#include <memory>

class QwtPlot;

namespace handway::gui {

/// One variable of a scatter plot.
struct PlotVariable {
  QString title;           ///< With its unit.
  Eigen::VectorXd values;  ///< Shape [samples].
};

/// Makes a plot of samples as dots, with their correlation coefficient above. Of many samples
/// evenly chosen ones are drawn; the coefficient is of all. @pre both have as many values, at least
/// one.
[[nodiscard]] std::unique_ptr<QwtPlot> make_scatter_plot(const PlotVariable& x,
                                                         const PlotVariable& y);

/// Pearson's correlation coefficient; 0 if one of them doesn't vary.
[[nodiscard]] double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Makes a plot of the variance that the first principal directions explain together (line), and
/// each by itself (bars). @param shares of each direction, in [0, 1], falling, shape [directions].
[[nodiscard]] std::unique_ptr<QwtPlot> make_variance_plot(const Eigen::VectorXd& shares);

}  // namespace handway::gui
