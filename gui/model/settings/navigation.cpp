#include "model/settings/navigation.h"

#include "model/settings/orbit_camera.h"

#include <cmath>

namespace handway::gui {

CameraMove camera_move(NavigationStyle style, Qt::MouseButtons buttons,
                       Qt::KeyboardModifiers modifiers) {
  const bool shift = modifiers & Qt::ShiftModifier;
  const bool control = modifiers & Qt::ControlModifier;
  if (style == NavigationStyle::kLeftTurns) {
    if (buttons & Qt::MiddleButton) {
      return CameraMove::kPan;
    }
    if (buttons & Qt::LeftButton) {
      return shift ? CameraMove::kPan : CameraMove::kTurn;
    }
    return buttons & Qt::RightButton ? CameraMove::kZoom : CameraMove::kNone;
  }
  const bool by_middle = style == NavigationStyle::kMiddleTurns;
  if (buttons & (by_middle ? Qt::MiddleButton : Qt::RightButton)) {
    return shift ? CameraMove::kPan : control ? CameraMove::kZoom : CameraMove::kTurn;
  }
  return !by_middle && (buttons & Qt::MiddleButton) ? CameraMove::kPan : CameraMove::kNone;
}

void move_camera(OrbitCamera& camera, CameraMove move, const QPointF& drag) {
  switch (move) {
    case CameraMove::kNone:
      break;
    case CameraMove::kTurn:
      camera.orbit(-4.0 * drag.x(), 4.0 * drag.y());
      break;
    case CameraMove::kPan:
      camera.pan(drag.x(), -drag.y());
      break;
    case CameraMove::kZoom:
      camera.zoom(std::exp(3.0 * drag.y()), 0.0, 0.0);
      break;
  }
}

double wheel_zoom(const Navigation& navigation, int angle) {
  return std::pow(1.0015, navigation.wheel_reversed ? angle : -angle);
}

}  // namespace handway::gui
