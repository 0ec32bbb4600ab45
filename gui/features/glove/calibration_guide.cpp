#include "features/glove/calibration_guide.h"

#include "features/glove/bones_form.h"
#include "features/glove/hand_picture.h"
#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/file_dialogs.h"
#include "widgets/style/theme.h"

#include <QDate>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QStringList>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace handway::gui {
namespace {

constexpr double kHold = 1.5;       // s that a posture is held
constexpr double kHeldStill = 3.0;  // counts, standard deviation of a hand that is held still
constexpr double kHeldStillAngle = 3.0 * geometric::kDegree;  // the same of angles
constexpr double kMostOfRange = 0.7;                          // of a typical joint's
constexpr int kPercentDone = 100;
constexpr int kProgressHeight = 6;  // px

/// Counts, or angles if the source measures these itself.
device::Recording recording_of(const std::vector<device::GloveFrame>& frames) {
  device::Recording recording;
  const auto& angles = frames.front().angles;
  recording.header.kind = angles ? device::RecordingKind::kAngles : device::RecordingKind::kCounts;
  for (int sensor = 0; sensor < device::kGloveSensors; ++sensor) {
    const auto place = static_cast<std::size_t>(sensor);
    if (angles ? std::isfinite(angles->at(place)) : frames.front().counts.at(place) > 0) {
      recording.header.sensors.push_back(sensor);
    }
  }
  const auto rows = static_cast<Eigen::Index>(frames.size());
  recording.times.resize(rows);
  recording.values.resize(rows, static_cast<Eigen::Index>(recording.header.sensors.size()));
  for (Eigen::Index row = 0; row < rows; ++row) {
    const device::GloveFrame& frame = frames[static_cast<std::size_t>(row)];
    recording.times[row] = frame.time - frames.front().time;
    for (Eigen::Index column = 0; column < recording.values.cols(); ++column) {
      const int sensor = recording.header.sensors[static_cast<std::size_t>(column)];
      const auto place = static_cast<std::size_t>(sensor);
      recording.values(row, column) =
          frame.angles ? frame.angles->at(place) : frame.counts.at(place);
    }
  }
  return recording;
}

/// The largest standard deviation of a sensor, counts or rad.
double restlessness(const device::Recording& held) {
  const Eigen::MatrixXd off = held.values.rowwise() - held.values.colwise().mean();
  return std::sqrt(off.colwise().squaredNorm().maxCoeff() / static_cast<double>(off.rows()));
}

/// "1.2 counts" or "0.8°".
QString amount(double value, device::RecordingKind kind) {
  return kind == device::RecordingKind::kCounts
             ? QObject::tr("%1 counts").arg(value, 0, 'f', 1)
             : QObject::tr("%1°").arg(value / geometric::kDegree, 0, 'f', 1);
}

/// Returns which joints have been through most of a typical hand's ranges, and which have not.
QString range_quality(const device::PersonRanges& ranges, const device::Recording& motion) {
  int wide = 0;
  QStringList narrow;
  for (const int sensor : motion.header.sensors) {
    const auto place = static_cast<std::size_t>(sensor);
    const auto& typical = device::typical_angle_ranges().at(place);
    const auto& own = ranges.at(place);
    if (own && own->second - own->first >= kMostOfRange * (typical.second - typical.first)) {
      ++wide;
    } else {
      const std::string_view label = device::cyberglove_sensors()[place].label;
      narrow << QString::fromUtf8(label.data(), static_cast<int>(label.size()));
    }
  }
  const QString text = QObject::tr("%1 of %2 joints covered most of a typical range.")
                           .arg(wide)
                           .arg(motion.header.sensors.size());
  return narrow.isEmpty() ? text
                          : text + QLatin1Char('\n') +
                                QObject::tr("Less: %1.")
                                    .arg(narrow.mid(0, 4).join(QStringLiteral(", ")) +
                                         (narrow.size() > 4 ? QStringLiteral(", …") : QString()));
}

}  // namespace

