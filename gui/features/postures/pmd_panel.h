#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <QWidget>

#include <memory>
#include <vector>

class QLabel;
class QVBoxLayout;

namespace handway::gui {

class LikenessMeter;
class RecordedHand;
class SliderRow;

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
  LikenessMeter* likeness_;
  std::vector<SliderRow*> rows_;
  bool moving_ = false;  ///< The change that arrives is this panel's own.
};

}  // namespace handway::gui
