#include "view3d/scene_pictures.h"

#include "handway/geometric/io/input_error.h"
#include "view3d/coin_conversions.h"
#include "view3d/grasp_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_graph.h"
#include "view3d/scene_shading.h"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLFramebufferObject>
#include <QSurfaceFormat>

#include <GL/gl.h>

#include <utility>

namespace handway::gui {
namespace {

constexpr int kSamples = 8;

[[noreturn]] void refuse() {
  throw geometric::InputError({"pictures", "", "no OpenGL on this display",
                               "a display that OpenGL can draw for",
                               "Install libgl1-mesa-dri, or use xvfb-run"});
}

}  // namespace

ScenePictures::ScenePictures(const std::shared_ptr<const geometric::Scene>& scene, int oversampling)
    : oversampling_(oversampling),
      surface_(std::make_unique<QOffscreenSurface>()),
      context_(std::make_unique<QOpenGLContext>()) {
  QSurfaceFormat format;
  format.setDepthBufferSize(24);
  surface_->setFormat(format);
  surface_->create();
  context_->setFormat(format);
  if (!context_->create() || !context_->makeCurrent(surface_.get())) {
    refuse();
  }
  if (!SoDB::isInitialized()) {
    SoDB::init();
  }
  graph_ = std::make_unique<SceneGraph>();
  action_ = std::make_unique<SoGLRenderAction>(SbViewportRegion());
  shading_ = std::make_unique<SceneShading>(*graph_);
  graph_->set_scene(scene);
  graph_->set_floor_visible(false);
  graph_->show_ghosts(false, false);
}

ScenePictures::~ScenePictures() {
  context_->makeCurrent(surface_.get());
  drop_fence();
  drawn_.reset();
  resolved_.reset();
  shading_.reset();
  action_.reset();
  graph_.reset();
  context_->doneCurrent();
}

std::vector<Eigen::Vector3d> ScenePictures::points_of_interest() const {
  return graph_->points_of_interest();
}

QImage ScenePictures::picture(const geometric::Configuration& q, const OrbitCamera& camera,
                              const QSize& size) {
  begin({q}, camera, size);
  return take();
}

void ScenePictures::make_buffers(const QSize& pixels) {
  if (drawn_ && drawn_->size() == pixels) {
    return;
  }
  QOpenGLFramebufferObjectFormat format;
  format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
  format.setSamples(kSamples);
  drawn_ = std::make_unique<QOpenGLFramebufferObject>(pixels, format);
  resolved_ = std::make_unique<QOpenGLFramebufferObject>(pixels);
  if (!drawn_->isValid() || !resolved_->isValid()) {
    refuse();
  }
}

void ScenePictures::begin(const FilmMoment& moment, const OrbitCamera& camera, const QSize& size) {
  context_->makeCurrent(surface_.get());
  drop_fence();
  size_ = size;
  make_buffers(oversampling_ * size);
  drawn_->bind();
  glViewport(0, 0, drawn_->width(), drawn_->height());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  graph_->set_configuration(moment.q);
  for (const auto& [item, X_WO] : moment.X_WO) {
    graph_->preview(item, X_WO);
  }
  graph_->set_overlay(Overlay::kGrasp,
                      moment.forces.empty() ? nullptr : make_forces_node(moment.forces));
  action_->invalidateState();
  action_->setViewportRegion(viewport_of(drawn_->size()));
  graph_->aim(camera, static_cast<double>(size.width()) / size.height());
  graph_->render_bodies(*action_);
  drawn_->release();
  camera_ = camera;
  stage_ = Stage::kBodies;
  set_fence();
}

void ScenePictures::set_fence() {
  drop_fence();
  if (context_->hasExtension(QByteArrayLiteral("GL_ARB_sync"))) {
    fence_ = context_->extraFunctions()->glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  }
  glFlush();
}

// Each stage would wait for the one before it.
void ScenePictures::advance() {
  if (stage_ == Stage::kBodies) {
    shade();
    stage_ = Stage::kShaded;
  } else {
    QOpenGLFramebufferObject::blitFramebuffer(resolved_.get(), drawn_.get());
    stage_ = Stage::kResolved;
  }
}

void ScenePictures::shade() {
  drawn_->bind();
  action_->invalidateState();
  shading_->shade(*action_, camera_, drawn_->size(), drawn_->handle());
  action_->setViewportRegion(viewport_of(drawn_->size()));
  graph_->render_drawings(*action_);
  graph_->render_ghosts(*action_);
  drawn_->release();
}

void ScenePictures::drop_fence() {
  if (fence_ != nullptr) {
    context_->extraFunctions()->glDeleteSync(fence_);
    fence_ = nullptr;
  }
}

bool ScenePictures::is_drawn() {
  context_->makeCurrent(surface_.get());
  if (fence_ != nullptr &&
      context_->extraFunctions()->glClientWaitSync(fence_, 0, 0) == GL_TIMEOUT_EXPIRED) {
    return false;
  }
  if (stage_ == Stage::kResolved) {
    return true;
  }
  advance();
  set_fence();
  return false;
}

QImage ScenePictures::take() {
  context_->makeCurrent(surface_.get());
  drop_fence();
  while (stage_ != Stage::kResolved) {
    advance();
  }
  return resolved_->toImage()
      .convertToFormat(QImage::Format_RGB32)
      .scaled(size_, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

namespace {

constexpr double kPostureMargin = 1.02;

std::shared_ptr<const geometric::Scene> scene_of(
    const std::shared_ptr<const geometric::RobotModel>& robot) {
  auto scene = std::make_shared<geometric::Scene>();
  geometric::RobotInstance instance;
  instance.name = robot->name();
  instance.model = robot;
  instance.configuration = robot->neutral();
  scene->robots.push_back(std::move(instance));
  // The camera has to see both ends of the joints' ranges.
  scene->start = robot->lower();
  scene->goal = robot->upper();
  return scene;
}

}  // namespace

PosturePictures::PosturePictures(const std::shared_ptr<const geometric::RobotModel>& robot,
                                 const OrbitCamera::Placement& placement)
    : pictures_(scene_of(robot)) {
  camera_.set_placement(placement);
  camera_.fit(pictures_.points_of_interest(), 1.0, kPostureMargin);
}

QImage PosturePictures::picture(const geometric::Configuration& q, const QSize& size) {
  return pictures_.picture(q, camera_, size);
}

}  // namespace handway::gui
