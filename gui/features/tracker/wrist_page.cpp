#include "features/tracker/wrist_page.h"

#include "features/workbench.h"
#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/panels/link_status.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QStyle>
#include <QVariant>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>

namespace handway::gui {
namespace {

using geometric::kDegree;

constexpr double kFarthest = 10.0;  // m
constexpr double kBoxHalf = 0.3;    // m
constexpr double kDefaultReach = 1.0;
constexpr int kAnySensor = -1;
constexpr double kMilli = 1e-3;

constexpr double kUsualSpeed = 60.0 * kDegree;  // rad/s

// Settings at first, and their descriptions.
device::ToolFollowerSettings usual_following() {
  device::ToolFollowerSettings settings;
  settings.top_speed = kUsualSpeed;
  return settings;
}

geometric::Parameter following_setting(const char* key) {
  device::ToolFollowerSettings usual = usual_following();
  return geometric::value_of(find_parameter(parameters_of(usual), key));
}

QString following_label(const char* key) {
  return QString::fromStdString(following_setting(key).label);
}

QuantityField* length_field(const QString& name) {
  auto* field = new QuantityField(QuantityField::Kind::kLength, -kFarthest, kFarthest);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  field->setMinimumWidth(scaled(60));
  field->setObjectName(name);
  return field;
}

}  // namespace

FollowForm::FollowForm(QWidget* parent)
    : QWidget(parent),
      sensor_(new QSpinBox),
      button_(new QCheckBox(tr("Track while the button is held"))),
      scale_(named("tracker_scale", new QDoubleSpinBox)),
      turn_(named("tracker_turn", new QCheckBox(following_label("turn")))),
      source_yaw_(
          new QuantityField(QuantityField::Kind::kAngle, -std::numbers::pi, std::numbers::pi)),
      smoothing_(new QSpinBox),
      speed_(new QuantityField(QuantityField::Kind::kAngularSpeed,
                               following_setting("top_speed").lower,
                               following_setting("top_speed").upper)),
      box_(named("tracker_box", new QCheckBox(tr("Keep the tool within a box")))),
      box_fields_(new QWidget),
      limits_reach_(named("tracker_limits_reach", new QCheckBox(tr("Keep it within a reach")))),
      reach_(length_field(QStringLiteral("tracker_reach"))) {
  lay_out(*this, in_column({heading(tr("Motion")), build_motion(), heading(tr("Workspace")),
                            build_workspace()},
                           8));
}

QWidget* FollowForm::build_motion() {
  sensor_->setRange(kAnySensor, 255);
  sensor_->setValue(kAnySensor);
  sensor_->setSpecialValueText(tr("first"));
  sensor_->setToolTip(
      tr("Number of the sensor: Polhemus stations count from 1, senders of datagrams from 0"));
  const device::ToolFollowerSettings usual = usual_following();
  const geometric::Parameter scale = following_setting("scale");
  scale_->setRange(scale.lower, scale.upper);
  scale_->setSingleStep(scale.lower);
  scale_->setValue(usual.translation_scale);
  scale_->setPrefix(QStringLiteral("× "));
  scale_->setToolTip(QString::fromStdString(scale.help));
  turn_->setChecked(usual.rotate);
  source_yaw_->setToolTip(
      tr("Rotation of the tracker's source about the vertical axis of the robot's base"));
  const geometric::Parameter smoothing = following_setting("smoothing_ms");
  smoothing_->setRange(static_cast<int>(smoothing.lower), static_cast<int>(smoothing.upper));
  smoothing_->setValue(static_cast<int>(std::lround(usual.smoothing / kMilli)));
  smoothing_->setSuffix(tr(" ms"));
  smoothing_->setToolTip(QString::fromStdString(smoothing.help));
  speed_->show_quantity(usual.top_speed);
  speed_->setToolTip(QString::fromStdString(following_setting("top_speed").help));
  auto* part = new QWidget;
  auto* form = new QFormLayout(part);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(12);
  form->addRow(tr("Sensor"), sensor_);
  form->addRow(button_);
  form->addRow(following_label("scale"), scale_);
  form->addRow(turn_);
  form->addRow(tr("Source rotation"), source_yaw_);
  form->addRow(following_label("smoothing_ms"), smoothing_);
  form->addRow(following_label("top_speed"), speed_);
  const auto notify = [this] { emit settings_edited(); };
  connect(scale_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, notify);
  connect(turn_, &QCheckBox::toggled, this, notify);
  connect(source_yaw_, &QuantityField::quantity_edited, this, notify);
  connect(smoothing_, qOverload<int>(&QSpinBox::valueChanged), this, notify);
  connect(speed_, &QuantityField::quantity_edited, this, notify);
  return part;
}

QWidget* FollowForm::build_workspace() {
  reach_->setMinimum(1.0);
  reach_->show_quantity(kDefaultReach);
  const auto notify = [this] { emit settings_edited(); };
  auto* grid = new QGridLayout(box_fields_);
  grid->setContentsMargins(22, 0, 0, 0);
  grid->setHorizontalSpacing(6);
  grid->setVerticalSpacing(5);
  grid->addWidget(note(tr("from")), 0, 1);
  grid->addWidget(note(tr("to")), 0, 2);
  constexpr std::array kAxes{"X", "Y", "Z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i) + 1;
    const QString axis = QString::fromLatin1(kAxes.at(i));
    least_.at(i) = length_field(QStringLiteral("tracker_least_") + axis);
    most_.at(i) = length_field(QStringLiteral("tracker_most_") + axis);
    grid->addWidget(note(axis), row, 0);
    grid->addWidget(least_.at(i), row, 1);
    grid->addWidget(most_.at(i), row, 2);
    connect(least_.at(i), &QuantityField::quantity_edited, this, notify);
    connect(most_.at(i), &QuantityField::quantity_edited, this, notify);
  }
  centre_box(Eigen::Vector3d(0.5, 0.0, 0.5));
  limits_reach_->setToolTip(tr("Distance of the tool from the origin of the robot's base"));
  reach_->setMaximumWidth(scaled(90));
  box_fields_->hide();
  reach_->setEnabled(false);
  connect(box_, &QCheckBox::toggled, box_fields_, &QWidget::setVisible);
  connect(limits_reach_, &QCheckBox::toggled, reach_, &QWidget::setEnabled);
  connect(box_, &QCheckBox::toggled, this, notify);
  connect(limits_reach_, &QCheckBox::toggled, this, notify);
  connect(reach_, &QuantityField::quantity_edited, this, notify);
  return boxed(in_column({box_, box_fields_, in_row({{limits_reach_, 1}, reach_})}, 6));
}

void FollowForm::centre_box(const Eigen::Vector3d& p_B) {
  if (box_->isChecked()) {
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double centre = p_B[static_cast<Eigen::Index>(i)];
    least_.at(i)->show_quantity(centre - kBoxHalf);
    most_.at(i)->show_quantity(centre + kBoxHalf);
  }
}

device::ToolFollowerSettings FollowForm::settings() const {
  device::ToolFollowerSettings settings;
  settings.R_BS = Eigen::AngleAxisd(source_yaw_->quantity(), Eigen::Vector3d::UnitZ()).matrix();
  settings.translation_scale = scale_->value();
  settings.rotate = turn_->isChecked();
  settings.smoothing = smoothing_->value() * kMilli;
  settings.top_speed = speed_->quantity();
  if (box_->isChecked()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      settings.workspace.box.min()[axis] = least_.at(i)->quantity();
      settings.workspace.box.max()[axis] = most_.at(i)->quantity();
    }
  }
  if (limits_reach_->isChecked()) {
    settings.workspace.reach = reach_->quantity();
  }
  return settings;
}

