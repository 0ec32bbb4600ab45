#pragma once

#include "model/planning/query_doctor.h"
#include "widgets/panels/floating_card.h"

#include <memory>
#include <vector>

class QLabel;
class QPushButton;

namespace handway::gui {

/// Floats at the foot of the view while start or goal can't be planned with: says what touches
/// what, how deep and where, and offers the nearest free posture.
class DoctorCard : public FloatingCard {
  Q_OBJECT

 public:
  explicit DoctorCard(QWidget* host);

  /// Shows the first of `ends`; none: hides the card.
  void show_diagnoses(const std::shared_ptr<const geometric::RobotModel>& model,
                      const std::vector<EndDiagnosis>& ends);
  /// What is written on it; empty while it is hidden.
  [[nodiscard]] QString text() const;

 signals:
  /// A click on Show.
  void shown(const Eigen::VectorXd& q);
  /// A click on Use it.
  void accepted(bool is_start, const Eigen::VectorXd& q);

 private:
  void place() override;

  QLabel* picture_;
  QLabel* text_;
  QPushButton* show_;
  QPushButton* use_;
  EndDiagnosis end_;
};

/// One or two sentences about what is wrong, as rich text.
[[nodiscard]] QString diagnosis_text(const geometric::RobotModel& model, const EndDiagnosis& end);

}  // namespace handway::gui
