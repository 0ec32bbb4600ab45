#pragma once

#include "handway/sampling/postures/basis_study.h"
#include "model/jobs/background.h"

#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

class QLabel;

namespace handway::gui {

/// What a report of a basis is made from.
struct BasisStudyInput {
  std::vector<sampling::RecordedHand> recordings;
  sampling::FingertipsOf fingertips;
  sampling::BasisStudySettings settings;
};

/// How far fingertips are off with so many principal motion directions: the mean as a line, its
/// confidence interval as a band.
class ReconstructionChart : public QWidget {
  Q_OBJECT

 public:
  explicit ReconstructionChart(QWidget* parent = nullptr);

  /// Empty: not known.
  void set_errors(std::vector<sampling::ReconstructionError> errors);

  [[nodiscard]] QSize sizeHint() const override { return {260, 150}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, 130}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<sampling::ReconstructionError> errors_;
};

/// How many directions of a basis are enough, how stable they are, and how well one basis serves
/// several persons: what `handway pca --report` says. Made in the background, once it is seen.
class BasisReportView : public QWidget {
  Q_OBJECT

 public:
  explicit BasisReportView(QWidget* parent = nullptr);

  /// @param input nothing: there is nothing to report of. @param reason why, for people.
  void set_input(std::optional<BasisStudyInput> input, const QString& reason);
  /// What is shown, as rich text.
  [[nodiscard]] QString text() const;
  /// A report is being made.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void make();

  std::optional<BasisStudyInput> input_;
  bool is_due_ = false;  ///< The input is newer than what is shown.
  ReconstructionChart* chart_;
  QLabel* text_;
  LatestJob job_;
};

}  // namespace handway::gui
