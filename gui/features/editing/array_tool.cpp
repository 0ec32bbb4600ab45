#include "features/editing/array_tool.h"

#include "features/editing/array_card.h"
#include "model/document/scene_editor.h"
#include "model/document/scene_edits.h"
#include "view3d/scene_view.h"

#include <utility>

namespace handway::gui {

ArrayTool::ArrayTool(SceneEditor& editor, SceneView& view, QObject* parent)
    : QObject(parent), editor_(editor), view_(view), card_(new ArrayCard(&view)) {
  connect(card_, &ArrayCard::changed, this, &ArrayTool::show_copies);
  connect(card_, &ArrayCard::accepted, this, &ArrayTool::finish);
  connect(card_, &ArrayCard::closed, this, &ArrayTool::end);
  connect(&editor_, &SceneEditor::selection_changed, this, &ArrayTool::end);
}

void ArrayTool::begin() {
  names_ = editor_.selected_objects();
  if (names_.empty()) {
    return;
  }
  card_->begin(SceneEditor::words_for(names_),
               bounds(*editor_.state().scene, editor_.document().configuration(), names_));
  show_copies();
}

void ArrayTool::show_copies() {
  const geometric::Configuration& q = editor_.document().configuration();
  const Eigen::Vector3d p_W = bounds(*editor_.state().scene, q, names_).centre();
  const std::vector<geometric::Pose> motions = card_->motions(p_W);
  const auto count = static_cast<int>(motions.size() * names_.size());
  card_->show_count(count, kMostCopies);
  copies_ = copied(editor_.state(), q, names_,
                   count > kMostCopies ? std::vector<geometric::Pose>{} : motions);
  view_.update_scene(copies_.state);
}

void ArrayTool::finish() {
  ObjectNames all = names_;
  all.insert(all.end(), copies_.names.begin(), copies_.names.end());
  SceneState made = copies_.state;
  if (card_->groups()) {
    const std::string group =
        unused_group(*made.scene, names_.size() == 1 ? names_.front() : tr("array").toStdString());
    made = with_changed_objects(made, all,
                                [&](geometric::SceneObject& object) { object.group = group; });
  }
  editor_.apply(tr("Array of %1").arg(SceneEditor::words_for(names_)), std::move(made), all);
}

void ArrayTool::end() {
  if (std::exchange(names_, {}).empty()) {
    return;
  }
  card_->hide();
  copies_ = {};
  if (editor_.state().scene) {
    view_.update_scene(editor_.state());
  }
}

}  // namespace handway::gui
