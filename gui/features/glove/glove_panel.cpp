#include "features/glove/glove_panel.h"

#include "features/glove/calibration_choice.h"
#include "features/glove/calibration_guide.h"
#include "features/glove/capture_coach.h"
#include "features/glove/device_field.h"
#include "features/glove/glove_sources.h"
#include "features/glove/mapping_editor.h"
#include "features/glove/pmd_explorer.h"
#include "features/glove/record_bar.h"
#include "features/glove/sensor_bars.h"
#include "features/workbench.h"
#include "handway/planning/core/select_joints.h"
#include "model/document/document.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/link_status.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QTabBar>
#include <QTabWidget>
#include <QVariant>

namespace handway::gui {
namespace {

using device::StreamState;

constexpr int kStatisticsMs = 250;
constexpr int kMargin = 12;
constexpr double kSmoothing = 0.2;  // weight of the latest delay

QString glove_text(const device::GloveInfo& info) {
  return QObject::tr("%1, %2 hand, %3 sensors")
      .arg(QString::fromStdString(info.model).section(QLatin1Char(','), 0, 0),
           info.right_hand ? QObject::tr("right") : QObject::tr("left"))
      .arg(info.sensors);
}

bool is_live(StreamState state) {
  return state != StreamState::kStopped && state != StreamState::kFailed;
}

}  // namespace

GlovePanel::GlovePanel(ContactGuard& guard, QUndoStack& history, QWidget* parent)
    : QWidget(parent),
      device_(new DeviceField),
      connect_(named("glove_connect", new QPushButton)),
      status_(new LinkStatus(QStringLiteral("glove"))),
      tabs_(named("glove_pages", new QTabBar)),
      pages_(new QStackedWidget),
      bars_(new SensorBars),
      capture_(session_),
      mapping_editor_(new MappingEditor(session_, history)),
      guard_(guard),
      follow_(named("glove_follow", new QCheckBox(tr("Hand follows")))),
      rule_(named("contact_rule", new QComboBox)),
      contact_(named("glove_contact", note())),
      record_(new RecordBar(session_)) {
  tabs_->setDrawBase(false);
  tabs_->setExpanding(true);
  tabs_->setProperty("role", "pages");
  put_page(tr("Sensors"), build_sensors_page());
  add_page(tr("Coach"), &capture_.coach());
  add_page(tr("Explore"), &capture_.explorer());
  add_page(tr("Mapping"), mapping_editor_);
  lay_out(*this, in_column({build_header(), tabs_, {pages_, 1}, build_footer()}, 0));
  bars_->set_mapping(session_.mapping());
  connect(tabs_, &QTabBar::currentChanged, pages_, &QStackedWidget::setCurrentIndex);
  connect(&session_, &GloveSession::state_changed, this, &GlovePanel::show_state);
  connect(&session_, &GloveSession::sampled, this, &GlovePanel::show_samples);
  connect(&session_, &GloveSession::mapping_changed, this,
          [this] { bars_->set_mapping(session_.mapping()); });
  connect(&capture_, &CapturePages::failed, this, &GlovePanel::show_problem);
  connect(mapping_editor_, &MappingEditor::failed, this, &GlovePanel::show_problem);
  connect(&capture_.explorer(), &PmdExplorer::posture_changed, this,
          [this](const geometric::NamedPosture& posture) {
            session_.set_following(false);
            emit posture_changed(posture);
          });
  connect(&session_, &GloveSession::following_changed, follow_, &QCheckBox::setChecked);
  connect(&session_, &GloveSession::following_changed, this, [this](bool follow) {
    if (!follow) {
      guard_.withdraw(ContactGuard::Leader::kHand);
    }
  });
  ticker_.setInterval(kStatisticsMs);
  connect(&ticker_, &QTimer::timeout, this, &GlovePanel::show_statistics);
  show_state(StreamState::kStopped, {});
}

GlovePanel::~GlovePanel() { session_.blockSignals(true); }

QWidget* GlovePanel::build_header() {
  connect(connect_, &QPushButton::clicked, this, &GlovePanel::toggle_connection);
  connect(device_, &DeviceField::requested, this, [this] {
    session_.disconnect_glove();
    toggle_connection();
  });
  return boxed(in_column({in_row({{device_, 1}, connect_}, 8), status_}, 8),
               {kMargin, 10, kMargin, 8});
}

QWidget* GlovePanel::build_sensors_page() {
  auto* calibration = new CalibrationChoice;
  auto* calibrate = named("calibrate", new QPushButton(tr("Calibrate…")));
  calibrate->setToolTip(
      tr("Calibrate the glove in a minute: hold some postures, which are shown one by one"));
  auto* form = new QFormLayout;
  form->setContentsMargins(kMargin, 4, kMargin, 0);
  form->setHorizontalSpacing(12);
  form->addRow(tr("Calibration"), calibration);
  form->addRow(QString(), calibrate);
  auto* page = boxed(in_column({bars_, form, room()}, 6), {0, 4, 0, 8});
  connect(calibration, &CalibrationChoice::chosen, &session_, &GloveSession::set_calibration);
  connect(calibration, &CalibrationChoice::failed, this, &GlovePanel::show_problem);
  auto* guide = new CalibrationGuide(session_);
  auto* pages = new QStackedWidget;
  pages->addWidget(new PanelArea(page));
  pages->addWidget(new PanelArea(guide));
  connect(calibrate, &QPushButton::clicked, this, [this, guide, pages] {
    if (session_.link().state() != StreamState::kStreaming) {
      show_problem(tr("Connect the glove first"));
      return;
    }
    pages->setCurrentIndex(1);
    guide->begin();
  });
  connect(guide, &CalibrationGuide::closed, pages, [pages] { pages->setCurrentIndex(0); });
  connect(guide, &CalibrationGuide::failed, this, &GlovePanel::show_problem);
  connect(guide, &CalibrationGuide::saved, this, [this, calibration, pages](const QString& file) {
    calibration->load(file);
    pages->setCurrentIndex(0);
    come_to_front(QStringLiteral("Coach"));
  });
  return pages;
}

QWidget* GlovePanel::build_footer() {
  auto* footer = new QFrame;
  footer->setProperty("role", "playback");
  follow_->setChecked(session_.following());
  follow_->setToolTip(tr("The hand in the view follows the glove"));
  rule_->addItem(tr("Pass through, mark red"));
  rule_->addItem(tr("Stop at contact"));
  rule_->addItem(tr("Slide at contact"));
  rule_->setToolTip(
      tr("Motion of glove or tracker into an object: the robot passes through and colliding links "
         "turn red, it stops, or arm and fingers move as far as each is free"));
  contact_->setWordWrap(true);
  contact_->hide();
  rule_->setMinimumContentsLength(rule_->itemText(0).size());
  lay_out(*footer, in_column({follow_, rule_, contact_, record_}, 8), {kMargin, 8, kMargin, 10});
  connect(follow_, &QCheckBox::toggled, &session_, &GloveSession::set_following);
  connect(rule_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int rule) { guard_.set_rule(static_cast<ContactRule>(rule)); });
  connect(&guard_, &ContactGuard::held, this, [this](const QString& contact) {
    contact_->setText(tr("Blocked: %1").arg(contact));
    contact_->setVisible(!contact.isEmpty());
  });
  connect(&guard_, &ContactGuard::passed, this, &GlovePanel::posture_changed);
  return footer;
}

