#include "features/glove/mapping_editor.h"

#include "features/glove/curve_view.h"
#include "features/glove/mapping_wires.h"
#include "features/glove/wire_form.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/sampling/postures/posture_subspace.h"
#include "handway/sampling/postures/principal_components.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>

#include <algorithm>
#include <exception>

namespace handway::gui {
namespace {

constexpr Eigen::Index kMostCompared = 4;

sampling::PrincipalComponents components_of(const std::vector<device::GloveAngles>& frames,
                                            const device::HandMapper& mapper,
                                            const std::vector<std::string>& left_out) {
  const Eigen::VectorXd range = (mapper.upper() - mapper.lower()).cwiseMax(1e-12);
  Eigen::MatrixXd postures(static_cast<Eigen::Index>(frames.size()), range.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    postures.row(static_cast<Eigen::Index>(i)) =
        (mapper.posture(frames[i]) - mapper.lower()).cwiseQuotient(range).transpose();
  }
  std::vector<int> out;
  for (std::size_t j = 0; j < mapper.joints().size(); ++j) {
    if (std::ranges::count(left_out, mapper.joints()[j]) > 0) {
      out.push_back(static_cast<int>(j));
    }
  }
  return sampling::principal_components(postures, out);
}

}  // namespace

MappingComparison compare_mappings(const std::vector<device::GloveAngles>& frames,
                                   const device::HandMapping& a, const device::HandMapping& b,
                                   const geometric::RobotModel& model,
                                   const std::vector<std::string>& left_out) {
  const device::HandMapper mapper_a(a, model);
  const device::HandMapper mapper_b(b, model);
  const sampling::PrincipalComponents of_a = components_of(frames, mapper_a, left_out);
  const sampling::PrincipalComponents of_b = components_of(frames, mapper_b, left_out);
  MappingComparison result{of_a.shares, of_b.shares, {}};
  if (mapper_a.joints() == mapper_b.joints()) {
    const Eigen::Index count =
        std::min({kMostCompared, of_a.directions.cols(), of_b.directions.cols()});
    result.angles.resize(count);
    for (Eigen::Index k = 1; k <= count; ++k) {
      result.angles[k - 1] =
          sampling::principal_angles(of_a.directions.leftCols(k), of_b.directions.leftCols(k))
              .maxCoeff();
    }
  }
  return result;
}

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

}  // namespace

MappingEditor::MappingEditor(GloveSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      wires_(new MappingWires),
      form_(new WireForm),
      curve_(new CurveView),
      source_(new QLineEdit),
      comparison_(new QLabel) {
  source_->setObjectName(QStringLiteral("mapping_source"));
  source_->setPlaceholderText(tr("where the correspondence comes from"));
  comparison_->setObjectName(QStringLiteral("mapping_comparison"));
  comparison_->setProperty("role", "note");
  comparison_->setWordWrap(true);
  auto* inner = new QVBoxLayout;
  inner->setContentsMargins(12, 4, 12, 8);
  inner->setSpacing(8);
  inner->addWidget(form_);
  inner->addWidget(curve_);
  auto* source_row = new QHBoxLayout;
  source_row->setSpacing(8);
  source_row->addWidget(new QLabel(tr("Source")));
  source_row->addWidget(source_, 1);
  inner->addLayout(source_row);
  inner->addWidget(build_buttons());
  inner->addWidget(comparison_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 8, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(wires_);
  layout->addLayout(inner);
  layout->addStretch();
  connect(wires_, &MappingWires::selected_changed, this, [this] { refresh(); });
  connect(wires_, &MappingWires::connected, this, [this](int joint, int sensor) {
    device::HandMapping mapping = session_.mapping();
    device::JointWire& wire = mapping.wires[static_cast<std::size_t>(joint)];
    wire.sensor = sensor;
    wire.fixed.reset();
    change(mapping);
  });
  connect(form_, &WireForm::edited, this, &MappingEditor::change_wire);
  connect(curve_, &CurveView::edited, this, &MappingEditor::change_wire);
  connect(source_, &QLineEdit::editingFinished, this, [this] {
    device::HandMapping mapping = session_.mapping();
    if (source_->isModified()) {
      mapping.source = source_->text().toStdString();
      change(mapping);
    }
  });
  refresh();
}

QWidget* MappingEditor::build_buttons() {
  auto* box = new QWidget;
  auto* layout = new QHBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  auto* mapping = new QPushButton(tr("Mapping"));
  auto* menu = new QMenu(mapping);
  menu->addAction(tr("Table 1 of the paper"), this, [this] { change(device::table1_mapping()); });
  menu->addAction(tr("All joints fixed"), this, &MappingEditor::clear);
  menu->addSeparator();
  menu->addAction(tr("Open…"), this, &MappingEditor::choose_to_open);
  menu->addAction(tr("Save as…"), this, &MappingEditor::choose_to_save);
  mapping->setMenu(menu);
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
  compare->setToolTip(tr("What both mappings make of the motion since connecting"));
  layout->addWidget(mapping, 1);
  layout->addWidget(compare, 1);
  return box;
}

void MappingEditor::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                             std::vector<std::string> free) {
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
    const device::JointWire& wire =
        session_.mapping().wires[static_cast<std::size_t>(wires_->selected())];
    if (wire.sensor >= 0) {
      curve_->show_sensor(samples.back().angles.angles.at(static_cast<std::size_t>(wire.sensor)));
    }
  }
}

void MappingEditor::open(const std::filesystem::path& file) { change(device::read_mapping(file)); }

void MappingEditor::save(const std::filesystem::path& file) const {
  device::write_mapping(session_.mapping(), file);
}

void MappingEditor::clear() {
  device::HandMapping mapping = session_.mapping();
  mapping.source.clear();
  for (device::JointWire& wire : mapping.wires) {
    wire = device::JointWire{wire.joint, -1, 1.0, 0.0, {}, {}};
  }
  change(mapping);
}

void MappingEditor::change(const device::HandMapping& mapping) {
  session_.set_mapping(mapping);
  comparison_->clear();
  refresh();
  if (!session_.mapping_error().isEmpty()) {
    emit failed(session_.mapping_error());
  }
}

void MappingEditor::change_wire(const device::JointWire& wire) {
  device::HandMapping mapping = session_.mapping();
  mapping.wires[static_cast<std::size_t>(wires_->selected())] = wire;
  change(mapping);
}

void MappingEditor::show_wire(const device::JointWire& wire) {
  form_->set_wire(wire);
  const auto variable = model_ ? model_->find_variable(wire.joint) : std::nullopt;
  curve_->setVisible(variable && wire.sensor >= 0);
  if (variable) {
    const geometric::JointLimits& limits = model_->variable(*variable).limits;
    curve_->set_wire(wire, limits.lower, limits.upper);
  }
}

void MappingEditor::refresh() {
  const device::HandMapping& mapping = session_.mapping();
  wires_->set_mapping(mapping);
  source_->setText(QString::fromStdString(mapping.source));
  source_->setCursorPosition(0);
  form_->setEnabled(!mapping.wires.empty());
  if (!mapping.wires.empty()) {
    show_wire(mapping.wires[static_cast<std::size_t>(wires_->selected())]);
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
    QString text = tr("1, 2, 3 directions hold %1 here, %2 with %3.")
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
  QString file = QFileDialog::getSaveFileName(this, tr("Save the mapping"),
                                              QStringLiteral("mapping.yaml"), filter());
  try {
    if (!file.isEmpty()) {
      save(file.toStdString());
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
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
