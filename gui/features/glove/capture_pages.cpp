#include "features/glove/capture_pages.h"

#include "features/glove/capture_coach.h"
#include "features/glove/glove_sources.h"
#include "features/glove/pmd_explorer.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/retargeting/fingertip_errors.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/group_proposal.h"

#include <QFileDialog>
#include <QFileInfo>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kShowMs = 100;
constexpr int kDotsEvery = 5;     // times slower than the bars
constexpr int kReportEvery = 50;  // the same
constexpr std::size_t kMostMeasuredLive = 100;

std::vector<int> free_joints(const sampling::PmdBasis* basis,
                             const std::vector<std::string>& joints) {
  std::vector<int> result;
  if (basis) {
    for (const sampling::FreeJoint& free : basis->free_joints) {
      const auto found =
          std::ranges::find(joints, basis->joints[static_cast<std::size_t>(free.joint)]);
      if (found != joints.end()) {
        result.push_back(static_cast<int>(found - joints.begin()));
      }
    }
  }
  return result.size() < joints.size() ? result : std::vector<int>{};
}

QString error_row(const QString& method, const std::optional<device::FingertipErrors>& errors) {
  const auto cell = [](double metres) {
    return QStringLiteral("<td align=right>&nbsp; %1</td>")
        .arg(metres / geometric::kMillimetre, 0, 'f', 1);
  };
  return QStringLiteral("<tr><td>%1</td>%2</tr>")
      .arg(method, errors ? cell(errors->mean) + cell(errors->median) + cell(errors->most)
                          : QObject::tr("<td colspan=3>none</td>"));
}

}  // namespace

CapturePages::CapturePages(GloveSession& session, QObject* parent)
    : QObject(parent), session_(session), coach_(new CaptureCoach), explorer_(new PmdExplorer) {
  connect(&session_, &GloveSession::sampled, this, &CapturePages::take);
  connect(&session_, &GloveSession::source_changed, this, [this] {
    explorer_->show_method(session_.method());
    restart();
  });
  connect(&session_, &GloveSession::retargeting_prepared, this, [this] {
    compare_methods(recordings_ ? recordings_->measured : std::vector<device::GloveAngles>{});
    update_report();
  });
  connect(coach_, &CaptureCoach::restart_requested, this, [this] {
    files_.clear();
    restart();
  });
  connect(explorer_, &PmdExplorer::live_requested, this, [this] {
    files_.clear();
    show_again();
  });
  connect(explorer_, &PmdExplorer::failed, this, &CapturePages::failed);
  connect(&reading_, &LatestJob::failed, this, [this](const QString& message) {
    files_.clear();
    explorer_->show_errors({});
    emit failed(message);
  });
  connect(explorer_, &PmdExplorer::recording_requested, this, &CapturePages::choose_recordings);
  connect(explorer_, &PmdExplorer::method_chosen, &session_, &GloveSession::set_method);
  connect(explorer_, &PmdExplorer::options_changed, this, &CapturePages::update_report);
  connect(explorer_, &PmdExplorer::shown, &session_, &GloveSession::prepare_retargeting);
  ticker_.setInterval(kShowMs);
  connect(&ticker_, &QTimer::timeout, this, &CapturePages::show_live);
  restart();
}

CapturePages::~CapturePages() = default;

CapturedPostures CapturePages::no_postures() const {
  const device::PostureSource* source = session_.source();
  return source ? CapturedPostures(source->joints(), free_joints(basis_.get(), source->joints()))
                : CapturedPostures();
}

void CapturePages::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                            const HandBasis& basis) {
  basis_ = basis.basis;
  files_.clear();
  explorer_->set_hand(std::move(model), basis);
  restart();
  if (explorer_->isVisible()) {
    session_.prepare_retargeting();
  }
}

void CapturePages::set_basis(const HandBasis& basis) {
  basis_ = basis.basis;
  explorer_->set_scene_basis(basis);
}

void CapturePages::set_configuration(const geometric::Configuration& q) {
  explorer_->set_configuration(q);
}

