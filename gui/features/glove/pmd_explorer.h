#pragma once

#include "features/glove/captured_postures.h"
#include "features/glove/hand_axes.h"

#include <QWidget>

#include <memory>

class QComboBox;
class QLabel;

namespace handway::gui {

class CorrelationMap;
class PmdPad;
class VarianceChart;

/// Explores a hand along its principal motion directions: two axes as a pad to drag in, the
/// postures that were captured or recorded as dots, what the directions hold of the
/// variance, and which joints go together.
class PmdExplorer : public QWidget {
  Q_OBJECT

 public:
  explicit PmdExplorer(QWidget* parent = nullptr);

  /// @param basis of the scene; may be null.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model,
                std::shared_ptr<const sampling::PmdBasis> basis);
  /// Where the hand is. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);
  /// What has been captured or recorded. @param source for people.
  void show_postures(const CapturedPostures& postures, const QString& source);

 signals:
  void posture_changed(const handway::geometric::NamedPosture& posture);
  void recording_requested();
  /// Show the live postures again.
  void live_requested();

 private:
  void rebuild_axes();
  void choose_axes();
  void show_dots();
  void show_statistics();
  void move_hand(const QPointF& coordinates);
  [[nodiscard]] bool uses_scene_basis() const;

  std::shared_ptr<const geometric::RobotModel> model_;
  std::shared_ptr<const sampling::PmdBasis> scene_basis_;
  CapturedPostures postures_;
  HandAxes axes_;
  geometric::Configuration q_;
  QComboBox* source_;
  QComboBox* basis_;
  QComboBox* across_;
  QComboBox* up_;
  PmdPad* pad_;
  VarianceChart* variance_;
  CorrelationMap* correlation_;
  QLabel* note_;
  bool moving_ = false;  ///< The change that arrives is this widget's own.
};

}  // namespace handway::gui
