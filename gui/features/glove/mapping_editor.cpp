#include "features/glove/mapping_editor.h"

#include "features/glove/glove_sources.h"
#include "features/glove/joint_mapping_form.h"
#include "features/glove/mapping_comparison.h"
#include "features/glove/mapping_wires.h"
#include "handway/device/retargeting/mapping_fit.h"
#include "handway/device/retargeting/mapping_proposal.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "model/document/edit.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/file_dialogs.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QUndoStack>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <optional>
#include <stop_token>
#include <utility>

namespace handway::gui {
namespace {

constexpr std::size_t kMostFrames = 6000;
constexpr std::size_t kLeastFrames = 100;
constexpr int kEvery = 5;  // frames; neighbours tell the same
constexpr double kPercent = 100.0;
constexpr Eigen::Index kShown = 3;

QString shares_text(const Eigen::VectorXd& shares) {
  QStringList sums;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < std::min(kShown, shares.size()); ++k) {
    sum += shares[k] * kPercent;
    sums << QString::number(sum, 'f', 1);
  }
  return sums.join(QStringLiteral(", ")) + QStringLiteral(" %");
}

QString filter() { return QObject::tr("Mappings (*.yaml *.yml);;All files (*)"); }

/// The frames as a recording of the sensors that all of them have.
device::Recording recording_of(const std::deque<device::GloveAngles>& frames) {
  device::Recording recording;
  recording.header.kind = device::RecordingKind::kAngles;
  for (int sensor = 0; sensor < device::kGloveSensors; ++sensor) {
    if (std::ranges::all_of(frames, [&](const device::GloveAngles& frame) {
          return std::isfinite(frame.angles.at(static_cast<std::size_t>(sensor)));
        })) {
      recording.header.sensors.push_back(sensor);
    }
  }
  recording.times.resize(static_cast<Eigen::Index>(frames.size()));
  recording.values.resize(recording.times.size(),
                          static_cast<Eigen::Index>(recording.header.sensors.size()));
  for (Eigen::Index row = 0; row < recording.times.size(); ++row) {
    const device::GloveAngles& frame = frames[static_cast<std::size_t>(row)];
    recording.times[row] = frame.time;
    for (Eigen::Index column = 0; column < recording.values.cols(); ++column) {
      const int sensor = recording.header.sensors[static_cast<std::size_t>(column)];
      recording.values(row, column) = frame.angles.at(static_cast<std::size_t>(sensor));
    }
  }
  return recording;
}

}  // namespace

MappingEditor::MappingEditor(GloveSession& session, QUndoStack& history, QWidget* parent)
    : QWidget(parent),
      session_(session),
      history_(history),
      wires_(new MappingWires),
      form_(new JointMappingForm),
      curve_(new CurveView),
      source_(named("mapping_source", new QLineEdit)),
      comparison_(named("mapping_comparison", note())),
      choices_(named("mapping_choices", new QPushButton(tr("Mapping")))) {
  source_->setPlaceholderText(tr("source of the mapping"));
  connect(source_, &QLineEdit::textChanged, source_, &QWidget::setToolTip);
  comparison_->setWordWrap(true);
  auto* inner = in_column({form_, curve_, in_row({new QLabel(tr("Source")), {source_, 1}}, 8),
                           build_buttons(), comparison_},
                          8);
  inner->setContentsMargins(12, 4, 12, 8);
  lay_out(*this, in_column({wires_, inner, room()}, 6), {0, 8, 0, 0});
  connect(wires_, &MappingWires::selected_changed, this, [this] { refresh(); });
  connect(wires_, &MappingWires::connected, this, [this](int joint, int sensor) {
    device::HandMapping mapping = session_.mapping();
    device::JointMapping& mapped = mapping.joints[static_cast<std::size_t>(joint)];
    mapped.sensor = sensor;
    mapped.fixed.reset();
    mapped.left_to_arm = false;
    change(tr("Wire %1").arg(QString::fromStdString(mapped.joint)), mapping);
  });
  connect(&fitting_, &LatestJob::failed, this, &MappingEditor::failed);
  connect(&fitting_, &LatestJob::ended, this, &MappingEditor::show_fitting);
  connect(form_, &JointMappingForm::edited, this, &MappingEditor::change_joint_mapping);
  connect(curve_, &CurveView::edited, this, &MappingEditor::change_joint_mapping);
  connect(source_, &QLineEdit::editingFinished, this, [this] {
    device::HandMapping mapping = session_.mapping();
    if (source_->isModified()) {
      mapping.source = source_->text().toStdString();
      change(tr("Set the mapping's source"), mapping);
    }
  });
  refresh();
}

