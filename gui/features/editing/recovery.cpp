#include "features/editing/recovery.h"

#include "widgets/panels/floating_card.h"

#include <QLocale>

#include <utility>

namespace handway::gui {

Recovery::Recovery(Document& document, SceneEditor& editor, const PlanSettings& planning,
                   Banner& banner, QObject* parent)
    : QObject(parent),
      document_(document),
      editor_(editor),
      planning_(planning),
      banner_(banner),
      autosave_(Autosave::default_folder()) {
  connect(&autosave_, &Autosave::stored, this, [this] { fails_ = false; });
  connect(&autosave_, &Autosave::failed, this, [this](const QString& message) {
    if (!std::exchange(fails_, true)) {
      emit failed(message);
    }
  });
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      store(std::nullopt);
    }
  });
  connect(&editor_.undo_stack(), &QUndoStack::cleanChanged, this, [this](bool clean) {
    if (clean) {
      autosave_.clear();
    }
  });
  connect(&document_, &Document::opened, this, [this] {
    if (recovering_ && document_.file() == recovering_->file) {
      editor_.undo_stack().resetClean();
      store(recovering_);
    } else {
      autosave_.clear();
    }
    recovering_.reset();
  });
  connect(&document_, &Document::open_failed, this, [this] { recovering_.reset(); });
}

void Recovery::set_enabled(bool enabled) {
  if (enabled != enabled_) {
    enabled_ = enabled;
    if (!enabled) {
      autosave_.clear();
    } else if (document_.scene() && !editor_.undo_stack().isClean()) {
      store(std::nullopt);
    }
  }
}

void Recovery::store(const std::optional<LostScene>& then_forget) {
  if (!enabled_) {
    return;
  }
  const QString name = QString::fromStdString(document_.scene()->name);
  autosave_.store(
      {document_.loaded(), document_.configuration(), planning_.choice(), document_.file(), name},
      then_forget);
}

void Recovery::offer() {
  const std::vector<LostScene> lost = autosave_.find_lost();
  if (lost.empty()) {
    return;
  }
  const LostScene& last = lost.front();
  const QString name = !last.name.isEmpty() ? last.name
                       : last.file.empty()  ? tr("a new scene")
                                            : QString::fromStdString(last.file.filename().string());
  banner_.offer(
      tr("Unsaved changes to %1").arg(name),
      tr("The program ended without saving them, %1.")
          .arg(QLocale().toString(last.time, QLocale::ShortFormat)),
      tr("Recover"), [this, last] { recover(last); }, tr("Discard"),
      [last] { Autosave::forget(last); });
}

void Recovery::recover(const LostScene& lost) {
  recovering_ = lost;
  document_.open_copy(lost.scene, lost.file);
}

}  // namespace handway::gui