CalibrationGuide::CalibrationGuide(GloveSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      person_(named("calibration_person", new QLineEdit)),
      title_(heading()),
      picture_(new HandPicture),
      bones_(new BonesForm),
      instruction_(named("calibration_instruction", new QLabel)),
      progress_(new QProgressBar),
      quality_(named("calibration_quality", note())),
      back_(named("calibration_back", new QPushButton(tr("Back")))),
      skip_(named("calibration_skip", new QPushButton(tr("Leave out")))),
      capture_(named("calibration_capture", new QPushButton)) {
  person_->setPlaceholderText(tr("name of the person"));
  instruction_->setWordWrap(true);
  quality_->setWordWrap(true);
  progress_->setRange(0, kPercentDone);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(scaled(kProgressHeight));
  progress_->setAccessibleName(tr("How long the posture has been held"));
  auto* form = new QFormLayout;
  form->addRow(tr("Person"), person_);
  lay_out(*this,
          in_column({form, title_, picture_, instruction_, bones_, capture_, progress_,
                     build_buttons(), quality_, room()},
                    8),
          {12, 8, 12, 8});
  connect(&session_, &GloveSession::sampled, this, &CalibrationGuide::take);
}

QWidget* CalibrationGuide::build_buttons() {
  capture_->setProperty("role", "primary");
  skip_->setToolTip(
      tr("Skip this posture; sensors that only it calibrates keep their previous calibration"));
  auto* close = named("calibration_close", new QPushButton(tr("Close")));
  connect(capture_, &QPushButton::clicked, this,
          [this] { step_ == Step::kDone ? choose_to_save() : capture(); });
  connect(back_, &QPushButton::clicked, this, [this] { go_to(pose_ - 1); });
  connect(skip_, &QPushButton::clicked, this, [this] {
    held_[static_cast<std::size_t>(pose_)].counts = {};
    moved_ = is_motion() ? std::vector<device::GloveFrame>{} : std::move(moved_);
    go_to(pose_ + 1);
  });
  connect(close, &QPushButton::clicked, this, &CalibrationGuide::closed);
  return boxed(in_row({{back_, 1}, {skip_, 1}, {close, 1}}, 8));
}

void CalibrationGuide::begin() {
  try {
    poses_ = device::read_guided_poses(geometric::resource_dir() / "poses" / "guided_poses.yaml");
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
    emit closed();
    return;
  }
  held_.assign(poses_.size(), {});
  moved_.clear();
  quality_text_.clear();
  go_to(0);
}

void CalibrationGuide::go_to(int pose) {
  pose_ = std::clamp(pose, 0, static_cast<int>(poses_.size()));
  frames_.clear();
  step_ = pose_ < static_cast<int>(poses_.size()) ? Step::kWaiting : Step::kDone;
  if (step_ == Step::kDone) {
    fit();
  }
  show_step();
}

void CalibrationGuide::capture() {
  frames_.clear();
  quality_text_.clear();
  step_ = step_ == Step::kReading ? Step::kWaiting : Step::kReading;
  show_step();
}

void CalibrationGuide::take(const std::vector<GloveSample>& samples) {
  if (step_ != Step::kReading) {
    return;
  }
  for (const GloveSample& sample : samples) {
    frames_.push_back(sample.frame);
  }
  const double held = frames_.back().time - frames_.front().time;
  const double needed = is_motion() ? poses_[static_cast<std::size_t>(pose_)].motion : kHold;
  progress_->setValue(static_cast<int>(kPercentDone * std::min(1.0, held / needed)));
  if (held < needed) {
    quality_->setText(live_quality());
  } else if (is_motion()) {
    end_motion();
  } else {
    end_pose();
  }
}

bool CalibrationGuide::is_motion() const {
  return pose_ < static_cast<int>(poses_.size()) &&
         poses_[static_cast<std::size_t>(pose_)].motion > 0.0;
}

QString CalibrationGuide::live_quality() const {
  const device::Recording read = recording_of(frames_);
  if (is_motion()) {
    const device::Recording angles = device::to_angles(read, session_.calibration());
    return range_quality(device::measured_ranges(angles), angles);
  }
  return tr("Steady within %1").arg(amount(restlessness(read), read.header.kind));
}

void CalibrationGuide::end_motion() {
  moved_ = frames_;
  quality_text_.clear();
  go_to(pose_ + 1);
}

void CalibrationGuide::end_pose() {
  const device::Recording counts = recording_of(frames_);
  const double moved = restlessness(counts);
  const device::RecordingKind kind = counts.header.kind;
  if (moved > (kind == device::RecordingKind::kCounts ? kHeldStill : kHeldStillAngle)) {
    step_ = Step::kWaiting;
    quality_text_ =
        tr("The hand moved (a sensor by %1): hold it still, once more.").arg(amount(moved, kind));
    show_step();
    return;
  }
  const auto place = static_cast<std::size_t>(pose_);
  held_[place] = {poses_[place].name, poses_[place].angles, counts};
  quality_text_ = tr("%1: steady within %2.")
                      .arg(QString::fromStdString(poses_[place].name)
                               .replace(QLatin1Char('_'), QLatin1Char(' ')))
                      .arg(amount(moved, kind));
  go_to(pose_ + 1);
}

void CalibrationGuide::fit() {
  std::vector<device::GuidedPose> read;
  std::ranges::copy_if(held_, std::back_inserter(read), [](const device::GuidedPose& pose) {
    return pose.counts.values.rows() > 0 &&
           pose.counts.header.kind == device::RecordingKind::kCounts;
  });
  const bool angles = !session_.link().info().angle_sensors.empty();
  fit_ = {};
  fit_.calibration.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
  try {
    if (!angles && !read.empty()) {
      fit_ = device::calibrate_from_poses(read, {}, fit_.calibration.date);
    }
  } catch (const std::exception& error) {
    fit_.warnings = {error.what()};
  }
  int fitted = 0;
  for (std::size_t s = 0; s < fit_.calibration.sensors.size(); ++s) {
    auto& sensor = fit_.calibration.sensors.at(s);
    fitted += sensor ? 1 : 0;
    sensor = sensor ? sensor : session_.calibration().sensors.at(s);
  }
  QStringList lines;
  if (!angles) {
    lines << (read.empty()
                  ? tr("No posture was read: the sensors keep their previous calibration.")
                  : tr("%1 sensors calibrated; the others keep their previous calibration.")
                        .arg(fitted));
  }
  if (!moved_.empty()) {
    const device::Recording motion = device::to_angles(recording_of(moved_), fit_.calibration);
    fit_.calibration.ranges = device::measured_ranges(motion);
    lines << range_quality(fit_.calibration.ranges, motion);
  }
  std::vector<device::HandBones> seen;
  for (const device::GloveFrame& frame : moved_) {
    if (frame.bones) {
      seen.push_back(*frame.bones);
    }
  }
  if (!seen.empty()) {
    bones_->show_bones(device::median_bones(seen));
    lines << tr("Bones were measured in %1 frames.").arg(seen.size());
  }
  for (const std::string& warning : fit_.warnings) {
    lines << QString::fromStdString(warning);
  }
  quality_text_ = lines.join(QLatin1Char('\n'));
}

void CalibrationGuide::show_step() {
  const bool done = step_ == Step::kDone;
  const auto count = static_cast<int>(poses_.size());
  picture_->setVisible(!done);
  bones_->setVisible(done);
  progress_->setVisible(!done);
  progress_->setValue(0);
  skip_->setEnabled(!done);
  back_->setEnabled(pose_ > 0);
  quality_->setText(quality_text_);
  if (done) {
    title_->setText(tr("Bones"));
    instruction_->setText(
        tr("Bones in mm: as measured, or type the length of the hand or of each bone. Save the "
           "calibration under the person's name; the coach then shows the covered ranges."));
    capture_->setText(tr("Save the calibration…"));
    return;
  }
  const device::PoseInstruction& pose = poses_[static_cast<std::size_t>(pose_)];
  title_->setText(tr("Posture %1 of %2").arg(pose_ + 1).arg(count));
  instruction_->setText(QString::fromStdString(pose.instruction));
  capture_->setText(step_ != Step::kReading ? tr("Read the glove")
                    : is_motion()           ? tr("Reading… move the hand")
                                            : tr("Reading… hold still"));
  device::GloveAngles angles;
  angles.angles = pose.angles;
  const device::GloveInfo info = session_.link().info();
  picture_->show_hand(angles, !info.right_hand);
}

void CalibrationGuide::save(const std::filesystem::path& file) {
  fit_.calibration.person = person_->text().trimmed().toStdString();
  fit_.calibration.bones = bones_->bones();
  device::write_calibration(fit_.calibration, file);
  emit saved(QString::fromStdString(file.string()));
}

void CalibrationGuide::choose_to_save() {
  const QString person = person_->text().trimmed();
  const QString name = person.isEmpty()
                           ? tr("calibration")
                           : person.toLower().replace(QLatin1Char(' '), QLatin1Char('_'));
  const QString file =
      ask_where_to_save(this, tr("Save the calibration"), name + QStringLiteral(".yaml"),
                        tr("Calibrations (*.yaml)"));
  try {
    if (!file.isEmpty()) {
      save(file.toStdString());
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

}  // namespace handway::gui
