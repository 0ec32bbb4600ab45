#include "view3d/scene_shading.h"

#include "view3d/coin_camera.h"
#include "view3d/scene_graph.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <QMatrix4x4>
#include <QOpenGLContext>
#include <QOpenGLShaderProgram>
#include <QVector2D>
#include <QVector4D>

#include <Eigen/Geometry>
#include <GL/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace handway::gui {
namespace {

constexpr int kMapSize = 1024;            // px, of the shadow map
constexpr double kMostAround = 2.5;       // m: farther from the target bodies cast no shadow
constexpr float kOcclusionReach = 0.12F;  // m, within which surfaces occlude each other

/// Direction to the lamp, in the world: high, from the front and the left of the opening view.
const Eigen::Vector3d kToLamp = Eigen::Vector3d(0.45, -0.30, 1.0).normalized();

// Distance along the view, m, of what is drawn or of the floor in front of it.
const char* const kDistances = R"(#version 120
uniform sampler2D depths;
uniform vec4 lens;   // half of what is seen at 1 m (parallel: anywhere), and the depths' ends, m
uniform bool parallel;
uniform vec4 ground; // plane in the camera's frame: normal and offset, m; no normal: none
varying vec2 place;
void main() {
  float z = texture2D(depths, place).r;
  float d = 1.0e4;
  if (z < 1.0) {
    d = parallel ? mix(lens.z, lens.w, z) : lens.z * lens.w / mix(lens.w, lens.z, z);
  }
  vec2 xy = (2.0 * place - 1.0) * lens.xy;
  vec3 along = parallel ? vec3(0.0, 0.0, -1.0) : vec3(xy, -1.0);
  float slope = dot(ground.xyz, along);
  if (slope < -1.0e-4) {
    float height = parallel ? ground.w - dot(ground.xyz, vec3(xy, 0.0)) : ground.w;
    float f = height / slope;
    d = f > 0.0 && f < d ? -f : d;
  }
  gl_FragColor = vec4(d, 0.0, 0.0, 1.0);
}
)";

// Share of light that arrives, and the distance.
const char* const kShade = R"(#version 120
uniform sampler2D distances;
uniform sampler2D shadows;
uniform vec4 lens;
uniform bool parallel;
uniform vec3 up;          // normal of the floor, in the camera's frame
uniform vec4 middle;      // of the floor, in the camera's frame, m, and its radius, m
uniform mat4 to_shadows;  // from the camera's frame
uniform mat3 lamp_frame;   // turns from the camera's frame to the lamp's
uniform vec2 map_size;    // width and depth of the shadow map, m
uniform vec2 pixel;       // size of a pixel in the texture of distances
uniform float reach;      // of occlusion, m
varying vec2 place;

const float kPi = 3.14159265;
const int kTaps = 12;
uniform vec2 spiral[kTaps];  // from the middle to 1
uniform vec2 disc[kTaps];    // evenly over the unit disc; the first half covers it, too

vec3 point_at(vec2 at, float d) {
  vec2 xy = (2.0 * at - 1.0) * lens.xy;
  return vec3(parallel ? xy : xy * d, -d);
}

vec2 centre_of_pixel(vec2 at) { return (floor(at / pixel) + 0.5) * pixel; }

vec3 point(vec2 at) {
  vec2 centre = centre_of_pixel(at);
  return point_at(centre, abs(texture2D(distances, centre).r));
}

vec3 shorter(vec3 a, vec3 b) { return dot(a, a) < dot(b, b) ? a : b; }

vec3 normal_at(vec2 own, vec3 p) {
  vec2 dx = vec2(pixel.x, 0.0), dy = vec2(0.0, pixel.y);
  vec3 right = shorter(point(own + dx) - p, p - point(own - dx));
  vec3 upward = shorter(point(own + dy) - p, p - point(own - dy));
  return normalize(cross(right, upward));
}

float occlusion(vec2 own, vec3 p, vec3 n, mat2 turn) {
  float seen = reach / (2.0 * lens.y * (parallel ? 1.0 : -p.z));  // of the picture's height
  mat2 spread = clamp(seen, 4.0 * pixel.y, 0.15) * turn;
  float wide = pixel.x / pixel.y;
  float sum = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    vec2 offset = spread * spiral[i];
    vec3 v = point(own + vec2(offset.x * wide, offset.y)) - p;
    float square = dot(v, v);
    float near = max(1.0 - square / (reach * reach), 0.0);
    float sink = dot(v, n) - 0.002 + 0.001 * p.z;
    sum += near * near * max(sink, 0.0) / (0.01 * reach + sqrt(square));
  }
  return max(1.0 - 2.2 * sum / float(kTaps), 0.0);
}

