#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "model/settings/orbit_camera.h"
#include "view3d/scene_pictures.h"

#include <QImage>
#include <QSize>

#include <memory>

namespace handway::gui {

/// Takes pictures of a robot in any posture without a window, on white. Needs a display that
/// OpenGL can draw for, and a QGuiApplication.
class PosturePictures {
 public:
  /// @param placement where the camera stands; its target and distance are found.
  /// @throws geometric::InputError if there is no OpenGL.
  PosturePictures(const std::shared_ptr<const geometric::RobotModel>& robot,
                  const OrbitCamera::Placement& placement);

  /// The robot at `q`; all pictures have the same camera, which sees it
  /// at both ends of its joints' ranges.
  [[nodiscard]] QImage picture(const geometric::Configuration& q, const QSize& size);

 private:
  ScenePictures pictures_;
  OrbitCamera camera_;
};

}  // namespace handway::gui
