#pragma once

#include "model/settings/options.h"
#include "model/settings/orbit_camera.h"
#include "view3d/ghost_veil.h"
#include "view3d/picture_layer.h"
#include "view3d/scene_graph.h"
#include "view3d/scene_shading.h"

#include <QRect>
#include <QSize>

#include <array>
#include <memory>
#include <optional>

class QOpenGLFramebufferObject;
class SoGLRenderAction;
class SoNode;

namespace handway::gui {

/// Settings of a picture of a scene.
struct PictureFrame {
  QSize pixels;
  double pixel_ratio = 1.0;  ///< Pixels for one unit of lengths on the screen.
  OrbitCamera camera;
  ViewColors colors;
  bool with_gizmo = false;
  int samples = 4;  ///< For each pixel of a fine picture; 0: edges are not smooth.
  bool has_shadows = true;
};

/// Paints a scene graph, finely or fast. Fine pictures have smooth edges. Fast ones do without
/// them, and as long as the camera stands, what stands still and the ghosts are painted once and
/// kept with their depths. Then only the links that move are drawn, where they are or were, so that
/// pictures can follow a glove without a graphics card. Needs its context current in all functions,
/// and a frame buffer that keeps what was painted.
class ScenePainter {
 public:
  explicit ScenePainter(SceneGraph& graph);
  ~ScenePainter();

  /// Discards the picture of fixed bodies, one of which looks different.
  void invalidate() { kept_.reset(); }
  /// @param target the frame buffer to paint on.
  void paint(const PictureFrame& frame, bool fast, unsigned target);

 private:
  /// Camera of a picture.
  struct Sight {
    QSize pixels;
    Eigen::Matrix3d R_WC;
    Eigen::Vector3d p_WC;
    Projection projection;
    bool operator==(const Sight& other) const = default;
  };

  void paint_finely(const PictureFrame& frame, unsigned target);
  void paint_layered(const PictureFrame& frame, const Sight& sight, unsigned target);
  [[nodiscard]] bool keep_layers(const PictureFrame& frame);
  [[nodiscard]] bool make_veils(const PictureFrame& frame);
  void draw_veils(const QRect& part);
  void begin(const PictureFrame& frame);
  /// @param fine with shadows, and outlines of ghosts, which take too long while the view turns.
  void paint_all(const PictureFrame& frame, unsigned target, bool fine);
  void shade(const PictureFrame& frame, unsigned target, bool only_still);
  void paint_marks(const PictureFrame& frame);

  SceneGraph& graph_;
  std::unique_ptr<SoGLRenderAction> action_;
  SceneShading shading_;
  /// Framebuffer for fine pictures, several times as large as they are. It is kept, because drivers
  /// free such memory late, which would accumulate.
  struct Smooth {
    QSize pixels;
    int samples = 0;
    std::unique_ptr<QOpenGLFramebufferObject> frame;
  };
  Smooth smooth_;
  PictureLayer still_;
  bool layers_fail_ = false;  ///< The card can't keep them.
  VeilTools veil_tools_;
  std::array<GhostVeil, SceneGraph::kGhosts> veils_;  ///< One for each ghost.
  std::optional<Sight> kept_;  ///< From where the layers are seen; nothing: to be made.
  std::optional<Sight> last_;  ///< Camera of the last picture.
  QRect last_region_;          ///< Region of moving links, px from the lower left.
};

}  // namespace handway::gui
