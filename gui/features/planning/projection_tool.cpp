#include "features/planning/projection_tool.h"

#include "features/planning/projection_panel.h"
#include "model/document/document.h"
#include "model/document/prepared_problem.h"
#include "model/planning/palm_roadmap.h"
#include "model/planning/planning_session.h"

#include <QObject>

#include <exception>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kPathPieces = 200;

std::vector<geometric::Configuration> close_together(const PathTimeline& timeline) {
  std::vector<geometric::Configuration> path;
  for (int i = 0; !timeline.empty() && i <= kPathPieces; ++i) {
    path.push_back(timeline.at(static_cast<double>(i) / kPathPieces));
  }
  return path;
}

}  // namespace

ProjectionTool::ProjectionTool(Document& document, PathPlayer& player, QObject* parent)
    : QObject(parent), document_(document), player_(player), panel_(new ProjectionPanel) {
  connect(&document_, &Document::configuration_changed, panel_, &ProjectionPanel::set_robot);
  connect(panel_, &ProjectionPanel::picked, this, [this](const Eigen::VectorXd& q) {
    player_.pause();
    document_.set_configuration(q);
  });
  connect(panel_, &ProjectionPanel::visibility_changed, this, [this](bool visible) {
    if (visible && outdated_) {
      update();
    }
  });
}

void ProjectionTool::follow(PlanningSession& session) {
  session_ = &session;
  connect(session_, &PlanningSession::roadmap_changed, this, &ProjectionTool::update);
  connect(session_, &PlanningSession::path_changed, this, &ProjectionTool::update);
}

void ProjectionTool::update() {
  const SharedRoadmap roadmap = session_->roadmap();
  if (!roadmap || !document_.problem()) {
    outdated_ = false;
    job_.cancel();
    panel_->show_nothing();
    return;
  }
  outdated_ = !panel_->isVisible();
  if (outdated_) {
    return;
  }
  job_.run(
      [this, roadmap, problem = document_.problem(), path = close_together(player_.timeline())](
          const std::stop_token& stop) -> LatestJob::Answer {
        try {
          if (PreparedProblem::Problem prepared = problem->wait(stop)) {
            return [this, found = charted(std::move(prepared), roadmap, path)] {
              panel_->show_roadmap(found);
              panel_->set_robot(document_.configuration());
            };
          }
        } catch (const std::exception&) {
          return [this] {
            panel_->show_nothing();
          };  // the planning session reports why there is no problem
        }
        return {};
      });
}

}  // namespace handway::gui