std::optional<int> FollowForm::sensor() const {
  return sensor_->value() == kAnySensor ? std::nullopt : std::optional(sensor_->value());
}

bool FollowForm::button_closes() const { return button_->isChecked(); }

namespace {

using device::FollowState;
using device::FollowStep;
using device::StreamState;

constexpr int kRefreshMs = 100;
constexpr int kMargin = 12;
constexpr double kLongestStep = 0.1;  // s

bool is_live(StreamState state) {
  return state != StreamState::kStopped && state != StreamState::kFailed;
}

QString place_text(const Eigen::Vector3d& p) {
  return QStringLiteral("%1  %2  %3 mm")
      .arg(geometric::millimetres(p.x()), 0, 'f', 0)
      .arg(geometric::millimetres(p.y()), 0, 'f', 0)
      .arg(geometric::millimetres(p.z()), 0, 'f', 0);
}

QString follow_text(const FollowStep& step) {
  switch (step.state) {
    case FollowState::kFollowing:
      return step.at_workspace_edge ? QObject::tr("At the edge of the workspace")
                                    : QObject::tr("The arm follows");
    case FollowState::kSlowed:
      return QObject::tr("Moving at the velocity limits of the joints");
    case FollowState::kOutOfReach:
      return QObject::tr("Out of reach: %1").arg(QString::fromStdString(step.reason));
    case FollowState::kBranchEnd:
      return QObject::tr("The arm is blocked: move the hand back");
    case FollowState::kReleased:
      break;
  }
  return QObject::tr("The arm is at rest");
}

QColor follow_color(const FollowStep& step) {
  const ThemeColors colors = colors_of(current_theme());
  switch (step.state) {
    case FollowState::kFollowing:
      return step.at_workspace_edge ? attention_color() : colors.good;
    case FollowState::kSlowed:
      return attention_color();
    case FollowState::kOutOfReach:
    case FollowState::kBranchEnd:
      return colors.bad;
    case FollowState::kReleased:
      break;
  }
  return colors.muted;
}

}  // namespace