void CapturePages::restart() {
  live_ = no_postures();
  recent_.clear();
  if (const device::PostureSource* source = session_.source()) {
    coach_->restart(session_.mapping(), source->joints(), source->driven());
  } else {
    coach_->restart(session_.mapping(), {}, {});
  }
  show_again();
}

void CapturePages::show_again() {
  recordings_.reset();
  reading_.cancel();
  comparing_.cancel();
  explorer_->show_errors({});
  explorer_->enable_method(true);
  explorer_->show_postures(live_, {}, session_.mapping().hand);
  update_report();
  if (!files_.isEmpty() && session_.source()) {
    show_recordings(QStringList(files_));
  }
}

void CapturePages::take(const std::vector<GloveSample>& samples) {
  const device::PostureSource* source = session_.source();
  if (!source) {
    return;
  }
  for (const GloveSample& sample : samples) {
    if (session_.posture_of(sample).size() == 0) {
      continue;
    }
    const Eigen::VectorXd posture = normalised(*source, session_.posture_of(sample));
    coach_->add(posture, sample.angles, session_.calibration().ranges);
    live_.add(sample.frame.time, posture);
    recent_.push_back(sample.angles);
    is_new_ = true;
  }
  while (recent_.size() > kMostMeasuredLive) {
    recent_.pop_front();
  }
  if (is_new_ && !ticker_.isActive()) {
    ticker_.start();
  }
}

void CapturePages::show_live() {
  if (!is_new_) {
    ticker_.stop();
    return;
  }
  is_new_ = false;
  if (coach_->isVisible()) {
    coach_->show_progress(live_);
  }
  if (!files_.isEmpty() || !explorer_->isVisible() || ++ticks_ % kDotsEvery != 0) {
    return;
  }
  explorer_->show_postures(live_, {}, session_.mapping().hand);
  if (!comparing_.is_busy()) {
    compare_methods({recent_.begin(), recent_.end()});
  }
  if (ticks_ % kReportEvery == 0 && !explorer_->report().is_busy()) {
    update_report();
  }
}

void CapturePages::choose_recordings() {
  explorer_->show_postures(live_, {}, session_.mapping().hand);
  const QStringList files = QFileDialog::getOpenFileNames(
      explorer_, tr("Show the postures of recordings, of one person or several together"), {},
      recording_filter());
  if (!files.isEmpty()) {
    show_recordings(files);
  }
}

void CapturePages::show_recordings(const QStringList& files) {
  const device::PostureSource* source = session_.source();
  if (!source) {
    emit failed(tr("First open a scene with the hand of the mapping"));
    return;
  }
  std::vector<std::filesystem::path> paths;
  for (const QString& file : files) {
    paths.emplace_back(file.toStdString());
  }
  // Copies the job's input from the session, which may change meanwhile.
  std::shared_ptr<const device::PostureSource> kept = session_.retargeter();
  if (session_.method() == PostureMethod::kJointMapping) {
    kept = std::make_shared<const device::HandMapper>(*session_.mapper());
  }
  files_ = files;
  explorer_->show_errors(tr("Reading the recordings…"));
  reading_.run(
      [this, paths, kept, calibration = session_.calibration(), robot = session_.robot(),
       left_out = no_postures().left_out()](const std::stop_token& stop) -> LatestJob::Answer {
        const auto hand = geometric::hand_alone(robot);
        auto recordings = std::make_shared<PostureRecordings>(
            read_postures(paths, calibration, *kept, left_out, *hand, stop));
        return [this, recordings] { take_recordings(recordings); };
      });
}

void CapturePages::take_recordings(const std::shared_ptr<PostureRecordings>& recordings) {
  recordings_ = recordings;
  QStringList names;
  for (const QString& file : files_) {
    names << QFileInfo(file).fileName();
  }
  explorer_->show_errors(reading_notes());
  explorer_->enable_method(!shows_own_joints());
  explorer_->show_postures(recordings_->postures, names.join(QStringLiteral(" + ")),
                           session_.mapping().hand);
  compare_methods(recordings_->measured);
  update_report();
}

