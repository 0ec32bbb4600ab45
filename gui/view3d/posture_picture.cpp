#include "view3d/posture_picture.h"

#include <utility>

namespace handway::gui {
namespace {

constexpr double kMargin = 1.02;

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
    : pictures_(scene_of(robot)) {
  camera_.set_placement(placement);
  camera_.fit(pictures_.points_of_interest(), 1.0, kMargin);
}

QImage PosturePictures::picture(const geometric::Configuration& q, const QSize& size) {
  return pictures_.picture(q, camera_, size);
}

}  // namespace handway::gui
