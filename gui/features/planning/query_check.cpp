#include "features/planning/query_check.h"

#include "features/planning/doctor_card.h"
#include "features/postures/posing.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "view3d/scene_view.h"

namespace handway::gui {

QueryCheck::QueryCheck(Document& document, SceneEditor& editor, Posing& posing, SceneView& view,
                       QObject* parent)
    : QObject(parent), document_(document), view_(view), card_(new DoctorCard(&view)) {
  connect(&document_, &Document::opened, this, &QueryCheck::examine);
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      examine();
    }
  });
  connect(&doctor_, &QueryDoctor::diagnosed, this, &QueryCheck::take);
  connect(card_, &DoctorCard::shown, &posing, &Posing::set);
  connect(card_, &DoctorCard::accepted, &editor, [&editor](bool is_start, const auto& q) {
    is_start ? editor.set_start(q) : editor.set_goal(q);
  });
}

void QueryCheck::examine() { doctor_.examine(document_.scene(), document_.problem()); }

void QueryCheck::take(const std::vector<EndDiagnosis>& ends) {
  std::vector<Eigen::Vector3d> places;
  if (!ends.empty()) {
    for (const geometric::Contact& contact : ends.front().contacts) {
      places.push_back(contact.p_W);
    }
  }
  view_.set_contacts(places);
  card_->show_diagnoses(document_.robot() ? document_.robot()->model : nullptr, ends);
}

}  // namespace handway::gui