bool CapturePages::shows_own_joints() const { return recordings_ && recordings_->measured.empty(); }

// Returns how the recordings were interpreted, without their folders.
QString CapturePages::reading_notes() const {
  QString text;
  for (const std::string& warning :
       recordings_ ? recordings_->warnings : std::vector<std::string>{}) {
    QString line = QString::fromStdString(warning);
    for (const QString& file : files_) {
      line.replace(file, QFileInfo(file).fileName());
    }
    text += QStringLiteral("<p>%1</p>").arg(line.toHtmlEscaped());
  }
  return text;
}

// Both methods on what was measured, by the same measure.
void CapturePages::compare_methods(std::vector<device::GloveAngles> measured) {
  if (shows_own_joints()) {
    return;
  }
  if (!session_.retargeter()) {
    explorer_->show_errors(reading_notes() + session_.retargeting_error().toHtmlEscaped());
    return;
  }
  if (measured.empty()) {
    return;
  }
  comparing_.run([this, measured = std::move(measured), hand = session_.retargeter(),
                  mapper = session_.mapper() ? std::optional(*session_.mapper()) : std::nullopt](
                     const std::stop_token& stop) -> LatestJob::Answer {
    const auto count = static_cast<Eigen::Index>(measured.size());
    Eigen::MatrixXd retargeted(count, hand->lower().size());
    Eigen::VectorXd last = hand->middle();
    for (Eigen::Index row = 0; row < count && !stop.stop_requested(); ++row) {
      last = hand->posture(hand->landmarks(measured[static_cast<std::size_t>(row)]), last);
      retargeted.row(row) = last.transpose();
    }
    if (stop.stop_requested()) {
      return {};
    }
    std::optional<device::FingertipErrors> of_mapping;
    if (mapper) {
      Eigen::MatrixXd mapped(count, mapper->lower().size());
      for (Eigen::Index row = 0; row < count; ++row) {
        mapped.row(row) = mapper->posture(measured[static_cast<std::size_t>(row)]).transpose();
      }
      of_mapping = device::fingertip_errors(measured, mapper->joints(), mapped, *hand);
    }
    const device::FingertipErrors of_retargeting =
        device::fingertip_errors(measured, hand->joints(), retargeted, *hand);
    const QString text = tr("<table cellspacing=0 cellpadding=1><tr><td>Fingertip error, mm</td>"
                            "<td>&nbsp; mean</td><td>&nbsp; median</td><td>&nbsp; 95 %</td></tr>") +
                         error_row(tr("Joint mapping"), of_mapping) +
                         error_row(tr("Fingertip retargeting"), of_retargeting) +
                         QStringLiteral("</table>");
    return [this, text] { explorer_->show_errors(reading_notes() + text); };
  });
}

void CapturePages::update_report() {
  const device::PostureSource* source = session_.source();
  std::vector<sampling::RecordedHand> each;
  if (recordings_) {
    each = recordings_->each;
  } else if (files_.isEmpty() && live_.duration() > 0.0) {
    const Eigen::MatrixXd samples = live_.table();
    each.push_back({tr("live").toStdString(), samples,
                    static_cast<double>(samples.rows()) / live_.duration()});
  }
  if (!source || !session_.retargeter() || each.empty()) {
    explorer_->report().set_input(
        std::nullopt, !session_.retargeting_error().isEmpty() ? session_.retargeting_error()
                      : each.empty() ? tr("No postures yet: connect a glove, or choose recordings")
                                     : QString());
    return;
  }
  const sampling::PmdBasisOptions options = explorer_->options();
  sampling::BasisStudySettings settings;
  settings.free_joints = options.free_joints;
  settings.directions = options.directions;
  explorer_->report().set_input(
      BasisStudyInput{std::move(each),
                      device::normalised_fingertips(session_.retargeter(), *source), settings},
      {});
}

}  // namespace handway::gui
