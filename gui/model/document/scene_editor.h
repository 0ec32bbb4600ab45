#pragma once

#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/robot_edits.h"
#include "model/document/document.h"
#include "model/document/selection.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>
#include <QUndoStack>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Edits the document's scene, one named entry of the undo stack for each edit,
/// and knows what is selected. Edits of several objects leave locked ones alone.
class SceneEditor : public QObject {
  Q_OBJECT

 public:
  /// @param document outlives the editor.
  explicit SceneEditor(Document& document, QObject* parent = nullptr);

  [[nodiscard]] QUndoStack& undo_stack() { return stack_; }
  /// Returns whether there are edits that the scene's file does not hold yet.
  [[nodiscard]] bool is_modified() const;
  [[nodiscard]] const planning::SceneState& state() const { return document_.state(); }
  [[nodiscard]] const Document& document() const { return document_; }

  /// Returns the item that was selected last.
  [[nodiscard]] const SceneItem& selection() const { return selection_.item; }
  /// The objects that are selected; none if something else is.
  [[nodiscard]] const std::vector<std::string>& selected_objects() const {
    return selection_.objects;
  }
  [[nodiscard]] bool has_several() const { return selection_.objects.size() > 1; }
  [[nodiscard]] const Selection& whole_selection() const { return selection_; }
  void select(const SceneItem& item);
  void select_objects(std::vector<std::string> names);
  /// A click in the view. @param add with Ctrl or Shift.
  void click(const SceneItem& item, bool add);
  /// The object that was selected last; nullptr if something else is selected.
  [[nodiscard]] const geometric::SceneObject* selected_object() const;
  /// The selected objects that are not locked.
  [[nodiscard]] std::vector<std::string> changeable() const;
  [[nodiscard]] bool can_change() const { return !changeable().empty(); }
  /// Returns the pose in the world of the selected object or robot (mounted ones too), or of the
  /// palm of the selected posture. For several objects it is the middle of the box around those
  /// that can be changed, along the world's axes.
  [[nodiscard]] std::optional<geometric::Pose> selected_pose() const;

  /// Adds an object and selects it. @param foot where the middle of its underside goes (world).
  /// @param R_WO of the object's axes.
  void add(const std::string& name, const geometric::Shape& shape, const geometric::Color& color,
           const Eigen::Vector3d& foot, const Eigen::Matrix3d& R_WO = Eigen::Matrix3d::Identity());

  /// Adds objects as they are, but for names of their own, as one edit, and selects them.
  void add_objects(const std::vector<geometric::SceneObject>& objects);

  /// Adds a room or a cell, whose walls alone count, and selects it. @param X_WO where it is.
  void add_room(const std::string& name, const geometric::Shape& shape,
                const geometric::Color& color, const geometric::Pose& X_WO);

  /// Returns the place for a new object, see free_foot(): onto the selection if that is much
  /// larger, or beside it; without a selection beside `wanted`.
  /// @param size m. @pre there is a scene.
  [[nodiscard]] Eigen::Vector3d place_for(const Eigen::Vector3d& size,
                                          const Eigen::Vector3d& wanted) const;

  /// Returns the body of the selection's constraints: a carried object, a link of the first robot,
  /// the palm of the robot as shown. It is empty if there is none.
  [[nodiscard]] std::string constrained_body() const;
  /// Adds a constraint, or changes the one of that name.
  void set_constraint(const geometric::PathConstraint& constraint);
  void remove_constraint(const std::string& name);

  /// Called when an edit of robots has ended, with the problem that prevented it, or nothing.
  using Outcome = std::function<void(const QString& problem)>;
  /// Edits of robots make their model in the background: the scene shows them once that is there.
  [[nodiscard]] bool is_composing() const { return composing_.is_busy(); }
  /// Adds a robot and selects it. @param on nothing: it stands in the world at its X_WB.
  void add_robot(geometric::RobotInstance robot, const std::optional<planning::LinkOfRobot>& on,
                 const geometric::Pose& X_LB, Outcome outcome);
  /// Mounts a robot, or one that is mounted already, on another link, at its origin; or takes it
  /// off where `on` is nothing.
  void mount(const std::string& robot, const std::optional<planning::LinkOfRobot>& on);
  /// Replaces the model of a robot or part by one with other groups, or other pairs of links that
  /// may touch.
  void set_model(const std::string& robot, std::shared_ptr<const geometric::RobotModel> model,
                 Outcome outcome);
  /// Returns whether the selection is a robot that can be removed; the last robot of a scene can't.
  [[nodiscard]] bool can_remove_robot() const;
  /// Plans for the selected robot from now on.
  void put_first(const std::string& robot);

