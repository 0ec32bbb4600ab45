#pragma once

#include "app/document.h"
#include "editing/scene_state.h"
#include "view3d/scene_item.h"

#include <QObject>
#include <QString>
#include <QUndoStack>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Edits the document's scene, one named entry of the undo stack for each edit,
/// and knows what is selected. An edit of a locked object does nothing.
class SceneEditor : public QObject {
  Q_OBJECT

 public:
  /// @param document outlives the editor.
  explicit SceneEditor(Document& document, QObject* parent = nullptr);

  [[nodiscard]] QUndoStack& undo_stack() { return stack_; }
  [[nodiscard]] const SceneState& state() const { return document_.state(); }
  [[nodiscard]] const Document& document() const { return document_; }

  [[nodiscard]] const SceneItem& selection() const { return selection_; }
  void select(const SceneItem& item);
  /// The selected object; nullptr if something else is selected.
  [[nodiscard]] const geometric::SceneObject* selected_object() const;
  /// Is there a selected object that is not locked?
  [[nodiscard]] bool can_change() const;
  /// Of the selected object or robot, or the palm of the selected posture, in the world.
  [[nodiscard]] std::optional<geometric::Pose> selected_pose() const;

  /// Adds an object and selects it. @param foot where the middle of its underside goes (world).
  void add(const std::string& name, const geometric::Shape& shape, const geometric::Color& color,
           const Eigen::Vector3d& foot);
  /// @throws InputError if the mesh can't be read.
  void add_mesh(const std::filesystem::path& file, const Eigen::Vector3d& foot);

  // Edits of what is selected.
  void remove();
  void duplicate();
  void rename(const std::string& name);
  /// Moves an object or a robot; of a posture it tells palm_placed(). @param X_WO in the world.
  void place(const geometric::Pose& X_WO);
  /// What place() would make of an object; nothing for anything else.
  [[nodiscard]] std::optional<SceneState> placed(const geometric::Pose& X_WO) const;
  void set_shape(const geometric::Shape& shape);
  void set_color(const geometric::Color& color);
  /// Lowers (or lifts) the object until it stands on what is below it, or on the floor.
  void drop();
  void set_hidden(const std::string& object, bool hidden);
  void set_locked(const std::string& object, bool locked);
  /// Fixes the object to a link, where both are now. @param touching links that may touch it.
  void attach(const std::string& robot, const std::string& link,
              const std::vector<std::string>& touching);
  void detach();

  /// The configuration of a posture; nothing of anything else.
  [[nodiscard]] std::optional<geometric::Configuration> posture(const SceneItem& item) const;
  void set_start(const geometric::Configuration& q);
  void set_goal(const geometric::Configuration& q);

 signals:
  void selection_changed(const handway::gui::SceneItem& item);
  /// The palm of a posture is to go there.
  void palm_placed(const handway::gui::SceneItem& item, const handway::geometric::Pose& X_WP);

 private:
  class Command;
  /// @param merge_key edits with the same key that follow each other at once become one; empty:
  /// never.
  void push(const QString& text, SceneState next, const SceneItem& select,
            const std::string& merge_key = {});
  void change_selected(const QString& text, const std::string& what,
                       const std::function<void(geometric::SceneObject&)>& change);

  Document& document_;
  QUndoStack stack_;
  SceneItem selection_;
};

}  // namespace handway::gui
