#include "features/glove/capture_pages.h"

#include "features/glove/capture_coach.h"
#include "features/glove/pmd_explorer.h"
#include "handway/device/glove/recording.h"
#include "handway/sampling/postures/posture_subspace.h"

#include <QFileDialog>
#include <QFileInfo>

#include <algorithm>
#include <cmath>
#include <exception>

namespace handway::gui {
namespace {

constexpr std::size_t kMostSamples = 4000;
constexpr double kCompareEvery = 1.0;  // s
constexpr double kEnoughShare = 0.75;
constexpr Eigen::Index kMostDirections = 4;
constexpr double kLeastVariance = 1e-12;

// How many directions hold three quarters of the variance.
Eigen::Index main_directions(const sampling::PrincipalComponents& components) {
  double share = 0.0;
  for (Eigen::Index k = 0; k < components.shares.size(); ++k) {
    share += components.shares[k];
    if (share >= kEnoughShare || k + 1 == kMostDirections) {
      return k + 1;
    }
  }
  return 0;
}

}  // namespace

CapturedPostures::CapturedPostures(std::vector<std::string> joints, std::vector<int> left_out)
    : joints_(std::move(joints)), left_out_(std::move(left_out)) {
  if (!joints_.empty()) {
    components_.emplace(static_cast<int>(joints_.size()));
  }
}

void CapturedPostures::add(double time, const Eigen::VectorXd& posture) {
  if (!components_) {
    return;
  }
  if (count_ == 0) {
    first_time_ = time;
  }
  last_time_ = time;
  components_->add(posture);
  if (count_ % stride_ == 0) {
    keep(posture);
  }
  ++count_;
  if (count_ > 1 && (subspaces_.empty() || time >= subspaces_.back().time + kCompareEvery)) {
    compare(time);
  }
}

void CapturedPostures::keep(const Eigen::VectorXd& posture) {
  if (samples_.size() == kMostSamples) {
    for (std::size_t i = 0; 2 * i < samples_.size(); ++i) {
      samples_[i] = samples_[2 * i];
    }
    samples_.resize(kMostSamples / 2);
    stride_ *= 2;
  }
  samples_.push_back(posture);
}

void CapturedPostures::compare(double time) {
  const sampling::PrincipalComponents now = components();
  subspaces_.push_back({time, now.directions});
  while (subspaces_.size() > 1 && subspaces_[1].time <= time - kWindow) {
    subspaces_.pop_front();
  }
  const Eigen::Index count = main_directions(now);
  const Subspace& before = subspaces_.front();
  if (before.time <= time - kWindow && count > 0 && before.directions.cols() >= count) {
    turn_ = sampling::principal_angles(before.directions.leftCols(count),
                                       now.directions.leftCols(count))
                .maxCoeff();
  }
}

Eigen::MatrixXd CapturedPostures::table() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(samples_.size()),
                       static_cast<Eigen::Index>(joints_.size()));
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = samples_[i].transpose();
  }
  return rows;
}

sampling::PrincipalComponents CapturedPostures::components(const std::vector<int>& left_out) const {
  return components_ ? components_->components(left_out)
                     : sampling::principal_components(Eigen::MatrixXd());
}

Eigen::MatrixXd CapturedPostures::correlations() const {
  const sampling::PrincipalComponents all = components_ ? components_->components() : components();
  const Eigen::MatrixXd covariance =
      all.directions * all.variances.asDiagonal() * all.directions.transpose();
  const Eigen::VectorXd variances = covariance.diagonal();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      if (variances[i] > kLeastVariance && variances[j] > kLeastVariance) {
        result(i, j) =
            std::clamp(covariance(i, j) / std::sqrt(variances[i] * variances[j]), -1.0, 1.0);
      }
    }
  }
  return result;
}

bool CapturedPostures::has_settled() const {
  return turn_ && *turn_ < kSettledAngle && duration() >= kLeastTime;
}

namespace {

constexpr int kShowMs = 100;
constexpr int kDotsEvery = 5;  // times slower than the bars

Eigen::VectorXd normalised(const device::HandMapper& mapper, const Eigen::VectorXd& posture) {
  const Eigen::VectorXd range = mapper.upper() - mapper.lower();
  return (range.array() > 0.0)
      .select((posture - mapper.lower()).cwiseQuotient(range), 0.5)
      .cwiseMax(0.0)
      .cwiseMin(1.0);
}

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

}  // namespace

