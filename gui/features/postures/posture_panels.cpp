#include "features/postures/posture_panels.h"

#include "features/postures/elbow_swing.h"
#include "features/postures/joint_panel.h"
#include "features/workbench.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "model/document/selection.h"
#include "model/playback/path_player.h"
#include "model/settings/options.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/actions.h"
#include "widgets/style/icons.h"
#include "widgets/style/menu_text.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

QColor to_qcolor(const geometric::Color& color) {
  return QColor::fromRgbF(color.red, color.green, color.blue);
}

}  // namespace

PostureBar::PostureBar(QWidget* parent)
    : QWidget(parent),
      start_(named("go_to_start",
                   new QPushButton(icon("start", to_qcolor(kStartColor)), tr("Go to start")))),
      goal_(named("go_to_goal",
                  new QPushButton(icon("goal", to_qcolor(kGoalColor)), tr("Go to goal")))),
      postures_(named("postures", new QPushButton(tr("Postures")))),
      menu_(new QMenu(this)) {
  postures_->setToolTip(tr("Go to a saved posture, or save this one under a name"));
  postures_->setMenu(menu_);
  for (QPushButton* button : {start_, goal_, postures_}) {
    button->setProperty("role", "compact");
  }
  lay_out(*this, in_row({{start_, 1}, {goal_, 1}, {postures_, 1}}, 8), {12, 10, 12, 2});
  connect(start_, &QPushButton::clicked, this, &PostureBar::start_requested);
  connect(goal_, &QPushButton::clicked, this, &PostureBar::goal_requested);
  set_scene(nullptr);
}

void PostureBar::set_scene(const std::shared_ptr<const geometric::Scene>& scene) {
  menu_->clear();
  start_->setEnabled(scene && scene->start);
  goal_->setEnabled(scene && scene->goal);
  start_->setToolTip(start_->isEnabled() ? tr("Move the robot to the start")
                                         : tr("The scene has no start: Plan > Set start here"));
  goal_->setToolTip(goal_->isEnabled() ? tr("Move the robot to the goal")
                                       : tr("The scene has no goal posture: Plan > Set goal here"));
  const bool has_robot = scene && !scene->robots.empty();
  if (has_robot) {
    list_postures(*scene);
  }
  postures_->setEnabled(has_robot);
}

void PostureBar::list_postures(const geometric::Scene& scene) {
  const auto add = [this](const geometric::NamedPosture& posture) {
    const QString name = QString::fromStdString(posture.name);
    const QString group = QString::fromStdString(posture.group);
    menu_->addAction(menu_text(group.isEmpty() ? name : QStringLiteral("%1: %2").arg(group, name)),
                     this, [this, posture] { emit posture_requested(posture); });
  };
  std::ranges::for_each(scene.postures, add);
  menu_->addSeparator();
  std::ranges::for_each(scene.robots.front().model->description().postures, add);
  menu_->addSeparator();
  menu_->addAction(tr("Save posture…"), this, &PostureBar::keep_requested);
  if (!scene.postures.empty()) {
    QMenu* forget = menu_->addMenu(tr("Delete"));
    forget->setObjectName(QStringLiteral("forget_posture"));
    for (const geometric::NamedPosture& posture : scene.postures) {
      const QString name = QString::fromStdString(posture.name);
      forget->addAction(menu_text(name), this, [this, name] { emit forget_requested(name); });
    }
  }
}

PosturePanels::PosturePanels(Workbench& workbench)
    : workbench_(workbench),
      document_(workbench.document),
      postures_(new PostureBar),
      swing_(new ElbowSwing),
      joints_(new JointPanel),
      hand_(new PmdPanel(document_.recorded_hand())) {
  workbench_.add_dock(
      DockArea::kControl, 1,
      {"joints", tr("Joints"), boxed(in_column({postures_, swing_, {joints_, 1}}, 0))});
  workbench_.add_dock(DockArea::kControl, 2, {"hand", tr("Hand"), hand_});
  connect_panels();
  add_commands();
}

void PosturePanels::connect_panels() {
  Posing& posing = workbench_.posing;
  connect(joints_, &JointPanel::configuration_edited, &posing, &Posing::set);
  connect(swing_, &ElbowSwing::configuration_edited, &posing, &Posing::set);
  connect(hand_, &PmdPanel::configuration_edited, &posing, &Posing::set);
  connect(postures_, &PostureBar::posture_requested, &posing, &Posing::apply);
  connect(postures_, &PostureBar::start_requested, &posing,
          [this, &posing] { posing.set(*document_.scene()->start); });
  connect(postures_, &PostureBar::goal_requested, &posing,
          [this, &posing] { posing.set(*document_.scene()->goal); });
  connect(&document_, &Document::configuration_changed, this, [this](const Eigen::VectorXd& q) {
    swing_->set_configuration(q);
    joints_->set_configuration(q);
    hand_->set_configuration(q);
  });
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene()) {
      postures_->set_scene(document_.scene());
    }
  });
  connect(&workbench_, &Workbench::scene_shown, this, &PosturePanels::show_robot);
  connect(&document_, &Document::hand_changed, this, &PosturePanels::show_robot);
  connect(hand_, &PmdPanel::basis_wanted, &workbench_,
          [this] { workbench_.trigger("explore_bases"); });
  connect(&workbench_.editor, &SceneEditor::selection_changed, this, &PosturePanels::show_item);
}

