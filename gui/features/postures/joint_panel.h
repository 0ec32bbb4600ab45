#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "model/document/joint_groups.h"

#include <QWidget>

#include <memory>
#include <string>
#include <vector>

class QScrollArea;
class QVBoxLayout;

namespace handway::gui {

class SliderRow;

/// A slider for every joint of the first robot, arm and hand apart; coupled
/// joints are shown and follow.
class JointPanel : public QWidget {
  Q_OBJECT

 public:
  explicit JointPanel(QWidget* parent = nullptr);

  /// Null: no robot.
  void set_robot(std::shared_ptr<const geometric::RobotModel> model, const JointGroups& groups);
  /// @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);
  /// Brings the slider of the joint that moves this link into sight, and marks it; of a fixed
  /// link it's the nearest joint before.
  void show_link(const std::string& link);

 signals:
  void configuration_edited(const Eigen::VectorXd& q);

 private:
  void add_group(const QString& title, const std::vector<int>& variables);
  SliderRow* add_row(int link);

  struct Row {
    int link;
    SliderRow* slider;
  };

  std::shared_ptr<const geometric::RobotModel> model_;
  geometric::Configuration q_;
  QScrollArea* scroll_;
  QWidget* content_;
  QVBoxLayout* layout_;
  std::vector<Row> rows_;
};

}  // namespace handway::gui
