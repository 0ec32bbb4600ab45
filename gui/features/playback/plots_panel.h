#pragma once

#include "features/playback/plot_quantity.h"
#include "model/document/joint_groups.h"

#include <QColor>
#include <QTreeWidget>
#include <QWidget>

#include <memory>
#include <vector>

class QComboBox;
class QLabel;
class QPushButton;
class QSplitter;
class QStackedWidget;

namespace handway::gui {

class CursorPlot;
class Document;
class MotionAnalysis;
class PathPlayer;

/// The joints of a robot, arm and fingers apart, to choose whose curves are drawn; it is their
/// legend too, with their values where the cursor is.
class JointCurveList : public QTreeWidget {
  Q_OBJECT

 public:
  explicit JointCurveList(QWidget* parent = nullptr);

  /// The same robot keeps what was chosen; of another the arm is.
  void set_robot(std::shared_ptr<const geometric::RobotModel> model, const JointGroups& groups);
  /// Variables that are chosen, in order.
  [[nodiscard]] std::vector<int> chosen() const;
  void choose(const std::vector<int>& variables);
  /// How a variable's curve is drawn.
  [[nodiscard]] static QColor color_of(int variable);
  [[nodiscard]] static bool is_dashed(int variable);
  /// @param texts shape [variable_count].
  void show_values(const std::vector<QString>& texts);

 signals:
  void choice_changed();

 private:
  QTreeWidgetItem* add_group(const std::vector<int>& variables, const QString& name);

  std::shared_ptr<const geometric::RobotModel> model_;
  std::vector<QTreeWidgetItem*> items_;  ///< One for each variable.
};

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
  void changeEvent(QEvent* event) override;

 private:
  [[nodiscard]] QWidget* make_top();
  [[nodiscard]] PlotQuantity quantity() const;
  void refresh_colors();
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
  std::vector<std::vector<double>> values_;  ///< Of each of them; empty: no curves of joints.
  std::vector<PlotColumn> columns_;          ///< Curves that are not of joints.
};

}  // namespace handway::gui
