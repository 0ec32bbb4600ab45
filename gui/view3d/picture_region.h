#pragma once

#include <QRect>
#include <QSize>

class SoNode;

namespace handway::gui {

class OrbitCamera;

/// The part of a picture that a drawing may cover, px from the lower left; a box around the
/// drawing's box, all of the picture if that comes behind the camera, empty if there is nothing.
/// @param root draws in the world's frame, m.
[[nodiscard]] QRect region_of(SoNode& root, const OrbitCamera& camera, const QSize& pixels);

}  // namespace handway::gui
