#include "features/glove/calibration_guide.h"

#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording_quality.h"
#include "handway/geometric/io/resources.h"
#include "widgets/style/theme.h"

#include <QDate>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPolygonF>
#include <QProgressBar>
#include <QPushButton>
#include <QStringList>
#include <QVBoxLayout>
#include <QVariant>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

namespace handway::gui {
namespace {

constexpr int kPictureHeight = 116;      // px
constexpr double kBone = 7.0;            // px, of a finger's width
constexpr double kPictureMargin = 12.0;  // px

/// Where a person's palm frame is seen from: fingers up, a little from the thumb's side and from
/// above, so that bent fingers show.
Eigen::Matrix3d view_of_hand() {
  const Eigen::AngleAxisd up(M_PI / 2.0, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd aside(0.5, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd tilted(-0.35, Eigen::Vector3d::UnitX());
  return (tilted * aside * up).toRotationMatrix();
}

/// Landmarks that a bone joins; those of the palm last.
using Bone = std::pair<int, int>;
constexpr std::array<Bone, 20> kBones{{{0, 1},   {1, 2},   {2, 3},   {3, 4},   {0, 5},
                                       {5, 6},   {6, 7},   {7, 8},   {0, 9},   {9, 10},
                                       {10, 11}, {11, 12}, {0, 13},  {13, 14}, {14, 15},
                                       {15, 16}, {0, 17},  {17, 18}, {18, 19}, {19, 20}}};
constexpr std::array<int, 5> kPalm{1, 5, 9, 13, 17};
constexpr double kWrist = 0.32;  // breadth of the wrist on each side, of that of the knuckles

}  // namespace

HandPicture::HandPicture(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("calibration_picture"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize HandPicture::sizeHint() const { return {scaled(160), scaled(kPictureHeight)}; }

void HandPicture::show_hand(const device::GloveAngles& angles, bool left) {
  angles_ = angles;
  left_ = left;
  update();
}

void HandPicture::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  const device::HandLandmarks seen =
      view_of_hand() * device::hand_landmarks(angles_, device::typical_bones(1.0));
  const double scale = (height() - 2.0 * kPictureMargin) / 1.05;
  const auto place = [&](int landmark) {
    const double side = (left_ ? -1.0 : 1.0) * (seen(0, landmark) - seen(0, 9) * 0.5);
    return QPointF(width() / 2.0 + scale * side,
                   height() - kPictureMargin - scale * seen(1, landmark));
  };
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPolygonF palm;
  for (const int landmark : kPalm) {
    palm << place(landmark);
  }
  const auto pen = [&](const QColor& color, double width) {
    return QPen(color, scaled(1) * width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  };
  const QPointF breadth = kWrist * (place(kPalm.back()) - place(kPalm[1]));
  palm << place(0) + breadth << place(0) - breadth;
  painter.setPen(pen(faded(colors.accent, 0.35), kBone));
  painter.setBrush(faded(colors.accent, 0.35));
  painter.drawPolygon(palm);
  std::array<Bone, kBones.size()> bones = kBones;
  std::ranges::sort(bones, {},
                    [&](const Bone& bone) { return seen(2, bone.first) + seen(2, bone.second); });
  for (const auto& [from, to] : bones) {
    if (from == 0) {
      continue;
    }
    painter.setPen(pen(colors.surface, kBone + 3.0));
    painter.drawLine(place(from), place(to));
    painter.setPen(pen(colors.accent, kBone));
    painter.drawLine(place(from), place(to));
  }
}

namespace {

constexpr double kHold = 1.5;       // s that a posture is held
constexpr double kHeldStill = 3.0;  // counts, standard deviation of a hand that is held still
constexpr int kPercentDone = 100;
constexpr int kProgressHeight = 6;  // px

device::Recording recording_of_counts(const std::vector<device::GloveFrame>& frames) {
  device::Recording recording;
  recording.header.kind = device::RecordingKind::kCounts;
  for (int sensor = 0; sensor < device::kGloveSensors; ++sensor) {
    if (frames.front().counts.at(static_cast<std::size_t>(sensor)) > 0) {
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
      recording.values(row, column) = frame.counts.at(static_cast<std::size_t>(sensor));
    }
  }
  return recording;
}

/// The largest standard deviation of a sensor, counts.
double restlessness(const device::Recording& counts) {
  const Eigen::MatrixXd off = counts.values.rowwise() - counts.values.colwise().mean();
  return std::sqrt(off.colwise().squaredNorm().maxCoeff() / static_cast<double>(off.rows()));
}

}  // namespace

CalibrationGuide::CalibrationGuide(GloveSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      person_(new QLineEdit),
      title_(new QLabel),
      picture_(new HandPicture),
      instruction_(new QLabel),
      progress_(new QProgressBar),
      quality_(new QLabel),
      back_(new QPushButton(tr("Back"))),
      skip_(new QPushButton(tr("Leave out"))),
      capture_(new QPushButton) {
  person_->setObjectName(QStringLiteral("calibration_person"));
  person_->setPlaceholderText(tr("whose hand it is"));
  title_->setProperty("role", "heading");
  instruction_->setObjectName(QStringLiteral("calibration_instruction"));
  instruction_->setWordWrap(true);
  quality_->setObjectName(QStringLiteral("calibration_quality"));
  quality_->setProperty("role", "note");
  quality_->setWordWrap(true);
  progress_->setRange(0, kPercentDone);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(scaled(kProgressHeight));
  progress_->setAccessibleName(tr("How long the posture has been held"));
  auto* form = new QFormLayout;
  form->addRow(tr("Person"), person_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 8, 12, 8);
  layout->setSpacing(8);
  layout->addLayout(form);
  layout->addWidget(title_);
  layout->addWidget(picture_);
  layout->addWidget(instruction_);
  layout->addWidget(capture_);
  layout->addWidget(progress_);
  layout->addWidget(build_buttons());
  layout->addWidget(quality_);
  layout->addStretch();
  connect(&session_, &GloveSession::sampled, this, &CalibrationGuide::take);
}

QWidget* CalibrationGuide::build_buttons() {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  capture_->setObjectName(QStringLiteral("calibration_capture"));
  capture_->setProperty("role", "primary");
  back_->setObjectName(QStringLiteral("calibration_back"));
  skip_->setObjectName(QStringLiteral("calibration_skip"));
  skip_->setToolTip(tr("Sensors that only this posture measures keep the calibration before"));
  auto* close = new QPushButton(tr("Close"));
  close->setObjectName(QStringLiteral("calibration_close"));
  for (QPushButton* button : {back_, skip_, close}) {
    row->addWidget(button, 1);
  }
  connect(capture_, &QPushButton::clicked, this,
          [this] { step_ == Step::kDone ? choose_to_save() : capture(); });
  connect(back_, &QPushButton::clicked, this, [this] { go_to(pose_ - 1); });
  connect(skip_, &QPushButton::clicked, this, [this] {
    held_[static_cast<std::size_t>(pose_)].counts = {};
    go_to(pose_ + 1);
  });
  connect(close, &QPushButton::clicked, this, &CalibrationGuide::closed);
  return box;
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
  if (samples.back().frame.angles) {
    step_ = Step::kWaiting;
    quality_text_ = tr("This source measures angles itself: it needs no calibration.");
    show_step();
    return;
  }
  for (const GloveSample& sample : samples) {
    frames_.push_back(sample.frame);
  }
  const double held = frames_.back().time - frames_.front().time;
  progress_->setValue(static_cast<int>(kPercentDone * std::min(1.0, held / kHold)));
  if (held >= kHold) {
    end_pose();
  }
}

void CalibrationGuide::end_pose() {
  const device::Recording counts = recording_of_counts(frames_);
  const double moved = restlessness(counts);
  if (moved > kHeldStill) {
    step_ = Step::kWaiting;
    quality_text_ = tr("The hand moved (a sensor by %1 counts): hold it still, once more.")
                        .arg(moved, 0, 'f', 1);
    show_step();
    return;
  }
  const auto place = static_cast<std::size_t>(pose_);
  held_[place] = {poses_[place].name, poses_[place].angles, counts};
  quality_text_ = tr("%1: steady within %2 counts.")
                      .arg(QString::fromStdString(poses_[place].name)
                               .replace(QLatin1Char('_'), QLatin1Char(' ')))
                      .arg(moved, 0, 'f', 1);
  go_to(pose_ + 1);
}

void CalibrationGuide::fit() {
  std::vector<device::GuidedPose> read;
  std::ranges::copy_if(held_, std::back_inserter(read), [](const device::GuidedPose& pose) {
    return pose.counts.values.rows() > 0;
  });
  try {
    fit_ = device::calibrate_from_poses(read, person_->text().trimmed().toStdString(),
                                        QDate::currentDate().toString(Qt::ISODate).toStdString());
  } catch (const std::exception& error) {
    fit_ = {};
    fit_.warnings = {error.what()};
  }
  int fitted = 0;
  for (std::size_t s = 0; s < fit_.calibration.sensors.size(); ++s) {
    auto& sensor = fit_.calibration.sensors.at(s);
    fitted += sensor ? 1 : 0;
    sensor = sensor ? sensor : session_.calibration().sensors.at(s);
  }
  QStringList lines{tr("%1 sensors calibrated; the others keep what they had.").arg(fitted)};
  for (const std::string& warning : fit_.warnings) {
    lines << QString::fromStdString(warning);
  }
  quality_text_ = lines.join(QLatin1Char('\n'));
}

void CalibrationGuide::show_step() {
  const bool done = step_ == Step::kDone;
  const auto count = static_cast<int>(poses_.size());
  picture_->setVisible(!done);
  progress_->setVisible(!done);
  progress_->setValue(0);
  skip_->setEnabled(!done);
  back_->setEnabled(pose_ > 0);
  quality_->setText(quality_text_);
  if (done) {
    title_->setText(tr("All postures read"));
    instruction_->setText(
        tr("Save the calibration under the person's name. Then the coach leads through the "
           "motions that a basis needs."));
    capture_->setText(tr("Save the calibration…"));
    return;
  }
  const device::PoseInstruction& pose = poses_[static_cast<std::size_t>(pose_)];
  title_->setText(tr("Posture %1 of %2").arg(pose_ + 1).arg(count));
  instruction_->setText(QString::fromStdString(pose.instruction));
  capture_->setText(step_ == Step::kReading ? tr("Reading… hold still") : tr("Read the glove"));
  device::GloveAngles angles;
  angles.angles = pose.angles;
  const device::GloveInfo info = session_.link().info();
  picture_->show_hand(angles, !info.right_hand);
}

void CalibrationGuide::save(const std::filesystem::path& file) {
  fit_.calibration.person = person_->text().trimmed().toStdString();
  device::write_calibration(fit_.calibration, file);
  emit saved(QString::fromStdString(file.string()));
}

void CalibrationGuide::choose_to_save() {
  const QString person = person_->text().trimmed();
  const QString name = person.isEmpty()
                           ? tr("calibration")
                           : person.toLower().replace(QLatin1Char(' '), QLatin1Char('_'));
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save the calibration"), name + QStringLiteral(".yaml"),
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