// Taps beside the point are compared with the depth that the surface's own plane has there.
float shadow(vec3 p, vec3 n, mat2 turn) {
  vec3 n_L = lamp_frame * n;
  if (n_L.z <= 0.05) {
    return 0.0;
  }
  float texel = 1.0 / 1024.0;
  vec3 s = (to_shadows * vec4(p + n * 1.5 * map_size.x * texel, 1.0)).xyz;
  if (any(lessThan(s, vec3(0.0))) || any(greaterThan(s, vec3(1.0)))) {
    return 0.0;
  }
  vec2 slope = n_L.xy / n_L.z * map_size.x / map_size.y;
  float own = s.z - 0.0005;
  float widest = 0.05 / map_size.x;
  mat2 spread = widest * turn;
  float sum = 0.0, count = 0.0;
  for (int i = 0; i < kTaps / 2; ++i) {
    vec2 offset = spread * disc[i];
    float z = texture2D(shadows, s.xy + offset).r;
    float blocks = step(z, own + dot(slope, offset));
    sum += blocks * z;
    count += blocks;
  }
  if (count == 0.0) {
    return 0.0;
  }
  spread = clamp((s.z - sum / count) * map_size.y / map_size.x * 0.16, texel, widest) * turn;
  float dark = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    vec2 offset = spread * disc[i];
    dark += step(texture2D(shadows, s.xy + offset).r, own + dot(slope, offset));
  }
  return dark / float(kTaps) * smoothstep(0.05, 0.4, n_L.z);
}

void main() {
  vec2 own = place - 0.5 * pixel;  // the centre of one of the four pixels around
  float signed_distance = texture2D(distances, own).r;
  float d = abs(signed_distance);
  float light = 1.0;
  if (d < 9.0e3) {
    vec3 p = point(own);
    bool is_floor = signed_distance < 0.0;
    vec3 n = is_floor ? up : normal_at(own, p);
    vec2 cell = mod(floor(gl_FragCoord.xy), 4.0);
    float angle = 2.0 * kPi * fract((cell.x * 5.0 + cell.y * 11.0 + cell.x * cell.y * 3.0) / 16.0);
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    light = occlusion(own, p, n, turn) * (1.0 - 0.38 * shadow(p, n, turn));
    if (is_floor) {
      light = mix(light, 1.0, smoothstep(0.5 * middle.w, middle.w, distance(p, middle.xyz)));
    }
  }
  gl_FragColor = vec4(light, d, 0.0, 1.0);
}
)";

// Means along one axis, over what is as far away.
const char* const kBlur = R"(#version 120
uniform sampler2D shades;
uniform vec2 along;
varying vec2 place;
void main() {
  vec2 own = texture2D(shades, place).rg;
  float sum = own.r, weights = 1.0;
  for (int i = -2; i <= 2; ++i) {
    vec2 other = texture2D(shades, place + float(i) * along).rg;
    float weight = (i == -2 || i == 2) ? 0.5 : (i == 0 ? 0.0 : 1.0);
    weight *= max(1.0 - abs(other.g - own.g) / (0.015 * own.g), 0.0);
    sum += weight * other.r;
    weights += weight;
  }
  gl_FragColor = vec4(sum / weights, own.g, 0.0, 1.0);
}
)";

// The light of every pixel, from the nearest four of half the resolution that are as far away.
const char* const kMultiply = R"(#version 120
uniform sampler2D shades;
uniform sampler2D distances;
uniform vec2 size;  // of the texture of shades, px
varying vec2 place;
void main() {
  float d = abs(texture2D(distances, place).r);
  vec2 at = place * size - 0.5;
  vec2 corner = floor(at), share = at - corner;
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 step = vec2(mod(float(i), 2.0), floor(0.5 * float(i)));
    vec2 shade = texture2D(shades, (corner + step + 0.5) / size).rg;
    vec2 near = mix(1.0 - share, share, step);
    float weight = near.x * near.y / (1.0e-3 + abs(shade.g - d) / d);
    sum += weight * shade.r;
    weights += weight;
  }
  float light = sum / max(weights, 1.0e-6);
  gl_FragColor = vec4(mix(vec3(0.05, 0.06, 0.10), vec3(1.0), light), 1.0);
}
)";

constexpr int kTaps = 12;  // as in the shader

