#pragma once

#include "features/glove/capture_pages.h"
#include "handway/device/glove/hand_mapping.h"

#include <QStringList>
#include <QWidget>

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

class QLabel;
class QProgressBar;
class QPushButton;

namespace handway::gui {

/// Where one joint has been, in its range normalised to [0, 1].
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
  /// From least to most; 0 before the first posture.
  [[nodiscard]] double range() const { return most > least ? most - least : 0.0; }
};

/// How much of their joints' ranges the captured postures have been through.
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

/// A joint's name for people: "ring_abduction" is "Ring abduction".
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
