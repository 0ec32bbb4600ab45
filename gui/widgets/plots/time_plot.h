#pragma once

#include <QColor>
#include <QString>
#include <QWidget>

#include <vector>

class QwtPlot;
class QwtPlotCurve;

namespace handway::gui {

/// Curves over time. Those that stand above each other have their times in line.
class TimePlot : public QWidget {
 public:
  /// @param x_title may be empty, for one that stands above another.
  TimePlot(const QString& x_title, const QString& y_title, QWidget* parent = nullptr);

  /// @returns its index.
  int add_curve(const QString& title, const QColor& color, bool dashed = false);
  void show_legend();
  /// Takes all curves away.
  void clear();
  /// @param times s. @param values as many.
  void set_curve(int index, const std::vector<double>& times, const std::vector<double>& values);
  /// Draws what was set.
  void refresh();

 private:
  QwtPlot* plot_;
  std::vector<QwtPlotCurve*> curves_;
};

}  // namespace handway::gui
