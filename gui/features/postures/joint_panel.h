#pragma once

#include "handway/geometric/robot/joint_selection.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "model/document/document.h"

#include <QWidget>

#include <memory>
#include <string>
#include <vector>

class QVBoxLayout;

class QLabel;
class QPushButton;

namespace handway::gui {

class PanelArea;
class SliderRow;

/// A slider for every joint of the first robot, arm and hand apart; coupled
/// joints are shown and follow.
class JointPanel : public QWidget {
  Q_OBJECT

 public:
  explicit JointPanel(QWidget* parent = nullptr);

  /// Sets the robot; null: none.
  void set_robot(std::shared_ptr<const geometric::RobotModel> model,
                 const geometric::JointSelection& joints);
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
  PanelArea* scroll_;
  QWidget* content_;
  QVBoxLayout* layout_;
  std::vector<Row> rows_;
};

class LikenessMeter;
class RecordedHand;

/// Moves the hand along the axes of its PMD basis: free joints and principal
/// motion directions, each over [-λ, λ]; and says how human its posture is.
class PmdPanel : public QWidget {
  Q_OBJECT

 public:
  /// @param recorded outlives it.
  explicit PmdPanel(RecordedHand& recorded, QWidget* parent = nullptr);

  /// @param basis null: the hand has none.
  /// @param hand variables of the basis' joints, in its order.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model,
                std::shared_ptr<const sampling::PmdBasis> basis, const std::vector<int>& hand);
  /// Shows where the hand's posture lies. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);

 signals:
  void configuration_edited(const Eigen::VectorXd& q);
  /// The hand is to get a basis, or another one.
  void basis_wanted();

 private:
  void add_axis(const QString& name, double half_side, double variance);
  void move_hand();
  [[nodiscard]] Eigen::VectorXd hand_posture() const;

  std::shared_ptr<const geometric::RobotModel> model_;
  std::shared_ptr<const sampling::PmdBasis> basis_;
  std::vector<int> hand_;
  geometric::Configuration q_;
  QWidget* axes_;
  QVBoxLayout* axes_layout_;
  QLabel* note_;
  QPushButton* choose_;
  LikenessMeter* likeness_;
  std::vector<SliderRow*> rows_;
  bool moving_ = false;  ///< The change that arrives is this panel's own.
};

}  // namespace handway::gui
