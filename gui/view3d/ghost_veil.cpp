#include "view3d/ghost_veil.h"

#include "view3d/coin_conversions.h"
#include "view3d/ghost.h"
#include "view3d/scene_graph.h"
#include "view3d/scene_painter.h"
#include "view3d/screen_pass.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <QOpenGLShaderProgram>
#include <QVector2D>
#include <QVector4D>

#include <GL/gl.h>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr float kVeilShare = 0.55F;  // of a ghost's opacity away from its outline
constexpr float kRimOpacity = 0.85F;

const char* const kRimShader = R"(#version 120
uniform sampler2D color;
uniform sampler2D depth;
uniform vec2 pixel;
uniform vec2 range;    // of the depths, m
uniform bool parallel;
uniform float faint;   // opacity away from the outline
uniform float strong;  // opacity of the outline
varying vec2 place;

float distance_of(float z) {
  return parallel ? mix(range.x, range.y, z) : range.x * range.y / mix(range.y, range.x, z);
}

void main() {
  float z = texture2D(depth, place).r;
  float d = distance_of(z);
  float jump = 0.012 + 0.004 * d;
  float edge = 0.0, nearest = z;
  vec2 source = place;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = vec2(mod(float(i), 2.0), floor(0.5 * float(i))) * 2.0 - 1.0;
    vec2 at = place + corner * pixel;
    float other = texture2D(depth, at).r;
    edge += step(jump, abs(distance_of(other) - d)) * 0.4;
    if (other < nearest) {
      nearest = other;
      source = at;
    }
  }
  if (nearest == 1.0) {
    discard;
  }
  float opacity = mix(z < 1.0 ? faint : 0.0, strong, min(edge, 1.0));
  gl_FragColor = vec4(texture2D(color, source).rgb, opacity);
  gl_FragDepth = z < 1.0 ? z : nearest;
}
)";

}  // namespace

VeilTools::VeilTools() : rim(make_screen_program(kRimShader)), lay(PictureLayer::make_program()) {}

VeilTools::~VeilTools() = default;

bool GhostVeil::make(VeilTools& tools, SoGLRenderAction& action, const Ghost& ghost,
                     const OrbitCamera& camera, const QSize& pixels) {
  if (!tools.are_available() || !tools.solid.bind(pixels)) {
    return false;
  }
  region_ = region_of(*ghost.root(), camera, pixels);
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, pixels.width(), pixels.height());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  action.invalidateState();
  action.setViewportRegion(viewport_of(pixels));
  ghost.render_opaque(action);

  const bool is_bound = picture_.bind(pixels);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (is_bound && !region_.isEmpty()) {
    const EyeRange range = eye_range(camera);
    restrict_to(region_);
    tools.rim->bind();
    tools.rim->setUniformValue("pixel", QVector2D(1.0F / static_cast<float>(pixels.width()),
                                                  1.0F / static_cast<float>(pixels.height())));
    tools.rim->setUniformValue(
        "range", QVector2D(static_cast<float>(range.nearest), static_cast<float>(range.farthest)));
    tools.rim->setUniformValue("parallel", camera.projection() == Projection::kOrthographic);
    tools.rim->setUniformValue("faint", kVeilShare * ghost.opacity());
    tools.rim->setUniformValue("strong", std::max(kRimOpacity, ghost.opacity()));
    tools.solid.draw(*tools.rim, PictureLayer::Mode::kReplace);
  }
  glPopAttrib();
  action.invalidateState();
  return is_bound;
}

void GhostVeil::draw(VeilTools& tools, const QRect& part) {
  const QRect shown = part & region_;
  if (!shown.isEmpty()) {
    glPushAttrib(GL_SCISSOR_BIT);
    restrict_to(shown);
    picture_.draw(*tools.lay, PictureLayer::Mode::kBlend);
    glPopAttrib();
  }
}

}  // namespace handway::gui