/// Returns points on a spiral of several turns, evenly along the radius or over the unit disc.
std::array<QVector2D, kTaps> spiral_points(double turns, bool over_disc) {
  std::array<QVector2D, kTaps> points;
  for (int i = 0; i < kTaps; ++i) {
    const double share = (i + 0.5) / kTaps;
    const double radius = over_disc ? std::sqrt(share) : share;
    const double angle = 2.0 * std::numbers::pi * turns * share;
    points.at(static_cast<std::size_t>(i)) = {static_cast<float>(radius * std::cos(angle)),
                                              static_cast<float>(radius * std::sin(angle))};
  }
  return points;
}

/// Returns points over the unit disc, of which every second one comes first.
std::array<QVector2D, kTaps> disc_points() {
  constexpr double kGoldenTurns = 0.381966 * kTaps;
  const std::array<QVector2D, kTaps> points = spiral_points(kGoldenTurns, true);
  std::array<QVector2D, kTaps> mixed;
  for (std::size_t i = 0; i < kTaps; ++i) {
    mixed.at(i) = points.at((2 * i) % kTaps + (2 * i) / kTaps);
  }
  return mixed;
}

QSize half_of(const QSize& pixels) { return {(pixels.width() + 1) / 2, (pixels.height() + 1) / 2}; }

}  // namespace

struct SceneShading::Lens {
  QVector4D values;
  bool is_parallel;
  Eigen::Isometry3d X_CW;

  Lens(const OrbitCamera& camera, const QSize& pixels)
      : is_parallel(camera.projection() == Projection::kOrthographic) {
    const double depth = is_parallel ? camera.placement().distance : 1.0;
    const double half = 0.5 * camera.seen_height(depth);
    const EyeRange range = eye_range(camera);
    values = QVector4D(static_cast<float>(half * pixels.width() / pixels.height()),
                       static_cast<float>(half), static_cast<float>(range.nearest),
                       static_cast<float>(range.farthest));
    Eigen::Isometry3d X_WC(camera.orientation());
    X_WC.translation() = range.position;
    X_CW = X_WC.inverse();
  }

  void pass_to(QOpenGLShaderProgram& program) const {
    program.setUniformValue("lens", values);
    program.setUniformValue("parallel", is_parallel);
  }
};

namespace {

QVector3D to_qt(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

QMatrix3x3 to_qt(const Eigen::Matrix3f& matrix) { return QMatrix3x3(matrix.data()).transposed(); }

QMatrix4x4 to_qt(const Eigen::Matrix4f& matrix) { return QMatrix4x4(matrix.data()).transposed(); }

}  // namespace

SceneShading::SceneShading(SceneGraph& graph)
    : graph_(graph),
      distances_program_(make_screen_program(kDistances)),
      shade_program_(make_screen_program(kShade)),
      blur_program_(make_screen_program(kBlur)),
      multiply_program_(make_screen_program(kMultiply)) {
  initializeOpenGLFunctions();
  is_available_ = distances_program_ && shade_program_ && blur_program_ && multiply_program_;
}

SceneShading::~SceneShading() = default;

void SceneShading::shade(SoGLRenderAction& action, const OrbitCamera& camera, const QSize& pixels,
                         unsigned frame, bool only_still) {
  if (!is_available_) {
    return;
  }
  glPushAttrib(GL_ALL_ATTRIB_BITS);  // of this frame buffer; others have no colour
  is_available_ = draw_shadow_map(action, camera, only_still);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDisable(GL_LIGHTING);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  is_available_ = is_available_ && compute(camera, pixels, frame);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  glViewport(0, 0, pixels.width(), pixels.height());
  if (is_available_) {
    multiply(pixels);
  }
  for (const int unit : {1, 0}) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, 0);
  }
  glPopAttrib();
  action.invalidateState();
}

bool SceneShading::draw_shadow_map(SoGLRenderAction& action, const OrbitCamera& camera,
                                   bool only_still) {
  if (!shadow_map_.bind({kMapSize, kMapSize})) {
    return false;
  }
  const OrbitCamera::Placement& placement = camera.placement();
  const double radius = std::min(kMostAround, 1.5 * camera.seen_height(placement.distance));
  const LampView lamp =
      graph_.render_for_lamp(action, {kToLamp, placement.target, radius, only_still}, kMapSize);
  Eigen::Isometry3d X_WL(lamp.R_WL);
  X_WL.translation() = lamp.centre;
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();  // from the lamp's frame to [0, 1]³
  map.diagonal() << 1.0 / lamp.width, 1.0 / lamp.width, -1.0 / lamp.depth, 1.0;
  map.col(3).head<3>().setConstant(0.5);
  shadow_from_world_ = (map * X_WL.inverse().matrix()).cast<float>();
  R_WL_ = lamp.R_WL;
  shadow_size_ = Eigen::Vector2d(lamp.width, lamp.depth).cast<float>();
  return true;
}

