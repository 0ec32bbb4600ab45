#include "features/glove/pmd_explorer.h"

#include "features/glove/correlation_map.h"
#include "features/glove/pmd_pad.h"
#include "features/glove/variance_chart.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QVariant>

#include <exception>

namespace handway::gui {
namespace {

constexpr int kLive = 0;
constexpr int kFromFile = 1;
constexpr int kSceneBasis = 0;
constexpr std::size_t kMostDots = 1200;
constexpr Eigen::Index kLeastPostures = 50;

QComboBox* choice(const char* name) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(3);
  return box;
}

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("role", "note");
  return label;
}

}  // namespace

PmdExplorer::PmdExplorer(QWidget* parent)
    : QWidget(parent),
      source_(choice("explorer_source")),
      basis_(choice("explorer_basis")),
      across_(choice("explorer_across")),
      up_(choice("explorer_up")),
      pad_(new PmdPad),
      variance_(new VarianceChart),
      correlation_(new CorrelationMap),
      note_(heading({})) {
  source_->addItems({tr("Live"), tr("A recording…")});
  basis_->addItems({tr("Of the scene"), tr("Of these postures")});
  auto* form = new QGridLayout;
  form->setHorizontalSpacing(8);
  form->setVerticalSpacing(6);
  form->addWidget(new QLabel(tr("Postures")), 0, 0);
  form->addWidget(source_, 0, 1, 1, 3);
  form->addWidget(new QLabel(tr("Basis")), 1, 0);
  form->addWidget(basis_, 1, 1, 1, 3);
  form->addWidget(new QLabel(tr("Axes")), 2, 0);
  form->addWidget(across_, 2, 1);
  form->addWidget(new QLabel(QStringLiteral("×")), 2, 2);
  form->addWidget(up_, 2, 3);
  form->setColumnStretch(1, 1);
  form->setColumnStretch(3, 1);
  auto* charts = new QGridLayout;
  charts->setHorizontalSpacing(12);
  charts->setVerticalSpacing(2);
  charts->addWidget(heading(tr("Variance held")), 0, 0);
  charts->addWidget(heading(tr("Joints together")), 0, 1);
  charts->addWidget(variance_, 1, 0);
  charts->addWidget(correlation_, 1, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 10, 12, 6);
  layout->setSpacing(8);
  layout->addLayout(form);
  layout->addWidget(pad_, 1);
  layout->addWidget(note_);
  layout->addLayout(charts);
  connect(source_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    if (index == kLive) {
      emit live_requested();
    } else {
      emit recording_requested();
    }
  });
  connect(basis_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::rebuild_axes);
  connect(across_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(up_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(pad_, &PmdPad::moved, this, &PmdExplorer::move_hand);
  rebuild_axes();
}

bool PmdExplorer::uses_scene_basis() const { return basis_->currentIndex() == kSceneBasis; }

void PmdExplorer::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                           std::shared_ptr<const sampling::PmdBasis> basis) {
  model_ = std::move(model);
  scene_basis_ = std::move(basis);
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  if (!scene_basis_ && model_) {
    basis_->setCurrentIndex(kSceneBasis + 1);
  }
  rebuild_axes();
}

void PmdExplorer::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  if (moving_ || axes_.dimension() < 2 || !isVisible()) {
    return;
  }
  const Eigen::VectorXd e = axes_.coordinates(q_);
  pad_->set_posture({e[across_->currentIndex()], e[up_->currentIndex()]});
}

void PmdExplorer::show_postures(const CapturedPostures& postures, const QString& source) {
  postures_ = postures;
  const QSignalBlocker quiet(source_);
  source_->setItemText(kFromFile, source.isEmpty() ? tr("A recording…") : source);
  source_->setCurrentIndex(source.isEmpty() ? kLive : kFromFile);
  if (uses_scene_basis()) {
    show_dots();
  } else {
    rebuild_axes();
  }
  show_statistics();
}

void PmdExplorer::rebuild_axes() {
  axes_ = {};
  QString reason;
  if (!model_) {
    reason = tr("Open a scene with a robot first");
  } else if (uses_scene_basis()) {
    if (scene_basis_) {
      axes_ = HandAxes(model_, *scene_basis_);
    } else {
      reason =
          tr("The scene names no hand basis. Capture postures, or choose a recording, and "
             "take the basis of these postures");
    }
  } else if (postures_.count() < kLeastPostures) {
    reason = tr("No postures yet: connect a glove, or choose a recording");
  } else {
    sampling::PmdBasisOptions options;
    options.free_joints = postures_.left_out();
    axes_ = HandAxes(model_, sampling::make_pmd_basis("", "captured postures", postures_.joints(),
                                                      postures_.components(), options));
  }
  if (axes_.dimension() < 2) {
    pad_->clear(reason.isEmpty() ? tr("The basis does not fit the hand of the scene") : reason);
  }
  const QSignalBlocker quiet_across(across_), quiet_up(up_);
  const bool same = across_->count() == axes_.dimension();
  const int free = static_cast<int>(axes_.basis().free_joints.size());
  const int across = same ? across_->currentIndex() : free;
  const int up = same ? up_->currentIndex() : free + 1;
  across_->clear();
  up_->clear();
  for (int axis = 0; axis < axes_.dimension(); ++axis) {
    across_->addItem(axes_.name(axis));
    up_->addItem(axes_.name(axis));
  }
  across_->setCurrentIndex(std::min(across, axes_.dimension() - 1));
  up_->setCurrentIndex(std::min(up, axes_.dimension() - 1));
  choose_axes();
}

void PmdExplorer::choose_axes() {
  if (axes_.dimension() < 2) {
    note_->setText({});
    return;
  }
  const auto axis = [this](int index) {
    return PmdPad::Axis{axes_.name(index), axes_.half_side(index)};
  };
  pad_->set_axes(axis(across_->currentIndex()), axis(up_->currentIndex()));
  const Eigen::VectorXd e = axes_.coordinates(q_);
  pad_->set_posture({e[across_->currentIndex()], e[up_->currentIndex()]});
  show_dots();
}

void PmdExplorer::show_dots() {
  if (axes_.dimension() < 2) {
    return;
  }
  std::vector<QPointF> dots;
  const auto& samples = postures_.samples();
  const std::size_t stride = samples.size() / kMostDots + 1;
  for (std::size_t i = 0; i < samples.size(); i += stride) {
    const Eigen::VectorXd e = axes_.coordinates(postures_.joints(), samples[i]);
    if (e.size() == 0) {
      break;
    }
    dots.emplace_back(e[across_->currentIndex()], e[up_->currentIndex()]);
  }
  pad_->set_dots(std::move(dots));
  note_->setText(postures_.count() > 0
                     ? tr("%L1 postures; drag within the planner's box").arg(postures_.count())
                     : tr("Drag within the box, where the planner samples"));
}

void PmdExplorer::show_statistics() {
  if (postures_.count() < kLeastPostures) {
    variance_->set_shares({});
    correlation_->set_correlations({}, {});
    return;
  }
  variance_->set_shares(postures_.components().shares);
  correlation_->set_correlations(postures_.joints(), postures_.correlations());
}

void PmdExplorer::move_hand(const QPointF& coordinates) {
  Eigen::VectorXd e = axes_.coordinates(q_);
  e[across_->currentIndex()] = coordinates.x();
  e[up_->currentIndex()] = coordinates.y();
  moving_ = true;
  emit posture_changed(axes_.posture(e));
  moving_ = false;
}

}  // namespace handway::gui