CapturedPostures read_postures(const std::filesystem::path& file,
                               const device::GloveCalibration& calibration,
                               const device::HandMapper& mapper, const std::vector<int>& left_out) {
  const device::Recording angles = device::to_angles(device::read_recording(file), calibration);
  const device::MappedPostures mapped = mapper.map_recording(angles);
  CapturedPostures postures(mapped.joints, left_out);
  for (Eigen::Index row = 0; row < mapped.postures.rows(); ++row) {
    postures.add(angles.times[row], normalised(mapper, mapped.postures.row(row).transpose()));
  }
  return postures;
}

CapturePages::CapturePages(GloveSession& session, QObject* parent)
    : QObject(parent), session_(session), coach_(new CaptureCoach), explorer_(new PmdExplorer) {
  connect(&session_, &GloveSession::sampled, this, &CapturePages::take);
  connect(&session_, &GloveSession::mapping_changed, this, &CapturePages::restart);
  connect(coach_, &CaptureCoach::restart_requested, this, &CapturePages::restart);
  connect(explorer_, &PmdExplorer::live_requested, this, [this] {
    shows_live_ = true;
    explorer_->show_postures(live_, {}, session_.mapping().hand);
  });
  connect(explorer_, &PmdExplorer::failed, this, &CapturePages::failed);
  connect(explorer_, &PmdExplorer::recording_requested, this, &CapturePages::choose_recording);
  ticker_.setInterval(kShowMs);
  connect(&ticker_, &QTimer::timeout, this, &CapturePages::show_live);
  restart();
}

CapturePages::~CapturePages() = default;

CapturedPostures CapturePages::no_postures() const {
  const device::HandMapper* mapper = session_.mapper();
  return mapper ? CapturedPostures(mapper->joints(), free_joints(basis_.get(), mapper->joints()))
                : CapturedPostures();
}

void CapturePages::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                            const HandBasis& basis) {
  basis_ = basis.basis;
  explorer_->set_hand(std::move(model), basis);
  restart();
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
  if (const device::HandMapper* mapper = session_.mapper()) {
    coach_->restart(session_.mapping(), mapper->joints(), mapper->driven());
  } else {
    coach_->restart(session_.mapping(), {}, {});
  }
  shows_live_ = true;
  explorer_->show_postures(live_, {}, session_.mapping().hand);
}

void CapturePages::take(const std::vector<GloveSample>& samples) {
  const device::HandMapper* mapper = session_.mapper();
  if (!mapper) {
    return;
  }
  for (const GloveSample& sample : samples) {
    const Eigen::VectorXd posture = normalised(*mapper, sample.posture);
    coach_->add(posture);
    live_.add(sample.frame.time, posture);
  }
  is_new_ = true;
  if (!ticker_.isActive()) {
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
  if (shows_live_ && explorer_->isVisible() && ++ticks_ % kDotsEvery == 0) {
    explorer_->show_postures(live_, {}, session_.mapping().hand);
  }
}

void CapturePages::choose_recording() {
  explorer_->show_postures(live_, {}, session_.mapping().hand);
  const QString file =
      QFileDialog::getOpenFileName(explorer_, tr("Show the postures of a recording"), {},
                                   tr("Recordings (*.csv *.txt);;All files (*)"));
  if (!file.isEmpty()) {
    show_recording(file);
  }
}

void CapturePages::show_recording(const QString& file) {
  const device::HandMapper* mapper = session_.mapper();
  if (!mapper) {
    emit failed(tr("Open a scene with the hand that the mapping is for first"));
    return;
  }
  const int load = ++load_;
  threads_.run([this, load, file, calibration = session_.calibration(), mapper = *mapper,
                left_out = live_.left_out(), hand = session_.mapping().hand] {
    try {
      auto postures = std::make_shared<CapturedPostures>(
          read_postures(file.toStdString(), calibration, mapper, left_out));
      QMetaObject::invokeMethod(
          this,
          [this, load, file, postures, hand] {
            if (load == load_) {
              shows_live_ = false;
              explorer_->show_postures(*postures, QFileInfo(file).fileName(), hand);
            }
          },
          Qt::QueuedConnection);
    } catch (const std::exception& error) {
      QMetaObject::invokeMethod(
          this, [this, message = QString::fromUtf8(error.what())] { emit failed(message); },
          Qt::QueuedConnection);
    }
  });
}

}  // namespace handway::gui