void PosturePanels::add_commands() {
  QAction* start = workbench_.make_action("start", tr("Set &start here"), {},
                                          tr("Start from the posture that is shown"));
  QAction* goal = workbench_.make_action("goal", tr("Set &goal here"), {},
                                         tr("End in the posture that is shown"));
  QAction* keep = workbench_.make_action("", tr("Save &posture…"), {},
                                         tr("Save the posture under a name in the scene"));
  keep->setObjectName(QStringLiteral("keep_posture"));
  int order = 0;
  for (QAction* action : {start, goal, keep}) {
    workbench_.add_to_menu(MainMenu::kPlan, {1, ++order}, action);
    workbench_.add_to_menu(MainMenu::kContext, {5, order}, action);
    connect(&workbench_, &Workbench::scene_shown, action, [this, action] {
      allow(*action, document_.robot() ? QString() : tr("The scene has no robot."));
    });
  }
  SceneEditor& editor = workbench_.editor;
  connect(start, &QAction::triggered, this,
          [this, &editor] { editor.set_start(document_.configuration()); });
  connect(goal, &QAction::triggered, this,
          [this, &editor] { editor.set_goal(document_.configuration()); });
  new KeptPostures(document_, editor, *postures_, *keep, this);
}

void PosturePanels::show_robot() {
  const geometric::RobotInstance* robot = document_.robot();
  const auto model = robot ? robot->model : nullptr;
  postures_->set_scene(document_.scene());
  swing_->set_arm(model, document_.palm(), document_.joints().arm);
  joints_->set_robot(model, document_.joints());
  hand_->set_hand(model, document_.loaded().basis, document_.joints().hand);
}

void PosturePanels::show_item(const SceneItem& item) const {
  const geometric::RobotInstance* robot = document_.robot();
  if (robot && item.kind == SceneItem::Kind::kLink && item.robot == robot->name) {
    joints_->show_link(item.name);
  }
}

void add_postures(Workbench& workbench) { workbench.own<PosturePanels>(workbench); }

namespace {

constexpr int kLeastWidth = 340;

}  // namespace

KeepPostureDialog::KeepPostureDialog(const geometric::JointSelection& joints,
                                     const QStringList& taken, QWidget* parent)
    : QDialog(parent),
      taken_(taken),
      name_(named("posture_name", new QLineEdit)),
      part_(named("posture_part", new QComboBox)),
      note_(note()),
      keep_(nullptr) {
  setWindowTitle(tr("Save posture"));
  setMinimumWidth(scaled(kLeastWidth));
  name_->setPlaceholderText(tr("for example: above the table"));
  std::vector<int> all = joints.arm;
  all.insert(all.end(), joints.hand.begin(), joints.hand.end());
  const geometric::JointIndices others = joints.outside_arm_and_hand();
  all.insert(all.end(), others.begin(), others.end());
  add_part(tr("The whole robot"), std::move(all));
  if (!joints.arm.empty() && !joints.hand.empty()) {
    add_part(tr("The arm"), joints.arm);
    add_part(tr("The hand"), joints.hand);
  }
  auto* form = new QFormLayout;
  form->addRow(tr("Name"), name_);
  form->addRow(tr("Of"), part_);
  note_->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  keep_ = buttons->addButton(tr("Save"), QDialogButtonBox::AcceptRole);
  keep_->setObjectName(QStringLiteral("posture_keep"));
  keep_->setProperty("role", "primary");
  keep_->setDefault(true);
  lay_out(*this, in_column({form, note_, buttons}, 10), {16, 16, 16, 12});
  connect(name_, &QLineEdit::textChanged, this, &KeepPostureDialog::look_at_name);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  look_at_name();
}

void KeepPostureDialog::add_part(const QString& text, std::vector<int> variables) {
  part_->addItem(text);
  parts_.push_back(std::move(variables));
}

void KeepPostureDialog::look_at_name() {
  keep_->setEnabled(!name().isEmpty());
  note_->setText(
      taken_.contains(name())
          ? tr("It replaces the posture of that name.")
          : tr("Postures are saved with the scene. Joints of other parts stay where they "
               "are when the robot goes to it."));
}

QString KeepPostureDialog::name() const { return name_->text().trimmed(); }

const std::vector<int>& KeepPostureDialog::variables() const {
  return parts_[static_cast<std::size_t>(part_->currentIndex())];
}

KeptPostures::KeptPostures(const Document& document, SceneEditor& editor, PostureBar& bar,
                           QAction& keep, QObject* parent)
    : QObject(parent), document_(document), editor_(editor), bar_(bar) {
  connect(&keep, &QAction::triggered, this, &KeptPostures::keep_this);
  connect(&bar, &PostureBar::keep_requested, this, &KeptPostures::keep_this);
  connect(&bar, &PostureBar::forget_requested, this,
          [this](const QString& name) { editor_.forget_posture(name.toStdString()); });
}

void KeptPostures::keep_this() {
  const geometric::RobotInstance* robot = document_.robot();
  if (!robot) {
    return;
  }
  QStringList taken;
  for (const geometric::NamedPosture& posture : document_.scene()->postures) {
    taken.push_back(QString::fromStdString(posture.name));
  }
  KeepPostureDialog dialog(document_.joints(), taken, bar_.window());
  if (dialog.exec() != QDialog::Accepted) {
    return;
  }
  geometric::NamedPosture posture;
  posture.name = dialog.name().toStdString();
  for (const int variable : dialog.variables()) {
    posture.values[robot->model->variable(variable).name] = document_.configuration()[variable];
  }
  editor_.keep_posture(posture);
}

}  // namespace handway::gui
