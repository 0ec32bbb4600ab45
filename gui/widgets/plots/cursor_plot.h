#pragma once

#include "widgets/plots/plot_style.h"

#include <QColor>
#include <QPoint>
#include <QString>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

class QwtPlot;
class QwtPlotCurve;

namespace handway::gui {

/// A curve over time.
struct PlotLine {
  QString title;
  QColor color;
  bool dashed = false;
  std::vector<double> values;  ///< One for each time.
  std::vector<double> limits;  ///< Values at which faint lines are drawn.
};

/// Curves over time with a cursor: a click or a drag puts it elsewhere, the wheel zooms in time
/// (with Ctrl in values), the middle or right button moves, a double click shows all.
class CursorPlot : public QWidget {
 public:
  explicit CursorPlot(QWidget* parent = nullptr);

  void set_colors(const PlotColors& colors, const QColor& cursor);
  void set_titles(const QString& x, const QString& y);
  /// Sets the curves to draw; keeps the visible range. @param times s, rising.
  void set_lines(std::vector<double> times, std::vector<PlotLine> lines);
  /// Times (s) of ticks along the upper edge.
  void set_marks(std::vector<double> times);
  void set_cursor(double time);
  [[nodiscard]] double cursor() const { return time_; }
  void show_all();

  /// Sets the function that is called with the time (s) at which the mouse puts the cursor.
  void on_scrub(std::function<void(double)> scrub) { scrub_ = std::move(scrub); }
  /// Returns the visible range of time, s.
  [[nodiscard]] std::pair<double, double> span() const;
  /// Returns the position in the widget of a time (s), in the middle of the canvas.
  [[nodiscard]] QPoint place_of(double time) const;
  [[nodiscard]] QWidget* canvas() const;

  /// Writes the plot as it is in sight, with a legend, as `.svg` or PNG.
  /// @throws geometric::InputError if the file can't be written.
  void write(const QString& file, const QString& title) const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Range {
    double least;
    double most;
  };

  void fill(QwtPlot& plot, bool for_print) const;
  void rebuild();
  void place_cursor();
  void zoom(int axis, double factor, int pixel);
  void move_by(const QPoint& pixels);
  [[nodiscard]] Range range(int axis) const;
  void set_range(int axis, Range range);

  QwtPlot* plot_;
  QWidget* line_;  ///< The cursor.
  PlotColors colors_;
  std::vector<double> times_;
  std::vector<PlotLine> lines_;
  std::vector<double> marks_;
  double time_ = 0.0;
  std::optional<Range> x_;  ///< In sight, if not all.
  std::optional<Range> y_;
  QPoint last_;
  std::function<void(double)> scrub_;
};

/// Plot of curves over time. Plots above each other have aligned time axes.
class TimePlot : public QWidget {
 public:
  /// @param x_title may be empty, for one that stands above another.
  TimePlot(const QString& x_title, const QString& y_title, QWidget* parent = nullptr);

  /// @returns its index.
  int add_curve(const QString& title, const QColor& color, bool dashed = false);
  void show_legend();
  /// Sets the colours, in place of those of a printed figure.
  void set_colors(const PlotColors& colors);
  /// Removes all curves.
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
