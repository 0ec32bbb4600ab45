#include "features/postures/joint_panel.h"

#include "features/postures/likeness_meter.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/slider_row.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/theme.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>

#include <algorithm>
#include <cmath>
#include <optional>

namespace handway::gui {
namespace {

using geometric::JointType;

constexpr int kAround = 60;  // px, of a row that is brought into sight
constexpr int kLabelWidth = 128;

SliderRow::Range range_of(const geometric::JointLimits& limits, JointType type) {
  if (type == JointType::kPrismatic) {
    return {limits.lower, limits.upper, 1e3, QStringLiteral(" mm"), 1};
  }
  return {limits.lower, limits.upper, 1.0 / geometric::kDegree, QStringLiteral("°"), 1};
}

// Limits of a joint: what its leader, if it is coupled, lets it reach. Continuous joints are shown
// over one turn.
geometric::JointLimits reach(const geometric::RobotModel& model, int link) {
  const geometric::RobotModel::MimicMapping& drive = model.mimic_mapping(link);
  const double a = drive.multiplier * model.lower()[drive.variable] + drive.offset;
  const double b = drive.multiplier * model.upper()[drive.variable] + drive.offset;
  geometric::JointLimits limits;
  limits.lower = std::min(a, b);
  limits.upper = std::max(a, b);
  return limits;
}

}  // namespace

JointPanel::JointPanel(QWidget* parent)
    : QWidget(parent), scroll_(new PanelArea), content_(nullptr), layout_(nullptr) {
  content_ = new QWidget;
  layout_ = new QVBoxLayout(content_);
  layout_->setContentsMargins(12, 10, 12, 10);
  layout_->setSpacing(3);
  scroll_->setWidget(content_);
  lay_out(*this, in_column({scroll_}));
}

void JointPanel::set_robot(std::shared_ptr<const geometric::RobotModel> model,
                           const geometric::JointSelection& joints) {
  model_ = std::move(model);
  rows_.clear();
  while (QLayoutItem* item = layout_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  if (model_) {
    q_ = model_->neutral();
    add_group(tr("Arm"), joints.arm);
    add_group(tr("Hand"), joints.hand);
    add_group(tr("Other"), joints.outside_arm_and_hand());
  }
  layout_->addStretch();
}

void JointPanel::add_group(const QString& title, const std::vector<int>& variables) {
  if (variables.empty()) {
    return;
  }
  layout_->addWidget(heading(title));
  std::vector<int> links;
  for (int link = 1; link < model_->link_count(); ++link) {
    if (std::ranges::count(variables, model_->mimic_mapping(link).variable) > 0) {
      links.push_back(link);
    }
  }
  for (const int link : links) {
    const int variable = model_->mimic_mapping(link).variable;
    SliderRow* row = add_row(link);
    if (model_->variable_link(variable) != link) {
      row->set_read_only();
      row->setToolTip(
          tr("Coupled to %1").arg(QString::fromStdString(model_->variable(variable).name)));
      continue;
    }
    connect(row, &SliderRow::value_edited, this, [this, variable](double value) {
      q_[variable] = value;
      set_configuration(geometric::Configuration(q_));
      emit configuration_edited(q_);
    });
  }
}

SliderRow* JointPanel::add_row(int link) {
  const geometric::Joint& joint = model_->joint(link);
  auto* row =
      new SliderRow(QString::fromStdString(joint.name), range_of(reach(*model_, link), joint.type));
  row->use_two_lines();
  row->setObjectName(QString::fromStdString(joint.name));
  layout_->addWidget(row);
  rows_.push_back({link, row});
  return row;
}

void JointPanel::show_link(const std::string& name) {
  const std::optional<int> named = model_ ? model_->find_link(name) : std::nullopt;
  if (!named) {
    return;
  }
  const auto row_of = [this](int link) { return std::ranges::find(rows_, link, &Row::link); };
  int link = *named;
  while (link > 0 && row_of(link) == rows_.end()) {
    link = model_->parent(link);
  }
  const auto chosen = row_of(link);
  for (const Row& row : rows_) {
    row.slider->set_chosen(chosen != rows_.end() && row.link == link);
  }
  if (chosen != rows_.end()) {
    scroll_->ensureWidgetVisible(chosen->slider, 0, kAround);
  }
}

void JointPanel::set_configuration(const geometric::Configuration& q) {
  if (!model_) {
    return;
  }
  q_ = q;
  const geometric::Configuration shown =
      model_->nearest_equivalent(geometric::Configuration::Zero(q.size()), q);
  for (const Row& row : rows_) {
    const geometric::RobotModel::MimicMapping& drive = model_->mimic_mapping(row.link);
    row.slider->set_value(drive.multiplier * shown[drive.variable] + drive.offset);
  }
}

PmdPanel::PmdPanel(RecordedHand& recorded, QWidget* parent)
    : QWidget(parent),
      axes_(new QWidget),
      axes_layout_(new QVBoxLayout(axes_)),
      note_(note()),
      choose_(named("choose_basis", new QPushButton(tr("Choose a basis…")))),
      likeness_(new LikenessMeter(recorded)) {
  axes_layout_->setContentsMargins(0, 0, 0, 0);
  axes_layout_->setSpacing(3);
  note_->setWordWrap(true);
  note_->setText(
      tr("This scene names no PMD basis for its hand. Choose one, or make one from postures of a "
         "person, to move the hand along its principal motion directions and to plan "
         "human-like."));
  choose_->setToolTip(
      tr("Choose a basis of this hand: one that ships, a file, or captured postures"));
  lay_out(*this, in_column({axes_, note_, {choose_, 0, Qt::AlignLeft}, likeness_, room()}, 8),
          {12, 10, 12, 10});
  connect(likeness_, &LikenessMeter::configuration_edited, this, &PmdPanel::configuration_edited);
  connect(choose_, &QPushButton::clicked, this, &PmdPanel::basis_wanted);
}

void PmdPanel::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                        std::shared_ptr<const sampling::PmdBasis> basis,
                        const std::vector<int>& hand) {
  model_ = std::move(model);
  basis_ = std::move(basis);
  hand_ = hand;
  rows_.clear();
  while (QLayoutItem* item = axes_layout_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  if (!model_ || !basis_ || hand_.size() != basis_->joints.size()) {
    basis_.reset();
  }
  note_->setVisible(!basis_);
  likeness_->set_hand(model_, basis_, hand_);
  if (!basis_) {
    return;
  }
  q_ = model_->neutral();
  axes_layout_->addWidget(heading(tr("Free joints and principal motion directions")));
  for (const sampling::FreeJoint& free : basis_->free_joints) {
    add_axis(QString::fromStdString(basis_->joints[static_cast<std::size_t>(free.joint)]),
             free.half_side, 0.0);
  }
  for (const sampling::PrincipalDirection& direction : basis_->directions) {
    add_axis(QString::fromStdString(direction.name), direction.half_side, direction.variance);
  }
  auto* centre = named("mean_posture", new QPushButton(tr("Mean posture")));
  centre->setToolTip(tr("All coordinates to zero: the mean of the recorded human postures"));
  connect(centre, &QPushButton::clicked, this, [this] {
    for (SliderRow* row : rows_) {
      row->set_value(0.0);
    }
    move_hand();
  });
  axes_layout_->addSpacing(6);
  axes_layout_->addWidget(centre, 0, Qt::AlignLeft);
}

void PmdPanel::add_axis(const QString& name, double half_side, double variance) {
  auto* row = new SliderRow(name, {-half_side, half_side, 1.0, QString(), 3});
  row->set_label_width(scaled(kLabelWidth));
  row->setObjectName(name);
  if (variance > 0.0) {
    row->setToolTip(tr("%1: standard deviation %2 of the normalised joints, half side %3")
                        .arg(name, QString::number(std::sqrt(variance), 'f', 3),
                             QString::number(half_side, 'f', 3)));
  }
  connect(row, &SliderRow::value_edited, this, [this] { move_hand(); });
  axes_layout_->addWidget(row);
  rows_.push_back(row);
}

Eigen::VectorXd PmdPanel::hand_posture() const {
  const geometric::Configuration p = geometric::normalised(*model_, q_);
  Eigen::VectorXd posture(static_cast<Eigen::Index>(hand_.size()));
  for (std::size_t i = 0; i < hand_.size(); ++i) {
    posture[static_cast<Eigen::Index>(i)] = p[hand_[i]];
  }
  return posture;
}

void PmdPanel::move_hand() {
  Eigen::VectorXd u(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::size_t free_count = basis_->free_joints.size();
    const double half_side = i < free_count ? basis_->free_joints[i].half_side
                                            : basis_->directions[i - free_count].half_side;
    const double e = half_side > 0.0 ? rows_[i]->value() / half_side : 0.0;
    u[static_cast<Eigen::Index>(i)] = 0.5 * (e + 1.0);
  }
  const Eigen::VectorXd posture = sampling::map_to_posture(*basis_, u);
  geometric::Configuration p = geometric::normalised(*model_, q_);
  for (std::size_t i = 0; i < hand_.size(); ++i) {
    p[hand_[i]] = posture[static_cast<Eigen::Index>(i)];
  }
  q_ = geometric::denormalised(*model_, p);
  likeness_->set_configuration(q_);
  moving_ = true;
  emit configuration_edited(q_);
  moving_ = false;
}

void PmdPanel::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  if (!basis_ || moving_) {
    return;
  }
  const Eigen::VectorXd e = sampling::project(*basis_, hand_posture());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i]->set_value(e[static_cast<Eigen::Index>(i)]);
  }
  likeness_->set_configuration(q_);
}

}  // namespace handway::gui