QWidget* MappingEditor::build_buttons() {
  auto* menu = new QMenu(choices_);
  menu->setToolTipsVisible(true);
  menu->addAction(tr("New for this hand"), this, &MappingEditor::propose)
      ->setToolTip(tr("Proposes sensors for the joints from their names, order and axes"));
  menu->addAction(tr("Table 1 of the paper"), this,
                  [this] { change(tr("Map as in Table 1"), device::table1_mapping()); });
  menu->addAction(tr("All joints fixed"), this, &MappingEditor::clear);
  menu->addSeparator();
  menu->addAction(tr("Fit to this motion"), this, [this] { fit(recording_of(motion_)); })
      ->setToolTip(tr("Fits the joints' ranges to the motion since connecting: open the hand, make "
                      "a fist, move the thumb"));
  menu->addAction(tr("Fit to a recording…"), this, &MappingEditor::choose_to_fit);
  menu->addSeparator();
  menu->addAction(tr("Open…"), this, &MappingEditor::choose_to_open);
  menu->addAction(tr("Save as…"), this, &MappingEditor::choose_to_save);
  choices_->setMenu(menu);
  auto* compare = new QPushButton(tr("Compare"));
  auto* others = new QMenu(compare);
  others->addAction(tr("With Table 1 of the paper"), this,
                    [this] { compare_with(device::table1_mapping(), tr("Table 1")); });
  others->addAction(tr("With sensor d for the thumb's second joint"), this, [this] {
    try {
      compare_with(
          device::read_mapping(geometric::resource_dir() / "mappings" / "table1_d_sah.yaml"),
          tr("sensor d"));
    } catch (const std::exception& error) {
      emit failed(QString::fromUtf8(error.what()));
    }
  });
  others->addAction(tr("With a file…"), this, &MappingEditor::choose_to_compare);
  compare->setMenu(others);
  compare->setToolTip(tr("Compare both mappings on the motion since connecting"));
  return boxed(in_row({{choices_, 1}, {compare, 1}}, 8));
}

void MappingEditor::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                             std::vector<std::string> free) {
  if (model != model_) {
    fitting_.cancel();
  }
  model_ = std::move(model);
  free_ = std::move(free);
  refresh();
}

void MappingEditor::show_samples(const std::vector<GloveSample>& samples) {
  for (const GloveSample& sample : samples) {
    if (stride_++ % kEvery == 0) {
      motion_.push_back(sample.angles);
    }
  }
  while (motion_.size() > kMostFrames) {
    motion_.pop_front();
  }
  if (session_.mapper() && isVisible()) {
    wires_->show_sample(samples.back(), *session_.mapper());
    const device::JointMapping& mapped =
        session_.mapping().joints[static_cast<std::size_t>(wires_->selected())];
    if (mapped.sensor >= 0) {
      curve_->show_sensor(samples.back().angles.angles.at(static_cast<std::size_t>(mapped.sensor)));
    }
  }
}

void MappingEditor::open(const std::filesystem::path& file) {
  change(tr("Open a mapping"), device::read_mapping(file));
}

void MappingEditor::save(const std::filesystem::path& file) const {
  device::write_mapping(session_.mapping(), file);
}

void MappingEditor::clear() {
  device::HandMapping mapping = session_.mapping();
  mapping.source.clear();
  for (device::JointMapping& mapped : mapping.joints) {
    mapped = device::JointMapping{mapped.joint, -1, 1.0, 0.0, {}, {}};
  }
  change(tr("Fix all joints"), mapping);
}

