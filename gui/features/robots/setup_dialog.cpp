#include "features/robots/setup_dialog.h"

#include "features/robots/pair_table.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/io/existing_file.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/icons.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTabWidget>

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace handway::gui {
namespace {

using geometric::RobotFinding;
using geometric::RobotModel;
using geometric::WristOwner;

constexpr int kSamples = 10'000;  // as `handway setup`
constexpr std::uint64_t kSeed = 1;
constexpr int kSteps = 100;  // of the progress bar
enum Posture { kZero, kMiddle };

QString joined(const std::vector<std::string>& names) {
  QStringList words;
  for (const std::string& name : names) {
    words << QString::fromStdString(name);
  }
  return words.join(QStringLiteral(", "));
}

RobotFile robot_file(const std::string& name, const std::shared_ptr<const RobotModel>& model) {
  std::filesystem::path srdf = model->description().file;
  if (geometric::has_extension(srdf, ".urdf")) {
    srdf.replace_extension(".srdf");
  } else {
    srdf.clear();
  }
  return {name, model, srdf};
}

}  // namespace

std::vector<RobotFile> robot_files(const geometric::Scene& scene) {
  std::vector<RobotFile> files;
  for (const geometric::RobotInstance& robot : scene.robots) {
    if (robot.parts.empty()) {
      files.push_back(robot_file(robot.name, robot.model));
    }
    for (const geometric::RobotPart& part : robot.parts) {
      files.push_back(robot_file(part.name, part.model));
    }
  }
  return files;
}

SetupDialog::SetupDialog(SceneEditor& editor, const std::string& robot, QWidget* parent)
    : QDialog(parent),
      editor_(editor),
      robots_(robot_files(*editor.state().scene)),
      view_(new SceneView),
      robot_(named("setup_robot", new QComboBox)),
      posture_(named("setup_posture", new QComboBox)),
      wrist_(named("setup_wrist", new QComboBox)),
      wrist_label_(new QLabel(tr("Wrist"))),
      group_text_(named("setup_groups", new QLabel)),
      list_(named("setup_findings", new QListWidget)),
      tabs_(named("setup_tabs", new QTabWidget)),
      kind_(named("setup_pair_kind", new QComboBox)),
      joints_(new GroupTable),
      as_found_(named("setup_as_found", new QPushButton(tr("As found")))),
      pairs_(new PairTable),
      sampling_(new QLabel(tr("Sampling self-collisions"))),
      progress_(named("setup_progress", new QProgressBar)),
      cancel_(named("setup_stop", new QPushButton(tr("Stop")))),
      again_(named("setup_again", new QPushButton(tr("Sample again")))),
      outcome_(named("setup_outcome", new QLabel)),
      write_(named("setup_write", new QPushButton(tr("Write SRDF")))) {
  setObjectName(QStringLiteral("setup_dialog"));
  setWindowTitle(tr("Robot setup"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* halves = new QSplitter;
  halves->setChildrenCollapsible(false);
  halves->addWidget(make_view());
  halves->addWidget(make_panel());
  halves->setStretchFactor(0, 3);
  halves->setStretchFactor(1, 2);
  lay_out(*this, in_column({{halves, 1}, make_buttons()}, 10), {14, 12, 14, 14});
  resize(within_window(*this, {scaled(960), scaled(640)}));
  for (const RobotFile& file : robots_) {
    robot_->addItem(icon("robot"), QString::fromStdString(file.name));
  }
  const auto asked = std::ranges::find(robots_, robot, &RobotFile::name);
  robot_->setCurrentIndex(asked == robots_.end() ? 0 : static_cast<int>(asked - robots_.begin()));
  connect(robot_, qOverload<int>(&QComboBox::currentIndexChanged), this, &SetupDialog::show_robot);
  connect(&editor_.document(), &Document::opened, this, [this](Document::Opened what) {
    if (what == Document::Opened::kScene) {
      reject();
    }
  });
  show_robot();
}

QWidget* SetupDialog::make_view() {
  view_->set_colors(colors_of(current_theme()).view);
  view_->set_cube_visible(false);
  view_->setMinimumSize(scaled(260), scaled(240));
  posture_->setAccessibleName(tr("Posture"));
  posture_->addItem(tr("At the zero posture"));
  posture_->addItem(tr("In the middle of all ranges"));
  connect(posture_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &SetupDialog::show_posture);
  return boxed(in_column({{view_, 1}, posture_}, 0));
}

QWidget* SetupDialog::make_choices() {
  wrist_->setToolTip(tr("Group of the joints between root and palm"));
  wrist_->addItem(tr("Not decided: with the hand"));
  wrist_->addItem(tr("Of the arm"));
  wrist_->addItem(tr("Of the hand"));
  group_text_->setTextFormat(Qt::RichText);
  group_text_->setWordWrap(true);
  group_text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* box = new QWidget;
  auto* form = new QFormLayout(box);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(10);
  form->setVerticalSpacing(6);
  form->addRow(tr("Robot"), robot_);
  form->addRow(wrist_label_, wrist_);
  form->addRow(group_text_);
  connect(wrist_, qOverload<int>(&QComboBox::activated), this, &SetupDialog::decide_wrist);
  return box;
}

QWidget* SetupDialog::make_sampling() {
  progress_->setRange(0, kSteps);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(sampling_->text());
  cancel_->setToolTip(tr("Continue with the samples drawn so far"));
  for (QPushButton* button : {cancel_, again_}) {
    button->setAutoDefault(false);
  }
  connect(cancel_, &QPushButton::clicked, this, [this] { stop_.request_stop(); });
  connect(again_, &QPushButton::clicked, this, &SetupDialog::sample);
  return boxed(in_row({sampling_, {progress_, 1}, cancel_, room(), again_}));
}

QWidget* SetupDialog::make_joints() {
  as_found_->setToolTip(tr("Arm and hand as the robot's links suggest them"));
  as_found_->setAutoDefault(false);
  connect(as_found_, &QPushButton::clicked, this, [this] {
    const RobotModel& model = *chosen().model;
    moved_ = difference(model, present_groups(model, wrist()),
                        geometric::decided_groups(model, wrist()));
    examine();
  });
  connect(joints_, &GroupTable::decided, this, &SetupDialog::move_joints);
  connect(joints_, &GroupTable::looked_at, this,
          [this](const QString& link) { view_->set_collisions({link.toStdString()}); });
  return boxed(in_column({{joints_, 1}, {as_found_, 0, Qt::AlignLeft}}, 6), {0, 8, 0, 0});
}

QWidget* SetupDialog::make_pairs() {
  kind_->setAccessibleName(tr("Pairs that are listed"));
  connect(kind_, qOverload<int>(&QComboBox::currentIndexChanged), pairs_, &PairTable::show_kind);
  connect(pairs_, &PairTable::decided, this,
          [this](const geometric::AllowedCollisions::Pair& pair, bool allowed_collisions) {
            allowed_collisions_[pair] = allowed_collisions;
            // The call is queued, because it fills the table whose row emits this signal.
            QMetaObject::invokeMethod(this, &SetupDialog::show_pairs, Qt::QueuedConnection);
          });
  connect(pairs_, &PairTable::looked_at, this,
          [this](const geometric::AllowedCollisions::Pair& pair) {
            view_->set_collisions({pair.first, pair.second});
          });
  return boxed(in_column({kind_, {pairs_, 1}}, 6), {0, 8, 0, 0});
}

QWidget* SetupDialog::make_panel() {
  list_->setAccessibleName(tr("Suspicious findings"));
  list_->setWordWrap(true);
  list_->setSpacing(3);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  tabs_->addTab(list_, tr("Suspicious"));
  tabs_->addTab(make_pairs(), tr("Pairs of links"));
  tabs_->addTab(make_joints(), tr("Joints"));
  connect(list_, &QListWidget::currentRowChanged, this, &SetupDialog::show_finding);
  return boxed(in_column({make_choices(), make_sampling(), {tabs_, 1}}, 8), {10, 0, 0, 0});
}

QWidget* SetupDialog::make_buttons() {
  outcome_->setTextFormat(Qt::RichText);
  outcome_->setWordWrap(true);
  outcome_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  write_->setProperty("role", "primary");
  auto* close = named("setup_close", new QPushButton(tr("Close")));
  close->setAutoDefault(false);
  connect(write_, &QPushButton::clicked, this, &SetupDialog::write);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  return boxed(in_row({{outcome_, 1}, close, write_}));
}

const RobotFile& SetupDialog::chosen() const {
  return robots_[static_cast<std::size_t>(robot_->currentIndex())];
}

geometric::RobotDescription SetupDialog::set_up() const {
  const WristOwner owner =
      wrist() == WristOwner::kUndecided && groups_are_decided() ? WristOwner::kHand : wrist();
  geometric::RobotDescription robot =
      geometric::with_setup(*chosen().model, sampled_, groups_, {owner, allowed_collisions_});
  const auto is_gone = [&](const std::string& group) {
    return std::ranges::find(robot.groups, group, &geometric::JointGroup::name) ==
           robot.groups.end();
  };
  std::erase_if(robot.end_effectors,
                [&](const geometric::EndEffector& effector) { return is_gone(effector.group); });
  std::erase_if(robot.postures,
                [&](const geometric::NamedPosture& posture) { return is_gone(posture.group); });
  for (geometric::EndEffector& effector : robot.end_effectors) {
    if (is_gone(effector.parent_group)) {
      effector.parent_group.clear();
    }
  }
  return robot;
}

bool SetupDialog::groups_are_decided() const {
  return wrist() != WristOwner::kUndecided || !moved_.empty();
}

WristOwner SetupDialog::wrist() const { return static_cast<WristOwner>(wrist_->currentIndex()); }

void SetupDialog::show_robot() {
  geometric::RobotInstance robot;
  robot.name = chosen().name;
  robot.model = chosen().model;
  robot.configuration = robot.model->neutral();
  geometric::Scene alone;
  alone.robots = {robot};
  view_->set_scene(std::make_shared<const geometric::Scene>(std::move(alone)));
  wrist_->setCurrentIndex(0);
  const QString file = QString::fromStdString(chosen().srdf.string());
  show_outcome(file.isEmpty()
                   ? tr("%1 has no URDF: export it as one robot first.").arg(robot_->currentText())
               : std::filesystem::exists(chosen().srdf)
                   ? tr("Updates %1; the rest of the file is unchanged.").arg(file)
                   : tr("There is no SRDF yet: sampled pairs and proposed groups are used. "
                        "Writes %1.")
                         .arg(file),
               false);
  sample();
}

void SetupDialog::sample() {
  sampled_ = {};
  findings_.clear();
  allowed_collisions_.clear();
  moved_.clear();
  show_findings();
  show_pairs();
  progress_->setValue(0);
  for (QWidget* part : std::initializer_list<QWidget*>{sampling_, progress_, cancel_}) {
    part->show();
  }
  again_->hide();
  write_->setEnabled(false);
  examine();
  stop_ = std::stop_source();
  job_.run([this, model = chosen().model,
            enough = stop_](const std::stop_token& stop) -> LatestJob::Answer {
    std::stop_source either;
    const std::stop_callback on_stop(stop, [&] { either.request_stop(); });
    const std::stop_callback on_enough(enough.get_token(), [&] { either.request_stop(); });
    const auto report = [this, step = 0](double share) mutable {
      if (const int now = static_cast<int>(kSteps * share); now > std::exchange(step, now)) {
        QMetaObject::invokeMethod(progress_, "setValue", Qt::QueuedConnection, Q_ARG(int, now));
      }
    };
    return
        [this, sampled = geometric::sample_self_collisions(
                   *model, kSamples, kSeed, either.get_token(), report)] { take_samples(sampled); };
  });
}

void SetupDialog::take_samples(geometric::SelfCollisionSamples sampled) {
  sampled_ = std::move(sampled);
  for (QWidget* part : std::initializer_list<QWidget*>{sampling_, progress_, cancel_}) {
    part->hide();
  }
  again_->show();
  write_->setEnabled(!chosen().srdf.empty());
  examine();
}

geometric::GroupProposal SetupDialog::groups_by_now() const {
  const RobotModel& model = *chosen().model;
  return with_moved(model, present_groups(model, wrist()), moved_);
}

void SetupDialog::decide_wrist() {
  for (const std::string& joint : geometric::propose_groups(*chosen().model).wrist) {
    moved_.erase(joint);
  }
  examine();
}

void SetupDialog::move_joints(const JointOwners& owners) {
  for (const auto& [joint, owner] : owners) {
    moved_[joint] = owner;
  }
  groups_ = groups_by_now();
  // The call is queued, because it fills the table whose row emits this signal.
  QMetaObject::invokeMethod(this, &SetupDialog::examine, Qt::QueuedConnection);
}

void SetupDialog::examine() {
  groups_ = groups_by_now();
  show_groups();
  joints_->show_groups(*chosen().model, groups_);
  if (sampled_.samples > 0) {
    findings_ = geometric::examine_robot(*chosen().model, sampled_, groups_);
    show_findings();
    show_pairs();
  }
}

void SetupDialog::show_groups() {
  const bool has_wrist = !geometric::propose_groups(*chosen().model).wrist.empty();
  wrist_->setVisible(has_wrist);
  wrist_label_->setVisible(has_wrist);
  const auto row = [](const QString& name, const QString& value) {
    return QStringLiteral("<b>%1</b> %2").arg(name, value.toHtmlEscaped());
  };
  QStringList rows;
  const auto add = [&](const QString& name, const std::vector<std::string>& names) {
    if (!names.empty()) {
      rows << row(name, joined(names));
    }
  };
  add(tr("Arm"), groups_.arm);
  add(tr("Hand"), groups_.hand);
  add(tr("Wrist"), groups_.wrist);
  if (!groups_.palm.empty()) {
    rows << row(tr("Palm"), QString::fromStdString(groups_.palm));
    add(tr("Fingertips"), groups_.fingertips);
  } else if (!groups_.tip.empty()) {
    rows << row(tr("Tip"), QString::fromStdString(groups_.tip));
  }
  if (sampled_.samples > 0) {
    rows << tr("%1 % of %2 random postures collide")
                .arg(100.0 * sampled_.colliding / sampled_.samples, 0, 'f', 1)
                .arg(sampled_.samples);
  }
  group_text_->setText(rows.join(QStringLiteral("<br>")));
}

void SetupDialog::show_findings() {
  list_->clear();
  for (const RobotFinding& finding : findings_) {
    auto* row = new QListWidgetItem(icon("warning"), QString::fromStdString(finding.found) +
                                                         QLatin1Char('\n') +
                                                         QString::fromStdString(finding.mend));
    list_->addItem(row);
  }
  if (findings_.empty() && sampled_.samples > 0) {
    auto* row = new QListWidgetItem(tr("Nothing: the robot is ready."));
    row->setFlags(Qt::NoItemFlags);
    list_->addItem(row);
  }
  tabs_->setTabText(
      0, sampled_.samples > 0 ? tr("Suspicious (%1)").arg(findings_.size()) : tr("Suspicious"));
  view_->set_collisions({});
}

void SetupDialog::show_pairs() {
  const int kind = std::max(0, kind_->currentIndex());
  pairs_->show_pairs(sampled_, sampled_.samples > 0 ? set_up().allowed_collisions
                                                    : geometric::AllowedCollisions());
  const QSignalBlocker quiet(kind_);
  kind_->clear();
  kind_->addItems(pairs_->kinds());
  kind_->setCurrentIndex(kind);
  pairs_->show_kind(kind);
}

void SetupDialog::show_finding(int row) {
  if (row < 0 || row >= static_cast<int>(findings_.size())) {
    return;
  }
  const RobotFinding& finding = findings_[static_cast<std::size_t>(row)];
  posture_->setCurrentIndex(finding.at_middle ? kMiddle : kZero);
  view_->set_collisions(finding.links);
}

void SetupDialog::show_posture() {
  const RobotModel& model = *chosen().model;
  view_->set_configuration(posture_->currentIndex() == kMiddle
                               ? geometric::Configuration(0.5 * (model.lower() + model.upper()))
                               : model.neutral());
}

void SetupDialog::show_outcome(const QString& words, bool is_problem) {
  outcome_->setText(is_problem ? colored(words, colors_of(current_theme()).bad)
                               : words.toHtmlEscaped());
}

void SetupDialog::write() {
  RobotFile& robot = robots_[static_cast<std::size_t>(robot_->currentIndex())];
  geometric::RobotDescription description = set_up();
  const QString file = QString::fromStdString(robot.srdf.string());
  try {
    geometric::update_srdf(description, robot.srdf,
                           groups_are_decided() ? std::vector<std::string>{"arm", "hand"}
                                                : std::vector<std::string>{});
  } catch (const std::exception& error) {
    show_outcome(QString::fromUtf8(error.what()), true);
    return;
  }
  description.warnings.clear();
  robot.model = std::make_shared<const RobotModel>(std::move(description));
  write_->setEnabled(false);
  show_outcome(tr("Writing %1…").arg(file), false);
  editor_.set_model(robot.name, robot.model, [this, file](const QString& problem) {
    show_outcome(problem.isEmpty() ? tr("Wrote %1; the scene uses it now.").arg(file) : problem,
                 !problem.isEmpty());
    write_->setEnabled(true);
    if (problem.isEmpty()) {
      emit written(file);
    }
  });
}

}  // namespace handway::gui
