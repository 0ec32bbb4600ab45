#include "view3d/ghost_veil.h"

#include "view3d/coin_camera.h"
#include "view3d/coin_conversions.h"
#include "view3d/ghost.h"
#include "view3d/picture_region.h"
#include "view3d/screen_pass.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <QOpenGLShaderProgram>
#include <QVector2D>

#include <GL/gl.h>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr float kVeilShare = 0.55F;  // of a ghost's opacity away from its outline
constexpr float kRimOpacity = 0.85F;

// A pixel is at an edge as far as its four diagonal neighbours are much nearer or farther.
const char* const kRimShader = R"(#version 120
uniform sampler2D color;
uniform sampler2D depth;
uniform vec2 pixel;
uniform vec2 range;    // of the depths, m
uniform bool parallel;
uniform float faint;   // opacity away from the outline
uniform float strong;  // opacity of the outline
varying vec2 place;

void main() {
  vec4 others = vec4(texture2D(depth, place - pixel).r, texture2D(depth, place + pixel).r,
                     texture2D(depth, place + vec2(pixel.x, -pixel.y)).r,
                     texture2D(depth, place + vec2(-pixel.x, pixel.y)).r);
  float z = texture2D(depth, place).r;
  float nearest = min(z, min(min(others.x, others.y), min(others.z, others.w)));
  if (nearest == 1.0) {
    discard;
  }
  float span = range.y - range.x;
  float d = parallel ? range.x + z * span : range.x * range.y / (range.y - z * span);
  float slope = parallel ? 1.0 / span : range.x * range.y / (span * d * d);  // of z by d
  vec4 jumps = step(vec4((0.012 + 0.004 * d) * slope), abs(others - z));
  float edge = min(0.4 * dot(jumps, vec4(1.0)), 1.0);
  vec2 source = others.x == nearest ? -pixel : others.y == nearest ? pixel
              : others.z == nearest ? vec2(pixel.x, -pixel.y) : vec2(-pixel.x, pixel.y);
  vec3 paint = texture2D(color, z < 1.0 ? place : place + source).rgb;
  gl_FragColor = vec4(paint, mix(z < 1.0 ? faint : 0.0, strong, edge));
  gl_FragDepth = z < 1.0 ? z : nearest;
}
)";

}  // namespace

VeilTools::VeilTools() : rim(make_screen_program(kRimShader)), lay(PictureLayer::make_program()) {}

VeilTools::~VeilTools() = default;

namespace {

// Draws the ghost as an opaque body into `solid`.
bool draw_solid(VeilTools& tools, SoGLRenderAction& action, const Ghost& ghost,
                const QSize& pixels) {
  if (!tools.solid.bind(pixels)) {
    return false;
  }
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
  return true;
}

void draw_rim(VeilTools& tools, const Ghost& ghost, const OrbitCamera& camera,
              const QSize& pixels) {
  const EyeRange range = eye_range(camera);
  tools.rim->bind();
  tools.rim->setUniformValue("pixel", step_of(pixels));
  tools.rim->setUniformValue(
      "range", QVector2D(static_cast<float>(range.nearest), static_cast<float>(range.farthest)));
  tools.rim->setUniformValue("parallel", camera.projection() == Projection::kOrthographic);
  tools.rim->setUniformValue("faint", kVeilShare * ghost.opacity());
  tools.rim->setUniformValue("strong", std::max(kRimOpacity, ghost.opacity()));
  tools.solid.draw(*tools.rim, PictureLayer::Mode::kReplace);
}

}  // namespace

bool GhostVeil::make(VeilTools& tools, SoGLRenderAction& action, const Ghost& ghost,
                     const OrbitCamera& camera, const QSize& pixels) {
  region_ = region_of(*ghost.root(), camera, pixels);
  if (!tools.are_available() || !picture_.bind(pixels)) {
    return false;
  }
  if (region_.isEmpty()) {
    return true;
  }
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  const bool is_drawn = draw_solid(tools, action, ghost, pixels) && picture_.bind(pixels);
  if (is_drawn) {
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    restrict_to(region_);
    draw_rim(tools, ghost, camera, pixels);
  }
  glPopAttrib();
  action.invalidateState();
  return is_drawn;
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
