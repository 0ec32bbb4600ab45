#pragma once

#include <QString>
#include <QWidget>

#include <vector>

class QwtPlot;

namespace handway::gui {

/// A planner's runs in an EcdfPlot.
struct EcdfCurve {
  QString title;
  std::vector<double> times;  ///< s, of the runs that found a path, in any order.
  int runs = 0;               ///< Those without a path too.
};

/// How the share of runs that found a path grows with time, on a logarithmic scale.
class EcdfPlot : public QWidget {
 public:
  explicit EcdfPlot(QWidget* parent = nullptr);

  void set_curves(const std::vector<EcdfCurve>& curves);

 private:
  QwtPlot* plot_;
};

}  // namespace handway::gui
