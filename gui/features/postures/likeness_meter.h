#pragma once

#include "handway/planning/queries/human_likeness.h"

#include <QWidget>

#include <memory>
#include <optional>
#include <vector>

class QLabel;
class QMenu;
class QPushButton;

namespace handway::gui {

class RecordedHand;

/// A distance in normalised joints: its name, a bar from 0 to kMost, and the number.
class DistanceRow : public QWidget {
 public:
  static constexpr double kMost = 1.0;  ///< Distance at which the bar is full.

  explicit DistanceRow(const QString& name, QWidget* parent = nullptr);

  /// Shows the distance, or a dash if there is none. @param usual is marked on the bar; nothing: no
  /// mark.
  void show_distance(std::optional<double> distance, std::optional<double> usual = std::nullopt);
  [[nodiscard]] QString text() const;

 private:
  class Bar;

  Bar* bar_;
  QLabel* number_;
};

/// Shows the human-likeness of the posed hand: its distances to the subspace of its principal
/// motion directions and to the nearest recorded posture.
class LikenessMeter : public QWidget {
  Q_OBJECT

 public:
  /// @param recorded outlives it.
  explicit LikenessMeter(RecordedHand& recorded, QWidget* parent = nullptr);

  /// @param basis null: there is nothing to compare with, and the meter hides.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model,
                std::shared_ptr<const sampling::PmdBasis> basis, const std::vector<int>& hand);
  void set_configuration(const geometric::Configuration& q);

 signals:
  /// The hand is to go to the nearest recorded posture.
  void configuration_edited(const Eigen::VectorXd& q);

 private:
  void compare();
  void show_distances();
  [[nodiscard]] QMenu* make_choices();
  void ask_for_file();
  [[nodiscard]] QString note_text() const;

  RecordedHand& recorded_;
  std::shared_ptr<const geometric::RobotModel> model_;
  std::shared_ptr<const sampling::PmdBasis> basis_;
  std::vector<int> hand_;
  std::optional<planning::HumanLikeness> likeness_;
  geometric::Configuration q_;
  DistanceRow* to_subspace_;
  DistanceRow* to_recorded_;
  QLabel* note_;
  QPushButton* take_;
  QPushButton* choose_;
};

}  // namespace handway::gui
