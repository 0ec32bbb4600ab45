#pragma once

#include "features/glove/captured_postures.h"
#include "features/glove/finger_combinations.h"
#include "features/glove/joint_coverage.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"

#include <QStringList>
#include <QWidget>

#include <Eigen/Core>

#include <string>
#include <vector>

class QLabel;
class QProgressBar;
class QPushButton;

namespace handway::gui {

class CombinationSquares;
class CoverageBars;

/// Tells the person while the hand is captured how much of its workspace was visited, what to do
/// next, and when it is enough.
class CaptureCoach : public QWidget {
  Q_OBJECT

 public:
  explicit CaptureCoach(QWidget* parent = nullptr);

  /// Starts again with these joints.
  void restart(const device::HandMapping& mapping, const std::vector<std::string>& joints,
               const std::vector<bool>& driven);
  /// @param posture normalised, shape [joints]. @param angles that it was made from.
  /// @param ranges of the person.
  void add(const Eigen::VectorXd& posture, const device::GloveAngles& angles,
           const device::PersonRanges& ranges);
  /// Shows what was added since the last time.
  void show_progress(const CapturedPostures& postures);

  [[nodiscard]] const JointCoverage& coverage() const { return coverage_; }
  [[nodiscard]] const FingerCombinations& combinations() const { return combinations_; }
  [[nodiscard]] QStringList hints() const { return hints_; }
  /// Returns the coach's advice on continuing or stopping.
  [[nodiscard]] QString advice() const;

 signals:
  void restart_requested();

 private:
  void show_hints(double duration);
  void show_advice(const CapturedPostures& postures);

  device::HandMapping mapping_;
  JointCoverage coverage_;
  FingerCombinations combinations_;
  QStringList hints_;
  QLabel* headline_;
  QProgressBar* progress_;
  QLabel* advice_;
  QLabel* hints_label_;
  CoverageBars* bars_;
  QLabel* together_;
  CombinationSquares* squares_;
  QPushButton* restart_;
  double hints_at_ = -1.0;  ///< Duration when the hints were made, s.
};

}  // namespace handway::gui
