#pragma once

#include "features/glove/capture_pages.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"

#include <QStringList>
#include <QWidget>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

class QLabel;
class QProgressBar;
class QPushButton;

namespace handway::gui {

/// Coverage of the range of one joint, normalised to [0, 1].
struct JointVisits {
  static constexpr int kBins = 25;

  std::string joint;
  bool driven = true;  ///< By a sensor; else it stays where it is.
  std::array<bool, kBins> visited{};
  double least = 1.0;
  double most = 0.0;
  double now = 0.5;

  /// Visited bins over all, in [0, 1].
  [[nodiscard]] double share() const;
  /// Returns the range from least to most; 0 before the first posture.
  [[nodiscard]] double range() const { return most > least ? most - least : 0.0; }
};

/// Coverage of the joints' ranges by the captured postures.
class JointCoverage {
 public:
  /// @param driven whether a sensor drives the joint, shape [joints].
  void restart(const std::vector<std::string>& joints, const std::vector<bool>& driven);

  /// @param posture normalised, shape [joints].
  void add(const Eigen::VectorXd& posture);

  [[nodiscard]] const std::vector<JointVisits>& joints() const { return joints_; }
  /// Mean share of the driven joints; 0 if there are none.
  [[nodiscard]] double share() const;

 private:
  std::vector<JointVisits> joints_;
};

/// Combinations of straight, half bent and bent fingers that have been covered, for each pair of
/// fingers.
class FingerCombinations {
 public:
  static constexpr int kStates = 3;  ///< Straight, half bent, bent.

  void restart() { *this = {}; }
  /// @param ranges of the person.
  void add(const device::GloveAngles& angles, const device::PersonRanges& ranges);

  /// @param a a finger before `b`.
  [[nodiscard]] bool visited(device::Finger a, int state_of_a, device::Finger b,
                             int state_of_b) const;
  /// Returns the covered share of all combinations of measured fingers, in [0, 1]; 0 before the
  /// first posture.
  [[nodiscard]] double share() const;
  /// "Index bent, ring straight": one of two fingers bent and the other straight that is missing;
  /// empty if none is, or nothing was measured.
  [[nodiscard]] QString missing() const;

 private:
  using Cells = std::array<bool, kStates * kStates>;

  std::array<bool, device::kFingers> measured_{};
  std::array<std::array<Cells, device::kFingers>, device::kFingers> cells_{};  ///< [a][b], a < b.
};

/// A square for each two fingers: one across, one down, from straight to bent, filled where both
/// were so together.
class CombinationSquares : public QWidget {
  Q_OBJECT

 public:
  explicit CombinationSquares(QWidget* parent = nullptr);

  void show_combinations(const FingerCombinations& combinations);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  FingerCombinations combinations_;
};

/// Returns the displayed name of a joint: "ring_abduction" is "Ring abduction".
[[nodiscard]] QString joint_label(const std::string& joint);

/// A row a joint: its range with the visited parts filled, where it is now, and how
/// much has been visited.
class CoverageBars : public QWidget {
  Q_OBJECT

 public:
  explicit CoverageBars(QWidget* parent = nullptr);

  void show_coverage(const JointCoverage& coverage);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<JointVisits> joints_;
};

/// Returns instructions for the person that cover more of the hand's workspace, the most useful
/// first; none if all joints have been through most of their ranges.
/// @param mapping that the coverage was computed with.
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