void GlovePanel::add_page(const QString& name, QWidget* page) {
  put_page(name, new PanelArea(page));
}

void GlovePanel::put_page(const QString& name, QWidget* page) {
  tabs_->addTab(name);
  pages_->addWidget(page);
}

void GlovePanel::set_hand(const std::shared_ptr<const geometric::RobotModel>& model,
                          const HandBasis& basis, std::shared_ptr<const PreparedProblem> problem) {
  session_.set_robot(model);
  capture_.set_hand(model, basis);
  take_basis(model, basis.basis, std::move(problem));
}

void GlovePanel::set_basis(const std::shared_ptr<const geometric::RobotModel>& model,
                           const HandBasis& basis, std::shared_ptr<const PreparedProblem> problem) {
  capture_.set_basis(basis);
  take_basis(model, basis.basis, std::move(problem));
}

void GlovePanel::take_basis(const std::shared_ptr<const geometric::RobotModel>& model,
                            const std::shared_ptr<const sampling::PmdBasis>& basis,
                            std::shared_ptr<const PreparedProblem> problem) {
  std::vector<std::string> free;
  if (basis) {
    for (const sampling::FreeJoint& joint : basis->free_joints) {
      free.push_back(basis->joints[static_cast<std::size_t>(joint.joint)]);
    }
  }
  mapping_editor_->set_hand(model, std::move(free));
  guard_.set_robot(model,
                   model ? moving_parts(*model, planning::select_joints(*model, basis.get()))
                         : std::vector<geometric::JointIndices>{},
                   std::move(problem));
}