WristPage::WristPage(QWidget* parent)
    : QWidget(parent),
      protocol_(named("tracker_protocol", new QComboBox)),
      address_(named("tracker_address", new QLineEdit)),
      connect_(named("tracker_connect", new QPushButton)),
      status_(new LinkStatus(QStringLiteral("tracker"))),
      clutch_(named("tracker_clutch", new QPushButton)),
      follow_(named("tracker_follow", new QLabel)),
      wrist_(named("tracker_wrist", note())),
      form_(new FollowForm) {
  lay_out(*this, in_column({build_device(), build_clutch(), form_, room()}, 10),
          {kMargin, 12, kMargin, 10});
  connect(&session_, &TrackerSession::state_changed, this, &WristPage::show_state);
  connect(&session_, &TrackerSession::sampled, this, &WristPage::show_samples);
  connect(&leader_, &ArmLeader::wanted, this, &WristPage::posture_wanted);
  connect(&leader_, &ArmLeader::clutch_changed, this, &WristPage::show_clutch);
  connect(&leader_, &ArmLeader::followed, this, [this](const FollowStep& step) { step_ = step; });
  connect(form_, &FollowForm::settings_edited, this, &WristPage::apply_settings);
  ticker_.setInterval(kRefreshMs);
  connect(&ticker_, &QTimer::timeout, this, &WristPage::refresh);
  apply_settings();
  show_state(StreamState::kStopped, {});
  show_clutch(false);
}

WristPage::~WristPage() {
  session_.blockSignals(true);
  leader_.blockSignals(true);
}

