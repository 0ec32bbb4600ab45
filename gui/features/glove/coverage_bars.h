#pragma once

#include "features/glove/joint_coverage.h"

#include <QWidget>

#include <vector>

namespace handway::gui {

inline constexpr int kSideMargin = 12;  ///< Margin left and right of the parts of the coach, px.

/// A bar for each joint: its range with the visited parts filled, its present value, and the share
/// that was visited.
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
