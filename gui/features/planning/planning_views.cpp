#include "features/planning/planning_views.h"

#include "features/planning/frontier_display.h"
#include "features/planning/projection_tool.h"
#include "features/planning/region_tool.h"
#include "features/planning/roadmap_display.h"

namespace handway::gui {

PlanningViews::PlanningViews(Document& document, PathPlayer& player, PlanSettings& settings,
                             PlanPanel& panel, SceneView& view)
    : document_(document),
      settings_(settings),
      view_(view),
      region_(std::make_unique<RegionTool>(document, settings, panel, view)),
      projection_(std::make_unique<ProjectionTool>(document, player)) {}

PlanningViews::~PlanningViews() = default;

void PlanningViews::follow(PlanningSession& session, QAction& roadmap_shown,
                           QAction& hypercubes_shown) {
  hypercubes_ =
      std::make_unique<HypercubeDisplay>(document_, settings_, session, view_, hypercubes_shown);
  roadmap_ = std::make_unique<RoadmapDisplay>(session, view_, roadmap_shown, *hypercubes_,
                                              hypercubes_shown);
  frontier_ = std::make_unique<FrontierDisplay>(document_, session, view_);
  projection_->follow(session);
}

QWidget* PlanningViews::projection_panel() const { return projection_->panel(); }

}  // namespace handway::gui