QWidget* WristPage::build_device() {
  protocol_->addItem(tr("Emulator"), QStringLiteral("emulator"));
  protocol_->addItem(tr("Polhemus Fastrak"), QStringLiteral("fastrak"));
  protocol_->addItem(tr("Polhemus Liberty"), QStringLiteral("liberty"));
  protocol_->addItem(tr("Datagrams (UDP)"), QStringLiteral("udp"));
  protocol_->setItemData(
      protocol_->count() - 1,
      tr("Poses that a program sends, or the wrists of hands of OpenXR and Rokoko Studio"),
      Qt::ToolTipRole);
  const auto show_address = [this] {
    const QString protocol = protocol_->currentData().toString();
    address_->setVisible(protocol != QLatin1String("emulator"));
    address_->setPlaceholderText(protocol == QLatin1String("udp")
                                     ? tr("5005 or 0.0.0.0:5005")
                                     : tr("/dev/ttyUSB0 or host:port"));
  };
  connect(protocol_, qOverload<int>(&QComboBox::currentIndexChanged), this, show_address);
  connect(connect_, &QPushButton::clicked, this, &WristPage::toggle_connection);
  connect(address_, &QLineEdit::returnPressed, this, &WristPage::toggle_connection);
  show_address();
  return boxed(in_column({in_row({{protocol_, 1}, connect_}, 8), address_, status_}, 8));
}

QWidget* WristPage::build_clutch() {
  clutch_->setCheckable(true);
  clutch_->setShortcut(QKeySequence(QStringLiteral("Ctrl+K")));
  clutch_->setToolTip(
      tr("The tool follows the wrist's motion relative to the present poses of both. Release the "
         "button to move your hand back to a comfortable position (Ctrl+K)"));
  follow_->setTextFormat(Qt::RichText);
  follow_->setWordWrap(true);
  connect(clutch_, &QPushButton::clicked, &leader_, &ArmLeader::set_clutch);
  return boxed(in_column({clutch_, follow_, wrist_}, 6));
}

void WristPage::set_robot(const std::shared_ptr<const geometric::RobotModel>& model,
                          const std::vector<int>& arm) {
  leader_.set_robot(model, arm, model ? model->neutral() : geometric::Configuration());
  refresh();
}

void WristPage::set_configuration(const geometric::Configuration& q) {
  leader_.set_configuration(q);
  if (!leader_.is_clutch_closed() && isVisible()) {
    if (const auto p_BF = leader_.tool_position()) {
      form_->centre_box(*p_BF);
    }
  }
}

void WristPage::toggle_connection() {
  if (session_.link().is_running() && is_live(session_.link().state())) {
    session_.disconnect_tracker();
    return;
  }
  first_time_ = last_time_ = -1.0;
  const QString protocol = protocol_->currentData().toString();
  session_.connect_to(protocol == QLatin1String("emulator")
                          ? protocol
                          : protocol + QLatin1Char(':') + address_->text());
}

void WristPage::connect_to(const QString& device) {
  if (device.isEmpty()) {
    return;
  }
  session_.disconnect_tracker();
  const QString protocol = device.section(QLatin1Char(':'), 0, 0).toLower();
  protocol_->setCurrentIndex(std::max(protocol_->findData(protocol), 0));
  address_->setText(device.mid(protocol.size() + 1));
  first_time_ = last_time_ = -1.0;
  session_.connect_to(device);
  leader_.set_clutch(true);
}

double WristPage::listening_time() const { return last_time_ - first_time_; }

void WristPage::apply_settings() {
  const device::ToolFollowerSettings settings = form_->settings();
  try {
    check_workspace(settings.workspace);
    leader_.set_settings(settings);
    complaint_.clear();
  } catch (const std::exception& error) {
    complaint_ = QString::fromUtf8(error.what());
  }
  refresh();
}

void WristPage::show_state(StreamState state, const QString& error) {
  const bool live = is_live(state);
  connect_->setText(live ? tr("Disconnect") : tr("Connect"));
  set_role(*connect_, live ? QString() : QStringLiteral("primary"));
  protocol_->setEnabled(!live);
  address_->setEnabled(!live);
  const device::TrackerInfo info = session_.link().info();
  status_->show_state(state, QString::fromStdString(info.model),
                      QString::fromStdString(info.device), error);
  if (state != StreamState::kStreaming) {
    sample_.reset();
    emit released();
  }
  if (live) {
    ticker_.start();
  } else {
    ticker_.stop();
    leader_.set_clutch(false);
    status_->clear_statistics();
  }
  refresh();
}

