#pragma once

#include "handway/planning/queries/palm_ik.h"

#include <QWidget>

#include <memory>
#include <vector>

class QLabel;

namespace handway::gui {

class SliderRow;

/// Shows the arm's manipulability and reach and, for a redundant arm, a
/// slider that swings its elbow while the palm stays: jogging in the null
/// space.
class ElbowSwing : public QWidget {
  Q_OBJECT

 public:
  explicit ElbowSwing(QWidget* parent = nullptr);

  /// @param model null: no robot. @param arm variables.
  void set_arm(const std::shared_ptr<const geometric::RobotModel>& model, int palm,
               const std::vector<int>& arm);
  /// @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);

 signals:
  void configuration_edited(const Eigen::VectorXd& q);

 private:
  void swing(double to);
  void show_figures();

  std::shared_ptr<const geometric::RobotModel> model_;
  int palm_ = 0;
  std::vector<int> arm_;
  std::unique_ptr<const planning::PalmIk> ik_;  ///< Null: the arm can't swing.
  geometric::Configuration q_;
  geometric::Pose X_BP_ = geometric::Pose::Identity();  ///< Pose of the palm during the swing.
  Eigen::VectorXd direction_;                           ///< Null-space direction; empty: none.
  double swung_ = 0.0;                                  ///< rad
  SliderRow* slider_;
  QLabel* figures_;
  bool swinging_ = false;  ///< The change that arrives is this widget's own.
};

}  // namespace handway::gui
