#pragma once

#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/robot/robot_model.h"

#include <QColor>
#include <QString>
#include <QTreeWidget>
#include <QWidget>

#include <memory>
#include <vector>

namespace handway::gui {

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

}  // namespace handway::gui
