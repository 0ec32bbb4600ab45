#pragma once

#include "features/glove/captured_postures.h"
#include "features/glove/coverage_bars.h"
#include "handway/device/glove/hand_mapping.h"

#include <QStringList>
#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace handway::gui {

class CoverageBars;

/// What the person should do with the hand to cover more of its workspace, the most useful
/// first; none if all joints have been through most of their ranges.
/// @param mapping that the coverage was seen through.
/// @param most hints to give.
[[nodiscard]] QStringList capture_hints(const JointCoverage& coverage,
                                        const device::HandMapping& mapping, int most = 3);

/// Tells the person while the hand is captured how much of its workspace was visited, what to do
/// next, and when it is enough.
class CaptureCoach : public QWidget {
  Q_OBJECT

 public:
  explicit CaptureCoach(QWidget* parent = nullptr);

  /// Starts again with these joints.
  void restart(const device::HandMapping& mapping, const std::vector<std::string>& joints,
               const std::vector<bool>& driven);
  /// @param posture normalised, shape [joints].
  void add(const Eigen::VectorXd& posture);
  /// Shows what was added since the last time.
  void show_progress(const CapturedPostures& postures);

  [[nodiscard]] const JointCoverage& coverage() const { return coverage_; }
  [[nodiscard]] QStringList hints() const { return hints_; }
  /// What the coach says about going on or stopping.
  [[nodiscard]] QString advice() const;

 signals:
  void restart_requested();

 private:
  void show_hints(double duration);
  void show_advice(const CapturedPostures& postures);

  device::HandMapping mapping_;
  JointCoverage coverage_;
  QStringList hints_;
  QLabel* headline_;
  QProgressBar* progress_;
  QLabel* advice_;
  QLabel* hints_label_;
  CoverageBars* bars_;
  QPushButton* restart_;
  double hints_at_ = -1.0;  ///< Duration when the hints were made, s.
};

}  // namespace handway::gui
