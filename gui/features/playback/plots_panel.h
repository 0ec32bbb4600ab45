#pragma once

#include "model/document/document.h"
#include "model/playback/motion_analysis.h"

#include <QColor>
#include <QString>
#include <QTreeWidget>
#include <QWidget>

#include <memory>
#include <string>
#include <vector>

class QComboBox;
class QLabel;
class QPushButton;
class QSplitter;
class QStackedWidget;

namespace handway::gui {

/// Quantities that a plot of a motion can show.
enum class PlotQuantity { kPosition, kVelocity, kAcceleration, kClearance, kUnlikeness };

/// Returns whether there is a curve for every joint, or one for all.
[[nodiscard]] bool is_of_joints(PlotQuantity quantity);

/// Returns the title of the axis with its unit: "velocity, °/s".
[[nodiscard]] QString axis_title(PlotQuantity quantity, bool slides);

/// The unit alone; empty: a pure number. @param slides of a joint that does not turn.
[[nodiscard]] QString unit_of(PlotQuantity quantity, bool slides);

[[nodiscard]] bool slides(const geometric::RobotModel& model, int variable);

/// A joint's position, velocity or acceleration at the motion's points, in degrees or
/// millimetres.
[[nodiscard]] std::vector<double> joint_values(const planning::Motion& motion, int variable,
                                               PlotQuantity quantity);

/// Returns the limits of a joint's values, lowest first.
[[nodiscard]] std::vector<double> joint_limits(const planning::Motion& motion, int variable,
                                               PlotQuantity quantity);

/// A curve as a table's column.
struct PlotColumn {
  std::string name;
  std::vector<double> values;
};

/// Clearance in millimetres, or the hand's distances to the subspace of its principal motion
/// directions and to the recorded postures, those of them that there are.
[[nodiscard]] std::vector<PlotColumn> motion_columns(const MotionCurves& curves,
                                                     PlotQuantity quantity);
/// Returns the title of a column of motion_columns() for display.
[[nodiscard]] QString title_of(const PlotColumn& column);

/// A table with a column for each curve.
[[nodiscard]] std::string csv_of(const std::vector<double>& times,
                                 const std::vector<PlotColumn>& columns);

class CursorPlot;
class Document;
class MotionAnalysis;
class PathPlayer;
class Workbench;

/// The joints of a robot, arm and fingers apart, to choose whose curves are drawn; it is their
/// legend too, with their values where the cursor is.
class JointCurveList : public QTreeWidget {
  Q_OBJECT

 public:
  explicit JointCurveList(QWidget* parent = nullptr);

  /// Sets the robot. The selection of curves is kept for the same robot; for another one it is the
  /// arm.
  void set_robot(std::shared_ptr<const geometric::RobotModel> model,
                 const geometric::JointSelection& joints);
  /// Variables that are chosen, in order.
  [[nodiscard]] std::vector<int> chosen() const;
  void choose(const std::vector<int>& variables);
  /// Returns the colour of a variable's curve.
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
