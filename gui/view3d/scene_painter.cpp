#include "view3d/scene_painter.h"

#include "view3d/orientation_cube.h"
#include "view3d/picture_layer.h"
#include "view3d/scene_graph.h"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLShaderProgram>

#include <Eigen/Geometry>
#include <GL/gl.h>

#include <cmath>
#include <cstdint>

namespace handway::gui {
namespace {

constexpr int kMargin = 10;  // px, for lines and points, which boxes know without their widths
constexpr double kNearest = 0.01;  // m

std::uint32_t new_cache_context() {
  static std::uint32_t last = 0;
  return ++last;
}

SbViewportRegion viewport_of(const QSize& pixels) {
  return {static_cast<short>(pixels.width()), static_cast<short>(pixels.height())};
}

void bind_frame(unsigned frame) {
  QOpenGLContext::currentContext()->functions()->glBindFramebuffer(GL_FRAMEBUFFER, frame);
}

void restrict_to(const QRect& region) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(region.x(), region.y(), region.width(), region.height());
}

double aspect_of(const QSize& pixels) {
  return static_cast<double>(pixels.width()) / pixels.height();
}

}  // namespace

QRect region_of(SoNode& root, const OrbitCamera& camera, const QSize& pixels) {
  SoGetBoundingBoxAction action{
      SbViewportRegion(static_cast<short>(pixels.width()), static_cast<short>(pixels.height()))};
  action.apply(&root);
  const SbBox3f box = action.getBoundingBox();
  if (box.isEmpty()) {
    return {};
  }
  const QRect all(QPoint(0, 0), pixels);
  const Eigen::Matrix3d R_CW = camera.orientation().transpose();
  const bool shrinks = camera.projection() == Projection::kPerspective;
  Eigen::AlignedBox2d covered;
  for (int corner = 0; corner < 8; ++corner) {
    const SbVec3f& p = corner % 2 == 0 ? box.getMin() : box.getMax();
    const SbVec3f& q = corner / 2 % 2 == 0 ? box.getMin() : box.getMax();
    const SbVec3f& r = corner / 4 == 0 ? box.getMin() : box.getMax();
    const Eigen::Vector3d p_C = R_CW * (Eigen::Vector3d(p[0], q[1], r[2]) - camera.position());
    if (shrinks && p_C.z() > -kNearest) {
      return all;
    }
    covered.extend(
        Eigen::Vector2d(p_C.head<2>() * (pixels.height() / camera.seen_height(-p_C.z()))));
  }
  const Eigen::Vector2d middle(0.5 * pixels.width(), 0.5 * pixels.height());
  const Eigen::Vector2d least = covered.min() + middle;
  const Eigen::Vector2d most = covered.max() + middle;
  const QRect region(QPoint(static_cast<int>(std::floor(least.x())) - kMargin,
                            static_cast<int>(std::floor(least.y())) - kMargin),
                     QPoint(static_cast<int>(std::ceil(most.x())) + kMargin,
                            static_cast<int>(std::ceil(most.y())) + kMargin));
  return region & all;
}

ScenePainter::ScenePainter(SceneGraph& graph)
    : graph_(graph),
      action_(std::make_unique<SoGLRenderAction>(SbViewportRegion())),
      program_(PictureLayer::make_program()) {
  action_->setCacheContext(new_cache_context());
}

ScenePainter::~ScenePainter() = default;

void ScenePainter::paint(const PictureFrame& frame, bool fast, unsigned target) {
  const Sight sight{frame.pixels, frame.camera.orientation(), frame.camera.position(),
                    frame.camera.projection()};
  const bool stands = last_ == sight;
  last_ = sight;
  last_region_ = stands && fast ? last_region_ : QRect(QPoint(0, 0), frame.pixels);
  glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  graph_.aim(frame.camera, aspect_of(frame.pixels));
  graph_.set_fine(!fast);
  if (!fast) {
    graph_.begin_motion();
    invalidate();
    paint_finely(frame, target);
  } else if (stands && program_) {
    paint_layered(frame, sight, target);
  } else {
    paint_all(frame);
  }
  glPopAttrib();
  glPopClientAttrib();
}

