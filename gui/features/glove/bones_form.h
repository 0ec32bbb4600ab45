#pragma once

#include "handway/device/glove/human_hand.h"

#include <QWidget>

#include <vector>

class QDoubleSpinBox;

namespace handway::gui {

/// Form of the lengths of a person's bones, mm: typed, in proportion to the hand's length, or as
/// measured.
class BonesForm : public QWidget {
  Q_OBJECT

 public:
  explicit BonesForm(QWidget* parent = nullptr);

  void show_bones(const device::HandBones& bones);
  [[nodiscard]] device::HandBones bones() const;

 private:
  QDoubleSpinBox* length_;
  std::vector<QDoubleSpinBox*> lengths_;  ///< Finger by finger.
};

}  // namespace handway::gui
