#pragma once

#include <QPointF>
#include <Qt>

namespace handway::gui {

class OrbitCamera;

/// Mouse buttons that turn, move and zoom.
enum class NavigationStyle {
  kLeftTurns,    ///< Left turns, middle or Shift+left moves, right zooms.
  kMiddleTurns,  ///< Middle turns, Shift+middle moves, Ctrl+middle zooms.
  kRightTurns,   ///< Right turns, middle or Shift+right moves, Ctrl+right zooms.
};

/// Settings of how the mouse moves a camera.
struct Navigation {
  NavigationStyle style = NavigationStyle::kLeftTurns;
  bool wheel_reversed = false;

  bool operator==(const Navigation& other) const = default;
};

enum class CameraMove { kNone, kTurn, kPan, kZoom };

/// Returns the move of the camera when dragging with these buttons held.
[[nodiscard]] CameraMove camera_move(NavigationStyle style, Qt::MouseButtons buttons,
                                     Qt::KeyboardModifiers modifiers);

/// Moves the camera as far as the mouse was dragged. @param drag in fractions of the view's
/// height, right and down.
void move_camera(OrbitCamera& camera, CameraMove move, const QPointF& drag);

/// Returns the factor on the camera's distance for a turn of the wheel. @param angle as
/// QWheelEvent::angleDelta().
[[nodiscard]] double wheel_zoom(const Navigation& navigation, int angle);

}  // namespace handway::gui
