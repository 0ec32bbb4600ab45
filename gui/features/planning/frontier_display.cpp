#include "features/planning/frontier_display.h"

#include "features/planning/frontier_legend.h"
#include "model/document/document.h"
#include "model/planning/planning_session.h"
#include "view3d/scene_view.h"

#include <algorithm>
#include <utility>

namespace handway::gui {

FrontierDisplay::FrontierDisplay(Document& document, PlanningSession& session, SceneView& view,
                                 QObject* parent)
    : QObject(parent), document_(document), view_(view), legend_(new FrontierLegend(&view)) {
  connect(&session, &PlanningSession::started, this, &FrontierDisplay::clear);
  connect(&session, &PlanningSession::run_ended, this, &FrontierDisplay::note);
  connect(&session, &PlanningSession::ended, this, [this](bool solved) {
    if (!solved && last_) {
      shown_ = std::exchange(last_, std::nullopt);
      show();
    }
  });
  connect(&session, &PlanningSession::path_changed, this, &FrontierDisplay::clear);
  connect(&document_, &Document::opened, this, &FrontierDisplay::clear);
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      clear();
    }
  });
  connect(legend_, &FrontierLegend::closed, this, &FrontierDisplay::clear);
  connect(legend_, &FrontierLegend::visited, this, [this](bool from_start) {
    const planning::SearchReach& reach = *shown_->reach;
    document_.set_configuration(from_start ? reach.farthest_from_start : reach.farthest_from_goal);
  });
}

void FrontierDisplay::note(const PathRecord& record) {
  const planning::PlanResult& result = record.run->result;
  if (!result.solved() && result.reach) {
    last_ = result;
  }
}

void FrontierDisplay::show() {
  const planning::PlanResult& result = *shown_;
  Frontier frontier{result.reach->farthest_from_start, result.reach->farthest_from_goal, {}};
  const auto& rejections = result.statistics.rejections;
  const auto most = std::ranges::max_element(rejections, {},
                                             [](const auto& rejected) { return rejected.second; });
  if (most != rejections.end() && !most->first.second.empty()) {
    frontier.colliding = {most->first.first, most->first.second};
  }
  view_.show_frontier(frontier);
  legend_->show_frontier(*result.reach, frontier.colliding);
}

void FrontierDisplay::clear() {
  last_.reset();
  if (shown_) {
    shown_.reset();
    legend_->hide();
    view_.show_frontier({});
  }
}

}  // namespace handway::gui
