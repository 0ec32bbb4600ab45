#include "features/playback/path_traces.h"

#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/setup/swept_volume.h"
#include "model/document/document.h"
#include "model/meshes/shaded_meshes.h"
#include "model/playback/path_player.h"
#include "model/playback/path_timeline.h"
#include "view3d/overlay.h"
#include "view3d/path_drawings.h"
#include "view3d/scene_view.h"

#include <QAction>
#include <QMenu>

#include <utility>

namespace handway::gui {
namespace {

constexpr int kCopies = 8;       // postures shown
constexpr int kPostures = 160;   // that a swept volume is made of
constexpr double kCell = 0.012;  // m

std::vector<geometric::Configuration> spread(const PathTimeline& timeline, int count) {
  std::vector<geometric::Configuration> postures;
  postures.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    postures.push_back(timeline.at(static_cast<double>(i) / (count - 1)));
  }
  return postures;
}

}  // namespace

PathTraces::PathTraces(Document& document, PathPlayer& player, SceneView& view, QMenu& menu,
                       QObject* parent)
    : QObject(parent),
      document_(document),
      player_(player),
      view_(view),
      trails_(add(menu, QStringLiteral("trails"), tr("&Fingertip paths"),
                  tr("Draw the path of each fingertip"))),
      postures_(add(menu, QStringLiteral("copies"), tr("&Postures along the path"),
                    tr("Draw the robot at even times along the path, from green to orange"))),
      volume_(add(menu, QStringLiteral("volume"), tr("Swept &volume"),
                  tr("Draw the swept volume of the robot"))) {
  connect(trails_, &QAction::toggled, this, &PathTraces::update_trails);
  connect(postures_, &QAction::toggled, this, [this](bool on) {
    if (on) {
      volume_->setChecked(false);
    }
    update_veil();
  });
  connect(volume_, &QAction::toggled, this, [this](bool on) {
    if (on) {
      postures_->setChecked(false);
    }
    update_veil();
  });
  connect(&player_, &PathPlayer::timeline_changed, this, &PathTraces::update_all);
  connect(&player_, &PathPlayer::retimed, this, &PathTraces::update_all);
  connect(&document_, &Document::hand_changed, this, &PathTraces::update_trails);
}

QAction* PathTraces::add(QMenu& menu, const QString& name, const QString& text,
                         const QString& tip) {
  QAction* action = menu.addAction(text);
  action->setObjectName(name);
  action->setCheckable(true);
  action->setToolTip(tip);
  return action;
}

void PathTraces::update_all() {
  update_trails();
  update_veil();
}

void PathTraces::update_trails() {
  const geometric::RobotInstance* robot = document_.robot();
  if (!robot || player_.timeline().empty() || !trails_->isChecked()) {
    view_.set_overlay(Overlay::kTrails, nullptr);
    return;
  }
  std::vector<std::vector<Eigen::Vector3d>> trails;
  for (const int link : geometric::fingertips(*robot->model, document_.joints().hand)) {
    trails.push_back(palm_path(*robot, player_.timeline(), link).points);
  }
  view_.set_overlay(Overlay::kTrails, make_trails_node(trails));
}

void PathTraces::update_veil() {
  job_.cancel();
  const bool has_path = document_.robot() && !player_.timeline().empty();
  if (has_path && volume_->isChecked()) {
    find_volume();
  } else if (has_path && postures_->isChecked()) {
    view_.set_traces(make_copies_node(*document_.robot(), spread(player_.timeline(), kCopies)));
  } else {
    view_.set_traces(nullptr);
  }
}

void PathTraces::find_volume() {
  job_.run([this, robot = *document_.robot(), postures = spread(player_.timeline(), kPostures)](
               const std::stop_token& stop) -> LatestJob::Answer {
    const auto mesh =
        std::make_shared<const geometric::TriangleMesh>(swept_volume(robot, postures, kCell, stop));
    static_cast<void>(shaded(mesh));  // takes its time, too
    return [this, mesh] { view_.set_traces(make_volume_node(mesh)); };
  });
}

}  // namespace handway::gui
