#pragma once

#include "features/playback/plot_columns.h"
#include "model/document/document.h"
#include "model/playback/motion_analysis.h"

#include <QString>
#include <QWidget>

#include <vector>

class QComboBox;
class QLabel;
class QPushButton;
class QSplitter;
class QStackedWidget;

namespace handway::gui {

class CursorPlot;
class Document;
class JointCurveList;
class MotionAnalysis;
class PathPlayer;
class Workbench;

/// Curves of the path that is played, over time, with a cursor that is where the playback is.
class PlotsPanel : public QWidget {
  Q_OBJECT

 public:
  /// All outlive it.
  PlotsPanel(Document& document, PathPlayer& player, MotionAnalysis& analysis,
             QWidget* parent = nullptr);

  [[nodiscard]] QSize sizeHint() const override { return {640, 250}; }
  void show_quantity(PlotQuantity quantity);
  [[nodiscard]] CursorPlot& plot() const { return *plot_; }
  [[nodiscard]] JointCurveList& joints() const { return *joints_; }
  /// Writes what is drawn: .png, .svg or .csv. @throws geometric::InputError
  void write(const QString& file) const;

 signals:
  void exported(const QString& file);
  void failed(const QString& title, const QString& message);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  [[nodiscard]] QWidget* make_top();
  [[nodiscard]] PlotQuantity quantity() const;
  void take_analysis();
  void draw();
  void show_cursor();
  void ask_for_file();
  [[nodiscard]] std::size_t point_at_cursor() const;
  [[nodiscard]] QString value_text(std::size_t point) const;

  Document& document_;
  PathPlayer& player_;
  MotionAnalysis& analysis_;
  QComboBox* quantities_;
  QLabel* value_;
  QPushButton* export_;
  QPushButton* all_;
  QStackedWidget* middle_;
  QLabel* note_;
  QSplitter* curves_;
  JointCurveList* joints_;
  CursorPlot* plot_;
  std::vector<double> times_;
  std::vector<int> drawn_;                   ///< Variables with a curve.
  std::vector<std::vector<double>> values_;  ///< Values of each; empty: no curves of joints.
  std::vector<PlotColumn> columns_;          ///< Curves that are not of joints.
};

/// Adds the plots below the view, and what the path leaves in the view to the playback bar.
void add_playback(Workbench& workbench);

}  // namespace handway::gui
