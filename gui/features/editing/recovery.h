#pragma once

#include "model/document/autosave.h"
#include "model/document/scene_editor.h"
#include "model/planning/plan_settings.h"

#include <QObject>

namespace handway::gui {

class Banner;

/// Stores the scene after every edit, and offers what was lost before.
class Recovery : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  Recovery(Document& document, SceneEditor& editor, const PlanSettings& planning, Banner& banner,
           QObject* parent = nullptr);

  [[nodiscard]] Autosave& autosave() { return autosave_; }

  /// Whether unsaved changes are kept; those that are kept go at once when they shall not be.
  void set_enabled(bool enabled);
  /// Offers in the banner what was lost last, if anything was.
  void offer();

 signals:
  /// Scenes can't be stored; reported once until one can again.
  void failed(const QString& message);

 private:
  void recover(const LostScene& lost);
  void store(const std::optional<LostScene>& then_forget);

  Document& document_;
  SceneEditor& editor_;
  const PlanSettings& planning_;
  Banner& banner_;
  Autosave autosave_;
  std::optional<LostScene> recovering_;
  bool enabled_ = true;
  bool fails_ = false;
};

}  // namespace handway::gui
