#pragma once

#include "features/glove/finger_combinations.h"

#include <QWidget>

namespace handway::gui {

/// A square for each pair of fingers, one along each axis, from straight to bent. Combinations that
/// were visited are filled.
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

}  // namespace handway::gui
