#pragma once

#include "model/document/joint_groups.h"

#include <QColor>
#include <QTreeWidget>

#include <memory>
#include <vector>

namespace handway::gui {

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

}  // namespace handway::gui
