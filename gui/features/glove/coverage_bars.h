#pragma once

#include <QWidget>

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

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

}  // namespace handway::gui