bool SceneShading::compute(const OrbitCamera& camera, const QSize& pixels, unsigned frame) {
  const Lens lens(camera, pixels);
  return copy_depths(pixels, frame) && find_distances(lens, pixels) && find_shades(lens, pixels) &&
         blur(half_of(pixels));
}

bool SceneShading::copy_depths(const QSize& pixels, unsigned frame) {
  if (!depths_.bind(pixels)) {
    return false;
  }
  while (glGetError() != GL_NO_ERROR) {
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame);
  glBlitFramebuffer(0, 0, pixels.width(), pixels.height(), 0, 0, pixels.width(), pixels.height(),
                    GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  return glGetError() == GL_NO_ERROR;  // or the kinds of depth differ
}

bool SceneShading::find_distances(const Lens& lens, const QSize& pixels) {
  QVector4D ground;  // none
  if (const std::optional<FloorDisc> disc = graph_.floor_disc()) {
    const Eigen::Vector3d up = lens.X_CW.linear().col(2);
    ground = QVector4D(to_qt(up), static_cast<float>(up.dot(lens.X_CW * disc->centre)));
  }
  if (!distances_.bind(pixels)) {
    return false;
  }
  distances_program_->bind();
  lens.pass_to(*distances_program_);
  distances_program_->setUniformValue("depths", 0);
  distances_program_->setUniformValue("ground", ground);
  depths_.use(0);
  fill_viewport();
  return true;
}

bool SceneShading::find_shades(const Lens& lens, const QSize& pixels) {
  if (!shades_[0].bind(half_of(pixels))) {
    return false;
  }
  const Eigen::Matrix3d& R_CW = lens.X_CW.linear();
  const FloorDisc disc = graph_.floor_disc().value_or(FloorDisc{Eigen::Vector3d::Zero(), 1.0});
  QOpenGLShaderProgram& program = *shade_program_;
  program.bind();
  lens.pass_to(program);
  program.setUniformValue("distances", 0);
  program.setUniformValue("shadows", 1);
  program.setUniformValue("up", to_qt(Eigen::Vector3d(R_CW.col(2))));
  program.setUniformValue("middle", QVector4D(to_qt(Eigen::Vector3d(lens.X_CW * disc.centre)),
                                              static_cast<float>(disc.radius)));
  program.setUniformValue(
      "to_shadows",
      to_qt(Eigen::Matrix4f(shadow_from_world_ * lens.X_CW.inverse().matrix().cast<float>())));
  program.setUniformValue("lamp_frame",
                          to_qt(Eigen::Matrix3f((R_CW * R_WL_).transpose().cast<float>())));
  program.setUniformValue("map_size", QVector2D(shadow_size_.x(), shadow_size_.y()));
  program.setUniformValue("pixel", step_of(pixels));
  program.setUniformValue("reach", kOcclusionReach);
  program.setUniformValueArray("spiral", spiral_points(5.0, false).data(), kTaps);
  program.setUniformValueArray("disc", disc_points().data(), kTaps);
  shadow_map_.use(1);
  distances_.use(0);
  fill_viewport();
  return true;
}

bool SceneShading::blur(const QSize& size) {
  blur_program_->bind();
  blur_program_->setUniformValue("shades", 0);
  const QVector2D step = step_of(size);
  for (const std::size_t from : {0U, 1U}) {
    if (!shades_.at(1 - from).bind(size)) {
      return false;
    }
    blur_program_->setUniformValue(
        "along", from == 0 ? QVector2D(step.x(), 0.0F) : QVector2D(0.0F, step.y()));
    shades_.at(from).use(0);
    fill_viewport();
  }
  return true;
}

void SceneShading::multiply(const QSize& pixels) {
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  multiply_program_->bind();
  multiply_program_->setUniformValue("shades", 0);
  multiply_program_->setUniformValue("distances", 1);
  const QSize size = half_of(pixels);
  multiply_program_->setUniformValue(
      "size", QVector2D(static_cast<float>(size.width()), static_cast<float>(size.height())));
  distances_.use(1);
  shades_[0].use(0);
  fill_viewport();
  multiply_program_->release();
}

}  // namespace handway::gui
