#pragma once

#include "model/settings/orbit_camera.h"
#include "view3d/screen_pass.h"

#include <QOpenGLExtraFunctions>
#include <QSize>

#include <Eigen/Core>

#include <array>
#include <memory>

class QOpenGLShaderProgram;
class SoGLRenderAction;

namespace handway::gui {

class SceneGraph;

/// Darkens drawn bodies, and the floor below them, where light does not reach: by ambient
/// occlusion (McGuire, Mara and Luebke, "Scalable ambient obscurance", 2012) and by the soft
/// shadow of a lamp above the scene (Fernando, "Percentage-closer soft shadows", 2005). It works on
/// the depths of the picture at half of its resolution. Needs its context current in all functions.
class SceneShading : protected QOpenGLExtraFunctions {
 public:
  explicit SceneShading(SceneGraph& graph);
  ~SceneShading();

  /// Darkens the picture of graph.render_bodies() in a frame buffer, and binds that again;
  /// does nothing if the card can't.
  /// @param frame has 24 bits of depth and a stencil. @param pixels its size.
  /// @param only_still the picture is that of graph.render_still_bodies().
  void shade(SoGLRenderAction& action, const OrbitCamera& camera, const QSize& pixels,
             unsigned frame, bool only_still = false);

 private:
  [[nodiscard]] bool draw_shadow_map(SoGLRenderAction& action, const OrbitCamera& camera,
                                     bool only_still);
  /// Values of the shaders that describe the camera.
  struct Lens;

  [[nodiscard]] bool compute(const OrbitCamera& camera, const QSize& pixels, unsigned frame);
  [[nodiscard]] bool copy_depths(const QSize& pixels, unsigned frame);
  [[nodiscard]] bool find_distances(const Lens& lens, const QSize& pixels);
  [[nodiscard]] bool find_shades(const Lens& lens, const QSize& pixels);
  /// @param size of the textures of shades, px.
  [[nodiscard]] bool blur(const QSize& size);
  void multiply(const QSize& pixels);

  SceneGraph& graph_;
  bool is_available_ = false;
  std::unique_ptr<QOpenGLShaderProgram> distances_program_;
  std::unique_ptr<QOpenGLShaderProgram> shade_program_;
  std::unique_ptr<QOpenGLShaderProgram> blur_program_;
  std::unique_ptr<QOpenGLShaderProgram> multiply_program_;
  ScreenTexture depths_{ScreenTexture::Kind::kDepth};
  ScreenTexture shadow_map_{ScreenTexture::Kind::kDepth};
  ScreenTexture distances_{ScreenTexture::Kind::kPair};  ///< Along the view, m; negative: floor.
  std::array<ScreenTexture, 2> shades_{ScreenTexture{ScreenTexture::Kind::kPair},
                                       ScreenTexture{ScreenTexture::Kind::kPair}};
  Eigen::Matrix4f shadow_from_world_ = Eigen::Matrix4f::Identity();  ///< To [0, 1]³.
  Eigen::Matrix3d R_WL_ = Eigen::Matrix3d::Identity();               ///< See LampView.
  Eigen::Vector2f shadow_size_ = Eigen::Vector2f::Ones();  ///< Width and depth of the map, m.
};

}  // namespace handway::gui