void MappingEditor::propose() {
  try {
    if (model_) {
      change(tr("Propose a mapping"), device::propose_mapping(*model_));
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

void MappingEditor::fit(const device::Recording& recording) {
  start_fit([recording] { return recording; });
}

void MappingEditor::start_fit(std::function<device::Recording()> recording) {
  if (!model_) {
    return;
  }
  fitting_.run([this, recording = std::move(recording), model = model_,
                mapping = session_.mapping(),
                calibration = session_.calibration()](const std::stop_token&) -> LatestJob::Answer {
    const device::Recording angles = recording();
    const Eigen::Index frames = angles.values.rows();
    if (static_cast<std::size_t>(frames) < kLeastFrames) {
      return [this] {
        comparison_->setText(tr("Open the hand, make a fist and move the thumb first"));
      };
    }
    const device::MappingFit fitted = device::fit_mapping(mapping, *model, angles, calibration);
    return [this, fitted, frames, read_with = angles.warnings] {
      change(tr("Fit the mapping"), fitted.mapping);
      QStringList lines{tr("Fitted to %L1 frames.").arg(frames)};
      for (const auto& warnings : {read_with, fitted.warnings}) {
        for (const std::string& warning : warnings) {
          lines << QString::fromStdString(warning) + QLatin1Char('.');
        }
      }
      comparison_->setText(lines.join(QLatin1Char('\n')));
    };
  });
  show_fitting();
}

void MappingEditor::show_fitting() {
  const bool busy = fitting_.is_busy();
  choices_->setEnabled(!busy);
  choices_->setText(busy ? tr("Fitting…") : tr("Mapping"));
}

void MappingEditor::change(const QString& text, const device::HandMapping& mapping) {
  history_.push(new ValueEdit<device::HandMapping>(
      text, text.toStdString(), false, session_.mapping(), mapping,
      [this](const device::HandMapping& chosen) { use(chosen); }));
}

void MappingEditor::use(const device::HandMapping& mapping) {
  fitting_.cancel();
  session_.set_mapping(mapping);
  comparison_->clear();
  refresh();
  if (!session_.mapping_error().isEmpty()) {
    emit failed(session_.mapping_error());
  }
}

void MappingEditor::change_joint_mapping(const device::JointMapping& mapped) {
  device::HandMapping mapping = session_.mapping();
  mapping.joints[static_cast<std::size_t>(wires_->selected())] = mapped;
  change(tr("Map %1").arg(QString::fromStdString(mapped.joint)), mapping);
}

void MappingEditor::show_joint_mapping(const device::JointMapping& mapped) {
  form_->set_joint_mapping(mapped);
  const auto variable = model_ ? model_->find_variable(mapped.joint) : std::nullopt;
  curve_->setVisible(variable && mapped.sensor >= 0);
  if (variable) {
    const geometric::JointLimits& limits = model_->variable(*variable).limits;
    curve_->set_joint_mapping(mapped, limits.lower, limits.upper);
  }
}

void MappingEditor::refresh() {
  const device::HandMapping& mapping = session_.mapping();
  wires_->set_mapping(mapping);
  source_->setText(QString::fromStdString(mapping.source));
  source_->setCursorPosition(0);
  form_->setEnabled(!mapping.joints.empty());
  if (!mapping.joints.empty()) {
    show_joint_mapping(mapping.joints[static_cast<std::size_t>(wires_->selected())]);
  }
}

void MappingEditor::compare_with(const device::HandMapping& other, const QString& name) {
  if (!model_ || motion_.size() < kLeastFrames) {
    comparison_->setText(tr("Move the glove for some seconds first"));
    return;
  }
  try {
    const MappingComparison result = compare_mappings({motion_.begin(), motion_.end()},
                                                      session_.mapping(), other, *model_, free_);
    QString text = tr("Variance in 1, 2, 3 directions: %1 here, %2 with %3.")
                       .arg(shares_text(result.shares_a), shares_text(result.shares_b), name);
    if (result.angles.size() > 1) {
      text += QLatin1Char(' ') + tr("Their planes of two directions are %1° apart.")
                                     .arg(result.angles[1] / geometric::kDegree, 0, 'f', 1);
    }
    comparison_->setText(text);
  } catch (const std::exception& error) {
    comparison_->setText(QString::fromUtf8(error.what()));
  }
}

QString MappingEditor::comparison() const { return comparison_->text(); }

void MappingEditor::choose_to_open() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Open a mapping"), {}, filter());
  try {
    if (!file.isEmpty()) {
      open(file.toStdString());
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

void MappingEditor::choose_to_save() {
  const QString file =
      ask_where_to_save(this, tr("Save the mapping"), QStringLiteral("mapping.yaml"), filter());
  try {
    if (!file.isEmpty()) {
      save(file.toStdString());
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

void MappingEditor::choose_to_fit() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Fit the mapping to a recording"), {},
                                                    recording_filter());
  if (!file.isEmpty()) {
    start_fit([file = file.toStdString(), calibration = session_.calibration()] {
      return device::to_angles(device::read_recording(file), calibration);
    });
  }
}

void MappingEditor::choose_to_compare() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Compare with a mapping"), {}, filter());
  try {
    if (!file.isEmpty()) {
      compare_with(device::read_mapping(file.toStdString()), QFileInfo(file).fileName());
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

}  // namespace handway::gui
