#include "features/planning/hypercube_display.h"

#include "features/planning/plan_panel.h"
#include "model/document/document.h"
#include "model/planning/planning_session.h"
#include "view3d/boxes_node.h"
#include "view3d/scene_view.h"

#include <Inventor/nodes/SoSeparator.h>
#include <QAction>

#include <algorithm>
#include <exception>

namespace handway::gui {

HypercubeDisplay::HypercubeDisplay(Document& document, PlanPanel& panel, PlanningSession& session,
                                   SceneView& view, QAction& shown, QObject* parent)
    : QObject(parent),
      document_(document),
      panel_(panel),
      session_(session),
      view_(view),
      shown_(shown) {
  connect(&session_, &PlanningSession::started, this, &HypercubeDisplay::begin_run);
  connect(&session_, &PlanningSession::roadmap_changed, this, &HypercubeDisplay::take_roadmap);
  connect(&shown_, &QAction::toggled, this, &HypercubeDisplay::take_roadmap);
}

void HypercubeDisplay::begin_run() {
  regions_ = planning::first_regions(*panel_.planner(), 0);
  const bool has_corridor =
      regions_.size() > 1 ||
      planning::parameter_called(panel_.planner()->parameters(), "rho_a") != nullptr;
  if (!has_corridor) {
    regions_.clear();
  }
}

std::size_t HypercubeDisplay::search() const {
  return static_cast<std::size_t>(session_.roadmap()->roadmap.winner.value_or(0));
}

std::optional<double> HypercubeDisplay::half_side() const {
  if (!session_.roadmap() || search() >= regions_.size()) {
    return std::nullopt;
  }
  double largest = 0.0;
  for (const auto& node : session_.roadmap()->roadmap.nodes) {
    if (static_cast<std::size_t>(node.search) == search()) {
      largest = std::max(largest, node.rho_a);
    }
  }
  return largest > 0.0 ? std::optional(largest) : std::nullopt;
}

void HypercubeDisplay::take_roadmap() {
  const std::optional<double> rho = half_side();
  if (!rho || !shown_.isChecked()) {
    clear();
    return;
  }
  Subject subject{regions_[search()], session_.roadmap()->roadmap.search_range};
  subject.region.rho_a = *rho;
  if (!drawn_ || drawn_->region.rho_a != *rho || drawn_->range != subject.range ||
      drawn_->region.corridor != subject.region.corridor) {
    draw(subject);
  }
}

void HypercubeDisplay::clear() {
  job_.cancel();
  drawn_.reset();
  boxes_.clear();
  view_.set_overlay(Overlay::kHypercubes, nullptr);
  emit changed();
}

void HypercubeDisplay::draw(const Subject& subject) {
  drawn_ = subject;
  job_.run([this, subject, problem = document_.problem(),
            palm = document_.palm()](const std::stop_token& stop) -> LatestJob::Answer {
    try {
      const PreparedProblem::Problem prepared = problem->wait(stop);
      if (!prepared) {
        return {};
      }
      return [this, subject,
              boxes = planning::palm_boxes(*prepared, palm, subject.region, kMostBoxes, stop)] {
        boxes_ = boxes;
        view_.set_overlay(Overlay::kHypercubes, make_boxes_node(boxes, subject.range).get());
        emit changed();
      };
    } catch (const std::exception&) {
      return [this] { clear(); };  // planning has said what is wrong
    }
  });
}

}  // namespace handway::gui
