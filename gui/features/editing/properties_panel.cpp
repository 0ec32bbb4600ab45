#include "features/editing/properties_panel.h"

#include "features/editing/goal_pose_form.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/robot_edits.h"
#include "handway/planning/edits/scene_edits.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/constraint_form.h"
#include "widgets/forms/pose_form.h"
#include "widgets/forms/shape_form.h"
#include "widgets/forms/typed_input.h"
#include "widgets/style/icons.h"

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace handway::gui {
namespace {

using Kind = SceneItem::Kind;

QLabel* title(const QString& text) {
  QLabel* label = heading(text);
  label->setWordWrap(true);
  return label;
}

QToolButton* toggle(const char* name) {
  auto* button = new QToolButton;
  button->setObjectName(QLatin1String(name));
  button->setCheckable(true);
  button->setAutoRaise(true);
  button->setIconSize({16, 16});
  return button;
}

QWidget* section(std::initializer_list<PanelPart> parts) { return boxed(in_column(parts, 4)); }

// The first constraint about the body with such a kind of content; nullptr if there is none.
template <typename Content>
const geometric::PathConstraint* constraint_about(const SceneEditor& editor) {
  const std::string body = editor.constrained_body();
  if (body.empty()) {
    return nullptr;
  }
  const auto& all = editor.state().scene->constraints;
  const auto found = std::ranges::find_if(all, [&](const geometric::PathConstraint& constraint) {
    return constraint.body == body && std::holds_alternative<Content>(constraint.what);
  });
  return found == all.end() ? nullptr : &*found;
}

template <typename Content>
std::optional<Content> content_about(const SceneEditor& editor) {
  const geometric::PathConstraint* constraint = constraint_about<Content>(editor);
  return constraint ? std::optional(std::get<Content>(constraint->what)) : std::nullopt;
}

template <typename Content>
void change_constraint(SceneEditor& editor, const Content& content) {
  if (const geometric::PathConstraint* old = constraint_about<Content>(editor)) {
    editor.set_constraint({old->name, old->body, content});
  }
}

template <typename Content>
void switch_constraint(SceneEditor& editor, const geometric::PathConstraint& made, bool on) {
  if (on) {
    editor.set_constraint(made);
  } else if (const geometric::PathConstraint* old = constraint_about<Content>(editor)) {
    editor.remove_constraint(std::string(old->name));
  }
}

}  // namespace

PropertiesPanel::PropertiesPanel(SceneEditor& editor, QWidget* parent)
    : PanelArea(nullptr, parent),
      editor_(editor),
      hint_(note(tr("Select an object to see its place and size here. Add one with "
                    "the Add menu."))),
      header_(make_header()),
      pose_title_(title(tr("Pose"))),
      pose_(new PoseForm),
      goal_form_(new GoalPoseForm),
      frame_parent_(named("frame_parent", new QComboBox)),
      mount_(named("mounted_on", new QComboBox)),
      shape_(new ShapeForm),
      extent_(named("extent", note())),
      color_(named("color", new QToolButton)),
      parent_(named("fixed_to", new QComboBox)),
      solid_(named("solid", new QCheckBox(tr("Solid")))),
      constraints_(new ConstraintForm) {
  hint_->setWordWrap(true);
  pose_box_ = section({pose_title_, pose_});
  color_->setToolTip(tr("Choose a colour"));
  color_->setIconSize({54, 16});
  parent_->setToolTip(tr("What the object moves with"));
  mount_->setAccessibleName(tr("Mounted on"));
  mount_->setToolTip(tr("The link that carries the robot, by its origin at first"));
  mount_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  mount_box_ = section({title(tr("Mounted on")), mount_});
  frame_parent_->setAccessibleName(tr("Fixed to"));
  frame_parent_->setToolTip(tr("The object or link that the frame moves with"));
  frame_parent_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  frame_box_ = section({title(tr("Fixed to")), frame_parent_});
  auto* more = new QWidget;
  auto* rows = new QFormLayout(more);
  rows->setContentsMargins(0, 4, 0, 0);
  rows->setHorizontalSpacing(10);
  rows->setVerticalSpacing(5);
  // A short panel shows them both.
  rows->addRow(note(tr("Colour")), in_row({color_, room(1), solid_}));
  rows->addRow(note(tr("Attached to")), parent_);
  solid_->setToolTip(
      tr("What is inside collides. Off: a room or a cell, of which the walls alone count"));
  extent_->setWordWrap(true);
  shape_box_ = section({title(tr("Size")), shape_, extent_, more});

  constraints_box_ = section({title(tr("Along paths")), constraints_});
  setWidget(boxed(in_column({hint_, header_, frame_box_, mount_box_, pose_box_, goal_form_,
                             shape_box_, constraints_box_, room(1)},
                            8),
                  {12, 10, 12, 10}));

  connect(pose_, &PoseForm::pose_edited, &editor_,
          [this](const geometric::Pose& X_FO) { editor_.place(X_WF_ * X_FO); });
  connect(mount_, qOverload<int>(&QComboBox::activated), this, [this](int row) {
    const std::string robot = mount_->itemData(row, Qt::UserRole).toString().toStdString();
    const std::string link = mount_->itemData(row, Qt::UserRole + 1).toString().toStdString();
    emit mount_requested(
        editor_.selection().robot,
        row == 0 ? std::nullopt : std::optional(planning::LinkOfRobot{robot, link}));
  });
  connect(frame_parent_, qOverload<int>(&QComboBox::activated), this, [this](int row) {
    editor_.fix_frame(row > 0 ? frame_parent_->itemText(row).toStdString() : std::string());
  });
  connect(shape_, &ShapeForm::shape_edited, &editor_,
          [this](const geometric::Shape& shape) { editor_.set_shape(shape); });
  connect(shape_, &ShapeForm::cells_edited, this, &PropertiesPanel::cells_edited);
  connect(color_, &QToolButton::clicked, this, &PropertiesPanel::choose_color);
  connect(solid_, &QCheckBox::clicked, this,
          [this](bool on) { editor_.set_solid(editor_.selected_objects(), on); });
  connect(parent_, qOverload<int>(&QComboBox::activated), this, [this](int row) {
    emit attach_requested(parent_->itemData(row, Qt::UserRole).toString().toStdString(),
                          parent_->itemData(row, Qt::UserRole + 1).toString().toStdString());
  });
  connect(goal_form_, &GoalPoseForm::goal_edited, &editor_, &SceneEditor::change_goal_pose);
  connect_constraints();
  refresh_icons();
  refresh();
}

QWidget* PropertiesPanel::make_header() {
  name_ = new QLineEdit;
  name_->setObjectName(QStringLiteral("object_name"));
  name_->setAccessibleName(tr("Name"));
  kind_ = new QLabel;
  kind_->setProperty("role", "note");
  lock_ = toggle("lock");
  hide_ = toggle("hide");
  lock_->setToolTip(tr("Lock: keep it from being changed"));
  hide_->setToolTip(tr("Hide: do not draw it; it still counts in planning"));
  connect(name_, &QLineEdit::editingFinished, this, [this] {
    editor_.rename(name_->text().trimmed().toStdString());
    refresh();
  });
  connect(lock_, &QToolButton::clicked, this,
          [this](bool on) { editor_.set_locked(editor_.selected_objects(), on); });
  connect(hide_, &QToolButton::clicked, this,
          [this](bool on) { editor_.set_hidden(editor_.selected_objects(), on); });
  return boxed(in_row({{name_, 1}, kind_, hide_, lock_}, 4));
}

void PropertiesPanel::refresh_icons() {
  lock_->setIcon(icon("lock"));
  hide_->setIcon(icon("hide"));
}

void PropertiesPanel::refresh() {
  if (shown_ != editor_.whole_selection()) {
    shown_ = editor_.whole_selection();
    forget_typed(*this);  // it was about what was selected before
  }
  show_constraints();
  const SceneItem& item = editor_.selection();
  if (const geometric::SceneObject* object = editor_.selected_object()) {
    if (editor_.has_several()) {
      show_objects(*object);
    } else {
      show_object(*object);
    }
    return;
  }
  const auto& scene = editor_.state().scene;
  const geometric::RobotInstance* robot =
      scene ? geometric::find_robot_with_part(*scene, item.robot) : nullptr;
  if (robot && item.kind == Kind::kRobot) {
    show_robot(item.robot);
  } else if (const geometric::PoseGoal* goal = editor_.selected_goal_pose()) {
    show_goal_pose(*goal);
  } else if (const geometric::NamedFrame* frame = editor_.selected_frame()) {
    show_frame(*frame);
  } else if (robot && item.kind == Kind::kLink) {
    show_link(*robot);
  } else if (const auto X_WP = editor_.selected_pose(); X_WP && item.is_posture()) {
    show_posture(*X_WP);
  } else {
    show_hint();
  }
}

void PropertiesPanel::preview_pose(const geometric::Pose& X_WO) {
  pose_->show_pose(X_WF_.inverse() * X_WO);
}

void PropertiesPanel::show_parts(bool header, bool pose, bool shape) {
  X_WF_ = geometric::Pose::Identity();
  hint_->setVisible(!header);
  frame_box_->hide();
  mount_box_->hide();
  goal_form_->hide();
  header_->setVisible(header);
  pose_box_->setVisible(pose);
  shape_box_->setVisible(shape);
  lock_->setVisible(shape);
  hide_->setVisible(shape);
}

void PropertiesPanel::show_object(const geometric::SceneObject& object) {
  show_parts(true, true, true);
  const bool editable = editor_.can_change();
  show_text(*name_, QString::fromStdString(object.name));
  name_->setReadOnly(!editable);
  kind_->setText(kind_of_shape(object.shape));
  lock_->setChecked(!editable);
  hide_->setChecked(editor_.state().is_hidden(object.name));
  pose_title_->setText(tr("Pose"));
  pose_->show_pose(editor_.selected_pose().value());
  shape_->show_shape(object.shape);
  shape_->setVisible(true);
  extent_->hide();
  show_common(object, editable);
}

void PropertiesPanel::show_objects(const geometric::SceneObject& last) {
  show_parts(true, true, true);
  const std::vector<std::string>& names = editor_.selected_objects();
  const bool editable = editor_.can_change();
  const bool is_group = planning::rigid_parts(*editor_.state().scene, names).size() == 1;
  show_text(*name_, is_group ? QString::fromStdString(editor_.state().display_of(last.name).group)
                             : tr("%1 objects").arg(names.size()));
  name_->setReadOnly(true);
  kind_->setText(is_group ? tr("Group of %1").arg(names.size()) : QString());
  const auto all = [&](bool geometric::ObjectDisplay::*flag) {
    return std::ranges::all_of(
        names, [&](const std::string& name) { return editor_.state().display_of(name).*flag; });
  };
  lock_->setChecked(all(&geometric::ObjectDisplay::locked));
  hide_->setChecked(all(&geometric::ObjectDisplay::hidden));
  pose_title_->setText(tr("Centre (angles turn all about it)"));
  pose_->show_pose(editor_.selected_pose().value_or(geometric::Pose::Identity()));
  const Eigen::Vector3d size =
      bounds(*editor_.state().scene, editor_.document().configuration(), names).size();
  const auto mm = [](double metres) {
    return QString::number(geometric::millimetres(metres), 'f', 1);
  };
  extent_->setText(tr("%1 × %2 × %3 mm together").arg(mm(size.x()), mm(size.y()), mm(size.z())));
  extent_->show();
  shape_->hide();
  show_common(last, editable);
}

void PropertiesPanel::show_common(const geometric::SceneObject& object, bool editable) {
  pose_->set_editable(editable);
  shape_->set_editable(editable);
  color_->setEnabled(editable);
  paint_swatch(object.color);
  solid_->setChecked(object.solid);
  solid_->setEnabled(editable);
  list_parents(object);
  parent_->setEnabled(editable && parent_->count() > 1);
}

void PropertiesPanel::show_robot(const std::string& robot) {
  const geometric::Scene& scene = *editor_.state().scene;
  const geometric::Configuration& q = editor_.document().configuration();
  show_parts(true, true, false);
  show_text(*name_, QString::fromStdString(robot));
  name_->setReadOnly(true);
  kind_->setText(tr("Robot"));
  const auto on = planning::carrier_of(scene, robot);
  X_WF_ = planning::carrier_pose(scene, q, robot);
  pose_title_->setText(on ? tr("Base in %1").arg(QString::fromStdString(on->link)) : tr("Base"));
  pose_->show_pose(X_WF_.inverse() * *planning::base_pose(scene, q, robot));
  pose_->set_editable(true);
  list_mounts(robot);
}

void PropertiesPanel::list_mounts(const std::string& robot) {
  const geometric::Scene& scene = *editor_.state().scene;
  const auto on = planning::carrier_of(scene, robot);
  std::vector<ShownChoice> choices{{tr("World")}};
  int current = 0;
  for (const planning::LinkOfRobot& place : planning::mounting_places(scene, robot)) {
    const QString carrier = QString::fromStdString(place.robot);
    const QString link = QString::fromStdString(place.link);
    current = on == place ? static_cast<int>(choices.size()) : current;
    choices.push_back({tr("%1 of %2").arg(link, carrier), carrier, link});
  }
  show_choices(*mount_, choices, current);
  mount_box_->setVisible(choices.size() > 1);
}

void PropertiesPanel::show_link(const geometric::RobotInstance& robot) {
  const auto X_WL = link_pose(*editor_.state().scene, editor_.document().configuration(),
                              robot.name, editor_.selection().name);
  show_parts(true, X_WL.has_value(), false);
  show_text(*name_, QString::fromStdString(editor_.selection().name));
  name_->setReadOnly(true);
  kind_->setText(tr("Link"));
  pose_title_->setText(tr("Pose (set by the joints)"));
  pose_->show_pose(X_WL.value_or(geometric::Pose::Identity()));
  pose_->set_editable(false);
}

void PropertiesPanel::show_posture(const geometric::Pose& X_WP) {
  show_parts(true, true, false);
  const Kind kind = editor_.selection().kind;
  show_text(*name_, kind == Kind::kStart  ? tr("Start")
                    : kind == Kind::kGoal ? tr("Goal")
                                          : tr("Robot as shown"));
  name_->setReadOnly(true);
  kind_->setText(tr("Posture"));
  pose_title_->setText(tr("Palm: the arm follows"));
  pose_->show_pose(X_WP);
  pose_->set_editable(true);
}

void PropertiesPanel::show_goal_pose(const geometric::PoseGoal& goal) {
  show_parts(true, true, false);
  show_text(*name_, tr("Goal pose of %1").arg(QString::fromStdString(goal.link)));
  name_->setReadOnly(true);
  kind_->setText(tr("Goal"));
  pose_title_->setText(tr("Pose in the world"));
  pose_->show_pose(goal.X_WG);
  pose_->set_editable(true);
  goal_form_->show_goal(*editor_.state().scene, goal);
  goal_form_->show();
}

void PropertiesPanel::show_frame(const geometric::NamedFrame& frame) {
  show_parts(true, true, false);
  show_text(*name_, QString::fromStdString(frame.name));
  name_->setReadOnly(false);
  kind_->setText(tr("Frame"));
  const geometric::Pose X_WF = editor_.selected_pose().value_or(frame.X_PF);
  X_WF_ = X_WF * frame.X_PF.inverse();
  pose_title_->setText(frame.parent.empty()
                           ? tr("Pose")
                           : tr("Pose in %1").arg(QString::fromStdString(frame.parent)));
  pose_->show_pose(frame.X_PF);
  pose_->set_editable(true);
  const geometric::Scene& scene = *editor_.state().scene;
  std::vector<ShownChoice> choices{{tr("World")}};
  int current = 0;
  const auto offer = [&](const std::string& name) {
    current = name == frame.parent ? static_cast<int>(choices.size()) : current;
    choices.push_back({QString::fromStdString(name)});
  };
  for (const geometric::SceneObject& object : scene.objects) {
    offer(object.name);
  }
  for (const geometric::Link& link : scene.robots.front().model->description().links) {
    offer(link.name);
  }
  show_choices(*frame_parent_, choices, current);
  frame_box_->show();
}

void PropertiesPanel::show_hint() { show_parts(false, false, false); }

void PropertiesPanel::connect_constraints() {
  using Upright = geometric::OrientationConstraint;
  using Region = geometric::PositionConstraint;
  connect(constraints_, &ConstraintForm::upright_edited, &editor_,
          [this](const Upright& upright) { change_constraint(editor_, upright); });
  connect(constraints_, &ConstraintForm::region_edited, &editor_,
          [this](const Region& region) { change_constraint(editor_, region); });
  connect(constraints_, &ConstraintForm::upright_switched, &editor_, [this](bool on) {
    switch_constraint<Upright>(
        editor_,
        planning::new_upright(*editor_.state().scene, editor_.document().configuration(),
                              editor_.constrained_body()),
        on);
  });
  connect(constraints_, &ConstraintForm::region_switched, &editor_, [this](bool on) {
    switch_constraint<Region>(
        editor_,
        planning::new_region(*editor_.state().scene, editor_.document().configuration(),
                             editor_.constrained_body()),
        on);
  });
}

void PropertiesPanel::show_constraints() {
  constraints_box_->setVisible(!editor_.constrained_body().empty());
  constraints_->show_upright(content_about<geometric::OrientationConstraint>(editor_));
  constraints_->show_region(content_about<geometric::PositionConstraint>(editor_));
}

void PropertiesPanel::list_parents(const geometric::SceneObject& object) {
  std::vector<ShownChoice> choices{{tr("World")}};
  int current = 0;
  for (const geometric::RobotInstance& robot : editor_.state().scene->robots) {
    for (int i = 0; i < robot.model->link_count(); ++i) {
      const std::string& link = robot.model->link(i).name;
      const bool carries = object.attachment && object.attachment->robot == robot.name &&
                           object.attachment->link == link;
      current = carries ? static_cast<int>(choices.size()) : current;
      choices.push_back({QString::fromStdString(link), QString::fromStdString(robot.name),
                         QString::fromStdString(link)});
    }
  }
  show_choices(*parent_, choices, current);
}

void PropertiesPanel::paint_swatch(const geometric::Color& color) {
  QPixmap swatch(54, 16);
  swatch.fill(QColor::fromRgbF(color.red, color.green, color.blue));
  color_->setIcon(swatch);
}

void PropertiesPanel::choose_color() {
  const geometric::SceneObject* object = editor_.selected_object();
  if (!object) {
    return;
  }
  const QColor before = QColor::fromRgbF(object->color.red, object->color.green, object->color.blue,
                                         object->color.alpha);
  const QColor chosen = QColorDialog::getColor(
      before, this, tr("Colour of %1").arg(SceneEditor::words_for(editor_.changeable())),
      QColorDialog::ShowAlphaChannel);
  if (chosen.isValid() && chosen != before) {
    editor_.set_color({static_cast<float>(chosen.redF()), static_cast<float>(chosen.greenF()),
                       static_cast<float>(chosen.blueF()), static_cast<float>(chosen.alphaF())});
  }
}

}  // namespace handway::gui