void GlovePanel::set_configuration(const geometric::Configuration& q) {
  guard_.set_configuration(q);
  capture_.set_configuration(q);
}

void GlovePanel::toggle_connection() {
  if (session_.link().is_running() && is_live(session_.link().state())) {
    session_.disconnect_glove();
  } else {
    bars_->clear();
    first_time_ = last_time_ = -1.0;
    session_.connect_to(device_->device());
  }
}

void GlovePanel::connect_to(const QString& device) {
  if (!device.isEmpty()) {
    session_.disconnect_glove();
    device_->set_device(device.compare(GloveSession::emulator_name(), Qt::CaseInsensitive) == 0
                            ? GloveSession::emulator_name()
                            : device);
    toggle_connection();
  }
}

void GlovePanel::come_to_front(const QString& page) {
  bring_to_front(*this);
  for (int i = 0; i < tabs_->count(); ++i) {
    if (tabs_->tabText(i).compare(page, Qt::CaseInsensitive) == 0) {
      tabs_->setCurrentIndex(i);
    }
  }
}

double GlovePanel::listening_time() const { return last_time_ - first_time_; }

void GlovePanel::show_state(StreamState state, const QString& error) {
  const bool live = is_live(state);
  connect_->setText(live ? tr("Disconnect") : tr("Connect"));
  set_role(*connect_, live ? QString() : QStringLiteral("primary"));
  device_->setEnabled(!live);
  QString problem = error;
  if (problem.isEmpty() && state == StreamState::kStreaming) {
    problem = session_.method() == PostureMethod::kFingertips ? session_.retargeting_error()
                                                              : session_.mapping_error();
    add_recent_glove(session_.device());
  }
  show_glove(state, problem);
  if (state != StreamState::kStreaming) {
    guard_.withdraw(ContactGuard::Leader::kHand);
  }
  if (live) {
    ticker_.start();
  } else {
    ticker_.stop();
    status_->clear_statistics();
    to_screen_ = 0.0;
    shown_since_.reset();
  }
}

void GlovePanel::show_problem(const QString& message) {
  show_glove(session_.link().state(), message);
}

void GlovePanel::show_glove(StreamState state, const QString& error) {
  const device::GloveInfo info = session_.link().info();
  status_->show_state(
      state, glove_text(info),
      QString::fromStdString(info.model.empty() ? "" : info.model + ", " + info.device), error);
}

void GlovePanel::show_samples(const std::vector<GloveSample>& samples) {
  bars_->show_samples(samples, session_.mapper());
  mapping_editor_->show_samples(samples);
  first_time_ = first_time_ < 0.0 ? samples.front().frame.time : first_time_;
  last_time_ = samples.back().frame.time;
  if (session_.following()) {
    move_hand(samples.back());
  }
}

void GlovePanel::move_hand(const GloveSample& sample) {
  const device::PostureSource* source = session_.source();
  const Eigen::VectorXd& values = session_.posture_of(sample);
  if (!source || values.size() == 0) {
    return;
  }
  geometric::NamedPosture posture;
  for (std::size_t j = 0; j < source->joints().size(); ++j) {
    posture.values[source->joints()[j]] = values[static_cast<Eigen::Index>(j)];
  }
  if (!shown_since_) {
    shown_since_ = session_.link().arrival();
  }
  guard_.propose(ContactGuard::Leader::kHand, posture);
}

