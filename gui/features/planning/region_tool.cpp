#include "features/planning/region_tool.h"

#include "features/planning/plan_panel.h"
#include "features/planning/region_preview_box.h"
#include "model/document/document.h"
#include "view3d/region_node.h"
#include "view3d/scene_view.h"

#include <Inventor/nodes/SoSeparator.h>
#include <QScopedValueRollback>

#include <exception>

namespace handway::gui {
namespace {

constexpr int kConfigurations = 700;

}  // namespace

RegionTool::RegionTool(Document& document, PlanPanel& panel, SceneView& view, QObject* parent)
    : QObject(parent), document_(document), panel_(panel), view_(view), box_(new RegionPreviewBox) {
  panel_.add_section(box_);
  connect(&panel_, &PlanPanel::settings_changed, this, &RegionTool::read_planner);
  connect(&document_, &Document::opened, this, &RegionTool::read_planner);
  connect(&document_, &Document::edited, this, &RegionTool::update);
  connect(box_, &RegionPreviewBox::changed, this, &RegionTool::update);
  connect(box_, &RegionPreviewBox::rho_edited, this, [this](double rho) {
    const QScopedValueRollback writing(busy_writing_, true);
    panel_.enter("rho_a", rho);
  });
  connect(box_, &RegionPreviewBox::pmds_edited, this, [this](int pmds) {
    const QScopedValueRollback writing(busy_writing_, true);
    panel_.enter("max_pmds", pmds);
  });
  read_planner();
}

void RegionTool::read_planner() {
  if (busy_writing_ || !panel_.planner()) {
    return;
  }
  const auto& basis = document_.loaded().basis;
  const int directions = basis ? static_cast<int>(basis->directions.size()) : 0;
  box_->show_region(planning::first_region(*panel_.planner(), directions), directions,
                    planning::parameter_called(panel_.planner()->parameters(), "rho_a") != nullptr);
  update();
}

void RegionTool::clear() {
  job_.cancel();
  shown_ = false;
  view_.set_overlay(Overlay::kRegion, nullptr);
}

void RegionTool::update() {
  const auto& scene = document_.scene();
  if (!box_->is_on() || !box_->region() || !scene || !scene->start || !scene->goal ||
      !document_.problem()) {
    clear();
    return;
  }
  job_.run([this, problem = document_.problem(), palm = document_.palm(),
            region = *box_->region()](const std::stop_token& stop) -> LatestJob::Answer {
    try {
      const PreparedProblem::Problem prepared = problem->wait(stop);
      if (!prepared) {
        return {};
      }
      const planning::RegionPreview preview(*prepared, palm);
      return [this, draws = preview.draw(region, kConfigurations, stop)] {
        shown_ = true;
        box_->show_draws(draws);
        view_.set_overlay(Overlay::kRegion, make_region_node(draws).get());
      };
    } catch (const std::exception& error) {
      return [this, message = QString::fromUtf8(error.what())] {
        clear();
        box_->show_failure(message);
      };
    }
  });
}

}  // namespace handway::gui
