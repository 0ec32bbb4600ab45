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

/// Samples as dots, their correlation coefficient above. Of many samples evenly chosen ones are
/// drawn; the coefficient is of all.
/// @pre both have as many values, at least one.
[[nodiscard]] std::unique_ptr<QwtPlot> make_scatter_plot(const PlotVariable& x,
                                                         const PlotVariable& y);

/// Pearson's correlation coefficient; 0 if one of them doesn't vary.
[[nodiscard]] double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

}  // namespace handway::gui
