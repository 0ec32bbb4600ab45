#pragma once

#include "handway/device/glove/human_hand.h"

#include <QWidget>

namespace handway::gui {

/// Shows a person's hand in a posture, seen from above its thumb's side.
class HandPicture : public QWidget {
  Q_OBJECT

 public:
  explicit HandPicture(QWidget* parent = nullptr);

  /// @param left a left hand's picture.
  void show_hand(const device::GloveAngles& angles, bool left);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  device::GloveAngles angles_{};
  bool left_ = false;
};

}  // namespace handway::gui
