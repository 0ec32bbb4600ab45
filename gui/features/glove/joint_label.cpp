#include "features/glove/joint_label.h"

#include "handway/device/glove/human_hand.h"

namespace handway::gui {
QString joint_label(const std::string& joint) {
  QString text = QString::fromStdString(joint).replace(QLatin1Char('_'), QLatin1Char(' '));
  if (!text.isEmpty()) {
    text[0] = text[0].toUpper();
  }
  return text;
}

QString finger_label(std::size_t finger) {
  const std::string& name = device::name_of(static_cast<device::Finger>(finger));
  return joint_label(name);
}

}  // namespace handway::gui