  // Edits of what is selected.
  void remove();
  /// A copy in free space beside it.
  void duplicate();
  /// The selected objects as YAML, to be pasted here, into another scene or into a file.
  /// @throws InputError if a mesh that has no file can't be saved in the user's cache.
  [[nodiscard]] std::string copied() const;
  /// Adds what was copied, in free space as near as can be to where it was.
  /// @throws InputError if it is none.
  void paste(const std::string& text);
  /// Moves objects that aren't locked together into free space as near as possible to a place.
  void put_at(const std::vector<std::string>& objects, const Eigen::Vector3d& foot);
  /// Makes objects that aren't locked members of a group, or of none (empty).
  void move_into_group(const std::vector<std::string>& objects, const std::string& group);
  /// Renames the selected object or frame. A name of another one gets a number; that of a link or a
  /// robot is refused.
  void rename(const std::string& name);
  /// Moves objects or a robot so that selected_pose() becomes `X_WO`; of a posture it
  /// emits palm_placed().
  void place(const geometric::Pose& X_WO);
  /// Returns the result of place() for objects; nothing for anything else.
  [[nodiscard]] std::optional<planning::SceneState> placed(const geometric::Pose& X_WO) const;
  /// @param X_WO where the resized object goes.
  void set_shape(const geometric::Shape& shape, const std::optional<geometric::Pose>& X_WO = {});
  void set_color(const geometric::Color& color);
  /// Lowers (or lifts) the objects until they stand kRestingGap above what is below, or on the
  /// floor.
  void drop();
  void set_hidden(const std::vector<std::string>& objects, bool hidden);
  void set_locked(const std::vector<std::string>& objects, bool locked);
  /// Sets whether closed shapes are filled; locked objects are not changed.
  void set_solid(const std::vector<std::string>& objects, bool solid);
  /// Makes a file of grasps that of an object.
  void keep_grasps(const std::string& object, const std::filesystem::path& file);
  /// Fixes the objects to a link, where all are now; raised by a little if one of them stands on
  /// something, see rise_to_clear(). @param touching links that may touch them.
  void attach(const std::string& robot, const std::string& link,
              const std::vector<std::string>& touching);
  void detach();
  /// Any other edit. @param select afterwards.
  void apply(const QString& text, planning::SceneState next, std::vector<std::string> select);
  /// "can", or "3 objects".
  [[nodiscard]] static QString words_for(const std::vector<std::string>& objects);

  /// The configuration of a posture; nothing of anything else.
  [[nodiscard]] std::optional<geometric::Configuration> posture(const SceneItem& item) const;
  /// Adds a goal pose, where the palm is shown, and selects it; with a start, where the robot is
  /// shown, if there is none.
  void add_goal_pose();
  /// Returns whether the robot has a palm that an arm moves.
  [[nodiscard]] bool can_add_goal_pose() const;
  /// The selected goal pose; nullptr if something else is selected.
  [[nodiscard]] const geometric::PoseGoal* selected_goal_pose() const {
    return find_goal_pose(state(), selection());
  }
  /// Changes the selected goal pose.
  void change_goal_pose(const geometric::PoseGoal& goal);
  /// Adds a frame and selects it: on the top of the selected object, on the selected link of the
  /// first robot, on the palm of the selected posture, or else in the world, at a place (m).
  void add_frame(const Eigen::Vector3d& otherwise);
  /// The selected frame; nullptr if something else is selected.
  [[nodiscard]] const geometric::NamedFrame* selected_frame() const {
    return find_frame(state(), selection());
  }
  /// Fixes the selected frame to an object or a link, where it is. @param parent empty: the world.
  void fix_frame(const std::string& parent);
  /// Sets the moving group, see geometric::set_moving_group(). Robots that it combines are composed
  /// in the background.
  void set_group(const std::vector<std::string>& group);
  void set_start(const geometric::Configuration& q);
  /// @param start what becomes the start of a scene that has none; nothing: where the robot stood
  /// when the scene was opened.
  void set_goal(const geometric::Configuration& q,
                const std::optional<geometric::Configuration>& start = {});
  /// Saves a posture in the scene, or replaces the one of the same name.
  void keep_posture(const geometric::NamedPosture& posture);
  void forget_posture(const std::string& name);
  /// Saves a view in the scene, or replaces the one of the same name.
  void save_view(const geometric::SavedView& view);
  void forget_view(const std::string& name);
  /// The hand is planned for with a basis, by whose file the scene names it.
  void use_basis(const std::filesystem::path& file,
                 std::shared_ptr<const sampling::PmdBasis> basis);

 signals:
  void selection_changed(const handway::gui::SceneItem& item);
  /// See is_modified().
  void modified_changed(bool modified);
  /// Emitted with the displayed reason why something can't be done.
  void refused(const QString& title, const QString& reason);
  /// The palm of a posture is to go there.
  void palm_placed(const handway::gui::SceneItem& item, const handway::geometric::Pose& X_WP);

 private:
  struct Edited {
    planning::SceneState state;
    Selection selection;
  };
  /// @param kind see Edit.
  void push(const QString& text, planning::SceneState next, Selection select,
            const std::string& kind = {});
  void set_selection(Selection selection);
  /// Makes the next state in the background and pushes it, unless the scene was edited meanwhile.
  /// @param outcome empty: problems are refused().
  void compose(const QString& text, std::function<planning::SceneState()> make, Selection select,
               const std::string& kind = {}, Outcome outcome = {});
  void end_composing(const QString& problem);
  /// Pushes a change of the selected objects that can be changed.
  /// @param text with a place for what is changed. @param what empty: each an edit of its own.
  void push_changed(const QString& text, const std::string& what, planning::SceneState next);
  /// Changes each of them. @param text as above. @param what as above.
  void change_selected(const QString& text, const std::string& what,
                       const std::function<void(geometric::SceneObject&)>& change);

  Document& document_;
  QUndoStack stack_;
  bool was_modified_ = false;
  Selection selection_;
  LatestJob composing_;
  Outcome outcome_;  ///< Outcome of the composition.
};

}  // namespace handway::gui
