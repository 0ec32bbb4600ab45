#pragma once

#include "handway/sampling/postures/basis_study.h"
#include "model/jobs/background.h"

#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

class QLabel;

namespace handway::gui {

/// Input of the report of a basis.
struct BasisStudyInput {
  std::vector<sampling::RecordedHand> recordings;
  sampling::FingertipsOf fingertips;
  sampling::BasisStudySettings settings;
};

/// Chart of the fingertip error over the number of principal motion directions: the mean as a line,
/// its confidence interval as a band.
class ReconstructionChart : public QWidget {
  Q_OBJECT

 public:
  explicit ReconstructionChart(QWidget* parent = nullptr);

  /// Sets the errors; empty: not known.
  void set_errors(std::vector<sampling::ReconstructionError> errors);

  [[nodiscard]] QSize sizeHint() const override { return {260, 150}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, 130}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<sampling::ReconstructionError> errors_;
};

/// View of the report of `handway pca --report`: sufficient number of directions of a basis, their
/// stability, and how well one basis serves several persons. It is computed in the background, once
/// it is visible.
class BasisReportView : public QWidget {
  Q_OBJECT

 public:
  explicit BasisReportView(QWidget* parent = nullptr);

  /// @param input nothing: there is nothing to report. @param reason the displayed reason.
  void set_input(std::optional<BasisStudyInput> input, const QString& reason);
  /// Returns the report that is shown, as rich text.
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
