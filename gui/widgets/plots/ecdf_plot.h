#pragma once

#include "widgets/plots/plot_style.h"

#include <QString>
#include <QWidget>

#include <functional>
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

}  // namespace handway::gui