void GlovePanel::note_drawn() {
  if (shown_since_) {
    const std::chrono::duration<double> delay = std::chrono::steady_clock::now() - *shown_since_;
    to_screen_ =
        to_screen_ > 0.0 ? to_screen_ + kSmoothing * (delay.count() - to_screen_) : delay.count();
    shown_since_.reset();
  }
}

void GlovePanel::show_statistics() {
  if (session_.link().state() == StreamState::kStreaming) {
    status_->show_statistics(session_.link().statistics(), to_screen_);
  }
}

void GlovePanel::refresh_icons() { record_->refresh_icon(); }

void add_glove(Workbench& workbench) {
  auto* panel = new GlovePanel(workbench.guard, workbench.editor.undo_stack());
  const auto add_page = [panel](const QString& title, QWidget* page) {
    panel->add_page(title, page);
  };
  workbench.add_dock(
      DockArea::kControl, 3,
      {.name = "glove", .title = QObject::tr("Glove"), .widget = panel, .add_page = add_page});
  workbench.add_stream([panel]() -> std::optional<double> {
    const auto& link = panel->session().link();
    const bool runs = link.is_running() && link.state() != StreamState::kFailed;
    return runs ? std::optional(panel->listening_time()) : std::nullopt;
  });
  QAction* bases = workbench.make_action(
      "", QObject::tr("Hand &basis…"), {},
      QObject::tr("Choose the hand's basis, or make one from postures of a person"));
  bases->setObjectName(QStringLiteral("explore_bases"));
  workbench.add_to_menu(MainMenu::kPlan, {1, 10}, bases);
  QObject::connect(bases, &QAction::triggered, panel,
                   [panel] { panel->come_to_front(QStringLiteral("Explore")); });
  Document& document = workbench.document;
  QObject::connect(&workbench.view, &SceneView::frameSwapped, panel, &GlovePanel::note_drawn);
  QObject::connect(panel, &GlovePanel::posture_changed, &workbench.posing, &Posing::apply);
  QObject::connect(&document, &Document::configuration_changed, panel,
                   &GlovePanel::set_configuration);
  QObject::connect(&workbench, &Workbench::theme_changed, panel, &GlovePanel::refresh_icons);
  const auto scene_basis = [&document]() -> HandBasis {
    const std::filesystem::path file =
        document.scene() ? document.scene()->hand_basis : std::filesystem::path();
    return {QString::fromStdString(file.stem().string()), file, document.loaded().basis};
  };
  // The scene's hand is proposed a mapping and shown with its bases in an event of its own, which
  // takes as long as all other panels together.
  const auto take_hand = [panel, &document, scene_basis] {
    if (const geometric::RobotInstance* robot = document.robot()) {
      panel->set_hand(robot->model, scene_basis(), document.problem());
      panel->set_configuration(document.configuration());
    }
  };
  QObject::connect(&workbench, &Workbench::scene_shown, panel, [panel, take_hand] {
    panel->set_hand(nullptr, {}, nullptr);
    QMetaObject::invokeMethod(panel, take_hand, Qt::QueuedConnection);
  });
  QObject::connect(&document, &Document::hand_changed, panel, [panel, &document, scene_basis] {
    panel->set_basis(document.robot()->model, scene_basis(), document.problem());
  });
  QObject::connect(&panel->capture().explorer(), &PmdExplorer::basis_chosen, &workbench.editor,
                   &SceneEditor::use_basis);
  QObject::connect(&workbench, &Workbench::recordings_dropped, panel,
                   [panel](const QStringList& files) {
                     panel->come_to_front(QStringLiteral("Explore"));
                     panel->capture().show_recordings(files);
                   });
  QObject::connect(&workbench, &Workbench::ready, panel, [panel, &workbench] {
    const Options& options = workbench.options;
    if (!options.glove.empty() || !options.glove_page.empty() || !options.tracker.empty()) {
      panel->come_to_front(QString::fromStdString(options.glove_page));
      panel->connect_to(QString::fromStdString(options.glove));
    }
  });
}

}  // namespace handway::gui
