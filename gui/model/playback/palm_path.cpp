#include "model/playback/palm_path.h"

namespace handway::gui {
namespace {

constexpr int kPieces = 240;

}  // namespace

PalmPath palm_path(const geometric::RobotInstance& robot, const PathTimeline& timeline, int link) {
  PalmPath result;
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  const auto palm_at = [&](const geometric::Configuration& q) -> Eigen::Vector3d {
    robot.model->forward_kinematics(q, X_BL);
    return robot.X_WB * X_BL[static_cast<std::size_t>(link)].translation();
  };
  if (timeline.empty()) {
    return result;
  }
  for (int i = 0; i <= kPieces; ++i) {
    result.points.push_back(palm_at(timeline.at(static_cast<double>(i) / kPieces)));
  }
  for (const geometric::Configuration& q : timeline.path().waypoints) {
    result.waypoints.push_back(palm_at(q));
  }
  return result;
}

}  // namespace handway::gui
