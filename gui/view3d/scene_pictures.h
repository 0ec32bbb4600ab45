#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/scene.h"
#include "model/settings/orbit_camera.h"
#include "view3d/film.h"

#include <QImage>
#include <QSize>
#include <qopengl.h>

#include <memory>
#include <vector>

class QOffscreenSurface;
class QOpenGLContext;
class QOpenGLFramebufferObject;
class SoGLRenderAction;

namespace handway::gui {

class SceneGraph;
class SceneShading;

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

  /// Begins to draw a picture of a moment, without waiting for it. Objects stay where a moment
  /// has put them until another one moves them.
  void begin(const FilmMoment& moment, const OrbitCamera& camera, const QSize& size);
  /// Returns whether the picture that was begun is drawn.
  [[nodiscard]] bool is_drawn();
  /// Returns the picture that was begun, and waits for it if it isn't drawn yet.
  [[nodiscard]] QImage take();

 private:
  /// Progress of the begun picture.
  enum class Stage { kBodies, kShaded, kResolved };

  void make_buffers(const QSize& pixels);
  /// Sets a fence that is passed when all requests so far are drawn.
  void set_fence();
  void drop_fence();
  void advance();
  void shade();

  int oversampling_;
  std::unique_ptr<QOffscreenSurface> surface_;
  std::unique_ptr<QOpenGLContext> context_;
  std::unique_ptr<SceneGraph> graph_;
  std::unique_ptr<SceneShading> shading_;
  std::unique_ptr<SoGLRenderAction> action_;
  std::unique_ptr<QOpenGLFramebufferObject> drawn_;     ///< With several samples a pixel.
  std::unique_ptr<QOpenGLFramebufferObject> resolved_;  ///< With one.
  QSize size_;                                          ///< Size of the begun picture.
  OrbitCamera camera_;                                  ///< Its camera.
  Stage stage_ = Stage::kResolved;
  GLsync fence_ = nullptr;
};

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
