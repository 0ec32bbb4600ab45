#pragma once

#include "handway/geometric/scene/scene.h"
#include "view3d/orbit_camera.h"

#include <QImage>
#include <QSize>

#include <memory>
#include <vector>

class QOffscreenSurface;
class QOpenGLContext;
class SoGLRenderAction;

namespace handway::gui {

class SceneGraph;

/// Takes pictures of a scene without a window, on white and without a floor. Needs a display
/// that OpenGL can draw for, and a QGuiApplication.
class ScenePictures {
 public:
  /// @param oversampling drawn that many times as large, for smooth print.
  /// @throws geometric::InputError if there is no OpenGL.
  explicit ScenePictures(const std::shared_ptr<const geometric::Scene>& scene,
                         int oversampling = 2);
  ~ScenePictures();
  ScenePictures(const ScenePictures&) = delete;
  ScenePictures& operator=(const ScenePictures&) = delete;

  /// Points (world, m) that a picture of the whole scene should contain.
  [[nodiscard]] std::vector<Eigen::Vector3d> points_of_interest() const;

  /// The scene with its first robot at `q`, as `camera` sees it.
  [[nodiscard]] QImage picture(const geometric::Configuration& q, const OrbitCamera& camera,
                               const QSize& size);

 private:
  int oversampling_;
  std::unique_ptr<QOffscreenSurface> surface_;
  std::unique_ptr<QOpenGLContext> context_;
  std::unique_ptr<SceneGraph> graph_;
  std::unique_ptr<SoGLRenderAction> action_;
};

}  // namespace handway::gui