// Leaves nothing in front of what is painted next.
void ScenePainter::begin(const PictureFrame& frame) {
  glViewport(0, 0, frame.pixels.width(), frame.pixels.height());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // veils leave the picture opaque
  action_->invalidateState();
  action_->setViewportRegion(viewport_of(frame.pixels));
}

void ScenePainter::paint_all(const PictureFrame& frame) {
  begin(frame);
  draw_backdrop(frame.colors.sky, frame.colors.ground);
  graph_.render(*action_);
  paint_marks(frame);
}

void ScenePainter::paint_marks(const PictureFrame& frame) {
  graph_.render_marks(*action_, frame.with_gizmo, static_cast<float>(frame.pixel_ratio));
  const auto size = static_cast<short>(std::lround(ViewOverlay::kAxesSize * frame.pixel_ratio));
  SbViewportRegion corner = viewport_of(frame.pixels);
  corner.setViewportPixels(0, 0, size, size);
  action_->setViewportRegion(corner);
  glPushAttrib(GL_SCISSOR_BIT);
  restrict_to(QRect(0, 0, size, size));
  glClear(GL_DEPTH_BUFFER_BIT);
  graph_.render_axes(*action_, frame.camera);
  glPopAttrib();
}

void ScenePainter::paint_finely(const PictureFrame& frame, unsigned target) {
  if (!smooth_.frame || smooth_.pixels != frame.pixels || smooth_.samples != frame.samples) {
    QOpenGLFramebufferObjectFormat format;
    format.setSamples(frame.samples);
    format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
    smooth_ = {frame.pixels, frame.samples, nullptr};  // the one before goes first
    smooth_.frame = std::make_unique<QOpenGLFramebufferObject>(frame.pixels, format);
  }
  const bool is_smooth = smooth_.frame->bind();
  if (!is_smooth) {
    bind_frame(target);
  }
  paint_all(frame);
  if (is_smooth) {
    bind_frame(target);
    QOpenGLFramebufferObject::blitFramebuffer(nullptr, smooth_.frame.get());
    bind_frame(target);
  }
}

bool ScenePainter::keep_layers(const PictureFrame& frame) {
  if (!still_.bind(frame.pixels)) {
    return false;
  }
  begin(frame);
  draw_backdrop(frame.colors.sky, frame.colors.ground);
  graph_.render_still(*action_);
  for (std::size_t i = 0; i < veils_.size(); ++i) {
    const Ghost& ghost = *graph_.ghosts().at(i);
    if (ghost.is_visible()) {
      if (!veils_.at(i).picture.bind(frame.pixels)) {
        return false;
      }
      begin(frame);
      ghost.render_opaque(*action_);
      veils_.at(i).region = region_of(*ghost.root(), frame.camera, frame.pixels);
    }
  }
  return true;
}

void ScenePainter::paint_layered(const PictureFrame& frame, const Sight& sight, unsigned target) {
  const QRect all(QPoint(0, 0), frame.pixels);
  if (kept_ != sight) {
    last_region_ = all;
    const bool kept = keep_layers(frame);
    bind_frame(target);
    if (!kept) {
      program_.reset();
      paint_all(frame);
      return;
    }
    kept_ = sight;
  }
  // Only the changed region is drawn again; an outline or handles may be anywhere.
  const QRect region = graph_.has_marks() || frame.with_gizmo
                           ? all
                           : region_of(graph_.moving_root(), frame.camera, frame.pixels);
  const QRect dirty = region | last_region_;
  last_region_ = region;
  glViewport(0, 0, frame.pixels.width(), frame.pixels.height());
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const bool copied = still_.copy(target, dirty);
  restrict_to(dirty);
  if (!copied) {
    still_.draw(*program_, 1.0F);
  }
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  action_->invalidateState();
  action_->setViewportRegion(viewport_of(frame.pixels));
  graph_.render_moving(*action_);
  for (std::size_t i = 0; i < veils_.size(); ++i) {
    const Ghost& ghost = *graph_.ghosts().at(i);
    if (ghost.is_visible()) {
      restrict_to(dirty & veils_.at(i).region);
      veils_.at(i).picture.draw(*program_, ghost.opacity());
    }
  }
  restrict_to(dirty);
  action_->invalidateState();
  paint_marks(frame);
}

}  // namespace handway::gui
