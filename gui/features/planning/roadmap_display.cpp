#include "features/planning/roadmap_display.h"

#include "features/planning/hypercube_display.h"
#include "features/planning/roadmap_legend.h"
#include "model/planning/planning_session.h"
#include "view3d/roadmap_node.h"
#include "view3d/scene_view.h"

#include <Inventor/nodes/SoSeparator.h>
#include <QAction>

namespace handway::gui {

RoadmapDisplay::RoadmapDisplay(PlanningSession& session, SceneView& view, QAction& shown,
                               HypercubeDisplay& hypercubes, QAction& hypercubes_shown,
                               QObject* parent)
    : QObject(parent),
      session_(session),
      view_(view),
      shown_(shown),
      hypercubes_(hypercubes),
      legend_(new RoadmapLegend(hypercubes_shown, &view)) {
  connect(&hypercubes_, &HypercubeDisplay::changed, this, &RoadmapDisplay::show_legend);
  connect(&session_, &PlanningSession::ended, this, &RoadmapDisplay::show_legend);
  connect(&session_, &PlanningSession::roadmap_changed, this, &RoadmapDisplay::draw);
  connect(&shown_, &QAction::toggled, this, [this](bool on) {
    view_.set_overlay_visible(Overlay::kRoadmap, on);
    show_legend();
  });
}

void RoadmapDisplay::draw() {
  const SharedRoadmap& roadmap = session_.roadmap();
  if (roadmap && !roadmap->palms.empty()) {
    view_.set_overlay(Overlay::kRoadmap, make_roadmap_node(*roadmap).get());
  } else {
    view_.set_overlay(Overlay::kRoadmap, nullptr);
  }
  show_legend();
}

void RoadmapDisplay::show_legend() {
  legend_->show_roadmap(shown_.isChecked() ? session_.roadmap() : nullptr,
                        {session_.is_running(), hypercubes_.half_side()});
}

}  // namespace handway::gui
