#pragma once

#include "features/glove/joint_coverage.h"

#include <QWidget>

namespace handway::gui {

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