void WristPage::show_samples(const std::vector<device::TrackerSample>& samples) {
  first_time_ = first_time_ < 0.0 ? samples.front().time : first_time_;
  last_time_ = samples.back().time;
  const int sensor = form_->sensor().value_or(sample_ ? sample_->sensor : samples.front().sensor);
  const auto latest =
      std::find_if(samples.rbegin(), samples.rend(),
                   [&](const device::TrackerSample& sample) { return sample.sensor == sensor; });
  for (const device::TrackerSample& sample : samples) {
    // A window that was busy goes through what it missed in steps that the arm can follow.
    const bool last = latest != samples.rend() && &sample == &*latest;
    if (sample.sensor != sensor ||
        (!last && sample_ && sample.time < sample_->time + kLongestStep)) {
      continue;
    }
    sample_ = sample;
    if (form_->button_closes() && sample.button) {
      leader_.set_clutch(*sample.button);
    }
    leader_.take(sample);
  }
}

void WristPage::show_clutch(bool closed) {
  clutch_->setChecked(closed);
  clutch_->setText(closed ? tr("Release the arm") : tr("Lead the arm"));
  if (!closed) {
    step_.reset();
    emit released();
  }
  refresh();
}

// The text is updated more slowly than samples come, to be readable.
void WristPage::refresh() {
  if (session_.link().state() == StreamState::kStreaming) {
    status_->show_statistics(session_.link().statistics());
  }
  clutch_->setEnabled(leader_.problem().isEmpty() && is_live(session_.link().state()));
  const QString problem = complaint_.isEmpty() ? leader_.problem() : complaint_;
  const FollowStep step = step_.value_or(FollowStep{});
  const QColor color = problem.isEmpty() ? follow_color(step) : colors_of(current_theme()).bad;
  follow_->setText(dotted(problem.isEmpty() ? follow_text(step) : problem, color));
  QStringList places;
  if (sample_) {
    places << tr("Wrist  %1").arg(place_text(sample_->X_ST.translation()));
  }
  if (step_) {
    places << tr("Tool  %1").arg(place_text(step_->X_BF.translation()));
  }
  wrist_->setText(places.join(QStringLiteral("      ")));
  wrist_->setVisible(!places.isEmpty());
}

void add_tracker(Workbench& workbench) {
  auto* page = new WristPage;
  workbench.add_page("glove", QObject::tr("Wrist"), page);
  workbench.add_stream([page]() -> std::optional<double> {
    const auto& link = page->session().link();
    const bool runs = link.is_running() && link.state() != device::StreamState::kFailed;
    return runs ? std::optional(page->listening_time()) : std::nullopt;
  });
  Document& document = workbench.document;
  ContactGuard& guard = workbench.guard;
  QObject::connect(&document, &Document::configuration_changed, page,
                   &WristPage::set_configuration);
  QObject::connect(page, &WristPage::posture_wanted, &guard,
                   [&guard](const geometric::NamedPosture& posture) {
                     guard.propose(ContactGuard::Leader::kArm, posture);
                   });
  QObject::connect(page, &WristPage::released, &guard,
                   [&guard] { guard.withdraw(ContactGuard::Leader::kArm); });
  const auto set_robot = [page, &document] {
    const geometric::RobotInstance* robot = document.robot();
    page->set_robot(robot ? robot->model : nullptr, document.joints().arm);
  };
  QObject::connect(&workbench, &Workbench::scene_shown, page, set_robot);
  QObject::connect(&document, &Document::hand_changed, page, set_robot);
  QObject::connect(&workbench, &Workbench::ready, page, [page, &workbench] {
    const Options& options = workbench.options;
    if (!options.tracker.empty() && workbench.document.scene()->start) {
      workbench.posing.set(*workbench.document.scene()->start);
    }
    page->connect_to(QString::fromStdString(options.tracker));
  });
}

}  // namespace handway::gui
