#pragma once

#include "widgets/plots/figure_file.h"

#include <QString>
#include <QWidget>

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

class QwtPlot;

namespace handway::gui {

/// A planner's runs in an EcdfPlot.
struct EcdfCurve {
  QString title;
  std::vector<double> times;  ///< s, of the runs that found a path, in any order.
  int runs = 0;               ///< Includes runs without a path.
};

/// Plot of the share of runs that found a path over time, on a logarithmic scale.
class EcdfPlot : public QWidget {
 public:
  explicit EcdfPlot(QWidget* parent = nullptr);

  void set_curves(const std::vector<EcdfCurve>& curves);
  /// Sets the colours, in place of those of a printed figure. @param on_paper what a curve's colour
  /// becomes there, for curves that are set from here on.
  void set_colors(const PlotColors& colors, std::function<QColor(const QColor&)> on_paper);

 private:
  QwtPlot* plot_;
  std::function<QColor(const QColor&)> on_paper_;
};

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
