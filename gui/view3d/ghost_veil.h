#pragma once

#include "model/settings/orbit_camera.h"
#include "view3d/picture_layer.h"

#include <QRect>
#include <QSize>

#include <memory>

class QOpenGLShaderProgram;
class SoGLRenderAction;

namespace handway::gui {

class Ghost;

/// Programs and memory that the veils of a view share. Needs a current context, as all below.
struct VeilTools {
  VeilTools();
  ~VeilTools();

  /// Returns whether the card can draw veils.
  [[nodiscard]] bool are_available() const { return rim && lay; }

  std::unique_ptr<QOpenGLShaderProgram> rim;  ///< From a solid body to a veil; nullptr: none.
  std::unique_ptr<QOpenGLShaderProgram> lay;  ///< A layer into a picture; nullptr: none.
  PictureLayer solid;                         ///< A ghost as an opaque body.
};

/// The picture of a ghost: a faint veil with a clear outline, also around what is in front of its
/// other parts, so that the bodies behind it keep their colours.
class GhostVeil {
 public:
  /// Makes the picture of a visible ghost, to be drawn several times. Binds other frame buffers
  /// than the current one. @returns false if the card can't.
  [[nodiscard]] bool make(VeilTools& tools, SoGLRenderAction& action, const Ghost& ghost,
                          const OrbitCamera& camera, const QSize& pixels);
  /// Lays it into the current picture, behind what is in front of it there.
  /// @param part px from the lower left.
  void draw(VeilTools& tools, const QRect& part);

 private:
  PictureLayer picture_;
  QRect region_;  ///< px from the lower left.
};

}  // namespace handway::gui
