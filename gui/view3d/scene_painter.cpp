#include "view3d/scene_painter.h"

#include "view3d/coin_conversions.h"
#include "view3d/orientation_cube.h"
#include "view3d/picture_layer.h"
#include "view3d/picture_region.h"
#include "view3d/scene_graph.h"
#include "view3d/screen_pass.h"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>

#include <Eigen/Geometry>
#include <GL/gl.h>

#include <cmath>
#include <cstdint>

namespace handway::gui {
namespace {

std::uint32_t new_cache_context() {
  static std::uint32_t last = 0;
  return ++last;
}

double aspect_of(const QSize& pixels) {
  return static_cast<double>(pixels.width()) / pixels.height();
}

}  // namespace

ScenePainter::ScenePainter(SceneGraph& graph)
    : graph_(graph),
      action_(std::make_unique<SoGLRenderAction>(SbViewportRegion())),
      shading_(graph) {
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
  } else if (stands && veil_tools_.are_available() && !layers_fail_) {
    paint_layered(frame, sight, target);
  } else {
    paint_all(frame, target, false);
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

void ScenePainter::paint_all(const PictureFrame& frame, unsigned target, bool fine) {
  const bool has_veils = fine && make_veils(frame);
  bind_frame(target);
  begin(frame);
  draw_backdrop(frame.colors.sky, frame.colors.ground);
  graph_.render_bodies(*action_);
  if (fine) {
    shade(frame, target, false);
  }
  graph_.render_drawings(*action_);
  if (has_veils) {
    draw_veils(QRect(QPoint(0, 0), frame.pixels));
    action_->invalidateState();
  } else {
    graph_.render_ghosts(*action_);
  }
  paint_marks(frame);
}

bool ScenePainter::make_veils(const PictureFrame& frame) {
  for (std::size_t i = 0; i < veils_.size(); ++i) {
    const Ghost& ghost = *graph_.ghosts().at(i);
    if (ghost.is_visible() &&
        !veils_.at(i).make(veil_tools_, *action_, ghost, frame.camera, frame.pixels)) {
      return false;
    }
  }
  return true;
}

void ScenePainter::draw_veils(const QRect& part) {
  for (std::size_t i = 0; i < veils_.size(); ++i) {
    if (graph_.ghosts().at(i)->is_visible()) {
      veils_.at(i).draw(veil_tools_, part);
    }
  }
}

void ScenePainter::shade(const PictureFrame& frame, unsigned target, bool only_still) {
  if (!frame.has_shadows) {
    return;
  }
  shading_.shade(*action_, frame.camera, frame.pixels, target, only_still);
  action_->setViewportRegion(viewport_of(frame.pixels));
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
  const bool is_smooth = smooth_.frame->isValid();
  paint_all(frame, is_smooth ? smooth_.frame->handle() : target, true);
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
  graph_.render_still_bodies(*action_);
  shade(frame, still_.frame(), true);
  graph_.render_still_drawings(*action_);
  return make_veils(frame);
}

void ScenePainter::paint_layered(const PictureFrame& frame, const Sight& sight, unsigned target) {
  const QRect all(QPoint(0, 0), frame.pixels);
  if (kept_ != sight) {
    last_region_ = all;
    const bool kept = keep_layers(frame);
    bind_frame(target);
    if (!kept) {
      layers_fail_ = true;
      paint_all(frame, target, false);
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
    still_.draw(*veil_tools_.lay, PictureLayer::Mode::kReplace);
  }
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  action_->invalidateState();
  action_->setViewportRegion(viewport_of(frame.pixels));
  graph_.render_moving(*action_);
  draw_veils(dirty);
  restrict_to(dirty);
  action_->invalidateState();
  paint_marks(frame);
}

}  // namespace handway::gui
