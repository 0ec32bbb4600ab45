#include "view3d/posture_picture.h"

#include "handway/geometric/io/input_error.h"
#include "view3d/scene_graph.h"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QSurfaceFormat>

#include <GL/gl.h>

namespace handway::gui {
namespace {

constexpr int kSamples = 8;
constexpr int kOversampling = 2;
constexpr double kMargin = 1.02;

[[noreturn]] void refuse() {
  throw geometric::InputError({"pictures", "", "no OpenGL on this display",
                               "a display that OpenGL can draw for",
                               "Install libgl1-mesa-dri, or use xvfb-run"});
}

std::shared_ptr<const geometric::Scene> scene_of(
    const std::shared_ptr<const geometric::RobotModel>& robot) {
  auto scene = std::make_shared<geometric::Scene>();
  geometric::RobotInstance instance;
  instance.name = robot->name();
  instance.model = robot;
  instance.configuration = robot->neutral();
  scene->robots.push_back(std::move(instance));
  // What the camera has to see: both ends of the joints' ranges.
  scene->start = robot->lower();
  scene->goal = robot->upper();
  return scene;
}

}  // namespace

PosturePictures::PosturePictures(const std::shared_ptr<const geometric::RobotModel>& robot,
                                 const OrbitCamera::Placement& placement)
    : surface_(std::make_unique<QOffscreenSurface>()),
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
  graph_->set_scene(scene_of(robot));
  graph_->set_floor_visible(false);
  graph_->show_ghosts(false, false);
  camera_.set_placement(placement);
  camera_.fit(graph_->points_of_interest(), 1.0, kMargin);
}

PosturePictures::~PosturePictures() {
  context_->makeCurrent(surface_.get());
  action_.reset();
  graph_.reset();
  context_->doneCurrent();
}

QImage PosturePictures::picture(const geometric::Configuration& q, const QSize& size) {
  context_->makeCurrent(surface_.get());
  QOpenGLFramebufferObjectFormat format;
  format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
  format.setSamples(kSamples);
  QOpenGLFramebufferObject buffer(kOversampling * size, format);
  if (!buffer.isValid() || !buffer.bind()) {
    refuse();
  }
  glViewport(0, 0, buffer.width(), buffer.height());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  graph_->set_configuration(q);
  action_->invalidateState();
  action_->setViewportRegion(
      SbViewportRegion(static_cast<short>(buffer.width()), static_cast<short>(buffer.height())));
  graph_->aim(camera_, static_cast<double>(size.width()) / size.height());
  graph_->render(*action_);
  glFinish();
  buffer.release();
  return buffer.toImage()
      .convertToFormat(QImage::Format_RGB32)
      .scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

}  // namespace handway::gui
