#include "features/glove/pmd_explorer.h"

#include "features/glove/basis_charts.h"
#include "features/glove/glove_sources.h"
#include "features/glove/joint_label.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/file_dialogs.h"
#include "widgets/style/menu_text.h"

#include <QComboBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QTabBar>
#include <QVariant>

#include <algorithm>
#include <exception>

namespace handway::gui {
namespace {

constexpr int kLive = 0;
constexpr int kFromFile = 1;
constexpr int kSceneBasis = 0;
constexpr int kOwnBasis = 1;
constexpr int kFirstOther = 2;
constexpr int kOpenBasis = -1;  // data of the entry that asks for a file
constexpr int kDirections = 4;
constexpr std::size_t kMostDots = 1200;
constexpr Eigen::Index kLeastPostures = 50;

QComboBox* choice(const char* name) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(3);
  return box;
}

}  // namespace

BasisOptions::BasisOptions(QWidget* parent)
    : QWidget(parent),
      directions_(named("basis_directions", new QSpinBox)),
      free_(named("basis_free", new QPushButton)) {
  directions_->setToolTip(tr("Number of principal motion directions of the basis"));
  free_->setProperty("role", "compact");
  free_->setMenu(new QMenu(free_));
  free_->setToolTip(
      tr("Free joints: excluded from the directions, with an axis of their own over their whole "
         "range, like the thumb's base in the paper"));
  auto* label = new QLabel(tr("PMDs"));
  label->setBuddy(directions_);
  lay_out(*this, in_row({label, directions_, {free_, 1}}, 8));
  connect(directions_, qOverload<int>(&QSpinBox::valueChanged), this, &BasisOptions::changed);
  take_joints();
}

void BasisOptions::set_joints(const std::vector<std::string>& joints,
                              const std::vector<int>& free) {
  if (joints == joints_) {
    return;
  }
  joints_ = joints;
  free_->menu()->clear();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    QAction* action = free_->menu()->addAction(menu_text(joint_label(joints_[j])));
    action->setCheckable(true);
    action->setChecked(std::ranges::count(free, static_cast<int>(j)) > 0);
    connect(action, &QAction::toggled, this, [this] {
      take_joints();
      emit changed();
    });
  }
  take_joints();
  const QSignalBlocker quiet(directions_);
  directions_->setValue(kDirections);
}

sampling::PmdBasisOptions BasisOptions::options() const {
  sampling::PmdBasisOptions options;
  options.directions = directions_->value();
  const QList<QAction*> actions = free_->menu()->actions();
  for (int j = 0; j < actions.size(); ++j) {
    if (actions[j]->isChecked()) {
      options.free_joints.push_back(j);
    }
  }
  return options;
}

// One joint at least is left for the directions, and the pad has two axes.
void BasisOptions::take_joints() {
  const QList<QAction*> actions = free_->menu()->actions();
  QStringList chosen;
  for (const QAction* action : actions) {
    if (action->isChecked()) {
      chosen << action->text();
    }
  }
  for (QAction* action : actions) {
    action->setEnabled(action->isChecked() || chosen.size() + 1 < actions.size());
  }
  free_->setText(chosen.isEmpty()     ? tr("No free joint")
                 : chosen.size() == 1 ? tr("Free: %1").arg(chosen.front())
                                      : tr("%1 free joints").arg(chosen.size()));
  const QSignalBlocker quiet(directions_);
  const int most = std::max(1, static_cast<int>(actions.size()) - static_cast<int>(chosen.size()));
  directions_->setRange(chosen.isEmpty() ? std::min(2, most) : 1, most);
}

PmdExplorer::PmdExplorer(QWidget* parent)
    : QWidget(parent),
      source_(choice("explorer_source")),
      method_(choice("explorer_method")),
      errors_(named("explorer_errors", note({}))),
      basis_(choice("explorer_basis")),
      options_(new BasisOptions),
      save_(named("basis_save", new QPushButton(tr("Save as basis…")))),
      use_(named("basis_use", new QPushButton(tr("Use for planning")))),
      across_(choice("explorer_across")),
      up_(choice("explorer_up")),
      pad_(new PmdPad),
      variance_(new VarianceChart),
      correlation_(new CorrelationMap),
      comparison_(new BasisComparisonView),
      report_(new BasisReportView),
      views_(named("explorer_views", new QTabBar)),
      note_(note({})) {
  source_->addItems({tr("Live"), tr("A recording…")});
  source_->setToolTip(
      tr("Live postures of the glove, or those of one or several recordings together"));
  source_->setItemData(kLive, tr("All postures of the glove since it was connected"),
                       Qt::ToolTipRole);
  source_->setItemData(
      kFromFile,
      tr("Reads files, maps them to this hand with the method 'Hand by', and shows the postures "
         "and their principal motion directions. Several files are analysed together; in Report "
         "each is a person of its own. Recordings of the robot hand's own joints, as JointState "
         "messages or "
         "tables with the joints' names, are shown as they are. The scene changes with 'Use for "
         "planning' only.") +
          QStringLiteral("\n\n") + recording_kinds(),
      Qt::ToolTipRole);
  method_->addItems({tr("Joint mapping"), tr("Fingertip retargeting")});
  enable_method(true);
  errors_->setWordWrap(true);
  errors_->setTextFormat(Qt::RichText);
  errors_->hide();
  note_->setWordWrap(true);
  auto* form = new QGridLayout;
  form->setHorizontalSpacing(8);
  form->setVerticalSpacing(6);
  form->addWidget(new QLabel(tr("Postures")), 0, 0);
  form->addWidget(source_, 0, 1, 1, 3);
  form->addWidget(new QLabel(tr("Hand by")), 1, 0);
  form->addWidget(method_, 1, 1, 1, 3);
  form->addWidget(errors_, 2, 0, 1, 4);
  form->addWidget(new QLabel(tr("Basis")), 3, 0);
  form->addWidget(basis_, 3, 1, 1, 3);
  form->addWidget(options_, 4, 0, 1, 4);
  form->addWidget(build_buttons(), 5, 0, 1, 4);
  form->setColumnStretch(1, 1);
  form->setColumnStretch(3, 1);
  lay_out(*this, in_column({form, {build_views(), 1}}, 8), {12, 10, 12, 6});
  connect(source_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    if (index == kLive) {
      emit live_requested();
    } else {
      emit recording_requested();
    }
  });
  connect(method_, qOverload<int>(&QComboBox::activated), this,
          [this](int method) { emit method_chosen(static_cast<PostureMethod>(method)); });
  connect(basis_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::take_choice);
  connect(options_, &BasisOptions::changed, this, [this] {
    rebuild_axes();
    emit options_changed();
  });
  connect(across_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(up_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(pad_, &PmdPad::moved, this, &PmdExplorer::move_hand);
  list_bases();
  rebuild_axes();
}

// Builds the views of the postures, and of the quality of their basis.
QWidget* PmdExplorer::build_views() {
  auto* axes = new QGridLayout;
  axes->setHorizontalSpacing(8);
  axes->addWidget(new QLabel(tr("Axes")), 0, 0);
  axes->addWidget(across_, 0, 1);
  axes->addWidget(new QLabel(QStringLiteral("×")), 0, 2);
  axes->addWidget(up_, 0, 3);
  axes->setColumnStretch(1, 1);
  axes->setColumnStretch(3, 1);
  auto* charts = new QGridLayout;
  charts->setHorizontalSpacing(12);
  charts->setVerticalSpacing(2);
  charts->addWidget(note(tr("Variance held")), 0, 0);
  charts->addWidget(note(tr("Joints together")), 0, 1);
  charts->addWidget(variance_, 1, 0);
  charts->addWidget(correlation_, 1, 1);
  auto* directions = boxed(in_column({axes, {pad_, 1}, note_, charts, comparison_}, 8));
  views_->setDrawBase(false);
  views_->setExpanding(true);
  views_->setProperty("role", "pages");
  views_->addTab(tr("Directions"));
  views_->addTab(tr("Report"));
  report_->hide();
  connect(views_, &QTabBar::currentChanged, this, [this, directions](int view) {
    directions->setVisible(view == 0);
    report_->setVisible(view == 1);
  });
  return boxed(in_column({views_, {directions, 1}, {report_, 1}}, 8));
}

void PmdExplorer::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  emit shown();
}

void PmdExplorer::show_method(PostureMethod method) {
  method_->setCurrentIndex(static_cast<int>(method));
}

void PmdExplorer::enable_method(bool enabled) {
  method_->setEnabled(enabled);
  method_->setToolTip(
      enabled ? tr("Method that maps a person's postures to this hand: sensor by sensor with the "
                   "mapping, or by the positions of the fingertips")
              : tr("The recordings are of the robot hand's own joints, which are shown as they "
                   "are"));
}

void PmdExplorer::show_errors(const QString& text) {
  errors_->setText(text);
  errors_->setVisible(!text.isEmpty());
}

QWidget* PmdExplorer::build_buttons() {
  save_->setToolTip(tr("Write the basis that is shown and its postures to files"));
  use_->setToolTip(
      tr("The scene names this basis: the planner samples in it, and human-likeness is measured "
         "against it. Undo restores the previous basis"));
  connect(save_, &QPushButton::clicked, this, [this] { (void)choose_to_save(); });
  connect(use_, &QPushButton::clicked, this, &PmdExplorer::use_shown);
  return boxed(in_row({{save_, 1}, {use_, 1}}, 8));
}

bool PmdExplorer::shows_own_basis() const { return basis_->currentIndex() == kOwnBasis; }

const HandBasis* PmdExplorer::shown_basis() const {
  const int row = basis_->currentIndex();
  const HandBasis* shown = row == kSceneBasis ? &scene_basis_
                           : row == kOwnBasis ? &made_
                           : row < kFirstOther + static_cast<int>(bases_.size())
                               ? &bases_[static_cast<std::size_t>(row - kFirstOther)]
                               : nullptr;
  return shown && shown->basis ? shown : nullptr;
}

void PmdExplorer::list_bases() {
  const QSignalBlocker quiet(basis_);
  const int row = std::max(0, basis_->currentIndex());
  basis_->clear();
  basis_->addItem(scene_basis_.basis ? tr("Scene: %1").arg(scene_basis_.name) : tr("Scene"));
  basis_->addItem(tr("These postures"));
  for (const HandBasis& basis : bases_) {
    basis_->addItem(basis.name);
  }
  basis_->insertSeparator(basis_->count());
  basis_->addItem(tr("Open a basis…"), kOpenBasis);
  basis_->setCurrentIndex(row);
}

void PmdExplorer::take_choice(int row) {
  if (basis_->itemData(row) == QVariant(kOpenBasis)) {
    basis_->setCurrentIndex(kSceneBasis);
    rebuild_axes();
    choose_to_open();
    return;
  }
  rebuild_axes();
}

void PmdExplorer::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                           const HandBasis& basis) {
  model_ = std::move(model);
  scene_basis_ = basis;
  bases_.clear();
  if (model_) {
    try {
      bases_ = shipped_bases(*model_);
    } catch (const std::exception& error) {
      emit failed(QString::fromUtf8(error.what()));
    }
  }
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  basis_->setCurrentIndex(model_ && !basis.basis ? kOwnBasis : kSceneBasis);
  list_bases();
  rebuild_axes();
}

void PmdExplorer::set_scene_basis(const HandBasis& basis) {
  scene_basis_ = basis;
  if (basis.basis) {
    basis_->setCurrentIndex(kSceneBasis);
  }
  list_bases();
  rebuild_axes();
}

void PmdExplorer::add_basis(HandBasis basis) {
  const auto same = std::ranges::find(bases_, basis.file, &HandBasis::file);
  const auto row = kFirstOther + static_cast<int>(same - bases_.begin());
  if (same == bases_.end()) {
    bases_.push_back(std::move(basis));
  } else {
    *same = std::move(basis);
  }
  list_bases();
  basis_->setCurrentIndex(row);
  rebuild_axes();
}

void PmdExplorer::open(const std::filesystem::path& file) {
  if (model_) {
    add_basis(open_basis(file, *model_));
  }
}

void PmdExplorer::save(const std::filesystem::path& file) {
  if (const HandBasis* shown = shown_basis()) {
    add_basis(save_basis(*shown, file));
  }
}

void PmdExplorer::choose_to_open() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open a hand basis"), {}, tr("Hand bases (*.yaml)"));
  try {
    if (!file.isEmpty()) {
      open(file.toStdString());
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

bool PmdExplorer::choose_to_save() {
  const QString name = QString::fromStdString(hand_.empty() ? "hand" : hand_);
  const QString file =
      ask_where_to_save(this, tr("Save the hand basis"), name + QStringLiteral("_basis.yaml"),
                        tr("Hand bases (*.yaml)"));
  try {
    if (!file.isEmpty()) {
      save(file.toStdString());
      return true;
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
  return false;
}

void PmdExplorer::use_shown() {
  const HandBasis* shown = shown_basis();
  if (!shown || (shown->file.empty() && !choose_to_save())) {
    return;
  }
  shown = shown_basis();
  emit basis_chosen(shown->file, shown->basis);
}

void PmdExplorer::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  if (moving_ || axes_.dimension() < 2 || !isVisible()) {
    return;
  }
  const Eigen::VectorXd e = axes_.coordinates(q_);
  pad_->set_posture({e[across_->currentIndex()], e[up_->currentIndex()]});
}

void PmdExplorer::show_postures(const CapturedPostures& postures, const QString& source,
                                const std::string& hand) {
  postures_ = postures;
  postures_source_ = source;
  hand_ = hand;
  options_->set_joints(postures_.joints(), postures_.left_out());
  const QSignalBlocker quiet(source_);
  source_->setItemText(kFromFile, source.isEmpty() ? tr("A recording…") : source);
  source_->setCurrentIndex(source.isEmpty() ? kLive : kFromFile);
  if (shows_own_basis()) {
    rebuild_axes();
  } else {
    show_dots();
    show_comparison();
  }
  show_statistics();
}

HandBasis PmdExplorer::made_basis() const {
  HandBasis made{tr("this basis"), {}, nullptr};
  if (!model_ || postures_.count() < kLeastPostures) {
    return made;
  }
  const sampling::PmdBasisOptions options = options_->options();
  const std::string source =
      tr("%1 postures, %2")
          .arg(postures_.count())
          .arg(postures_source_.isEmpty() ? tr("captured live") : postures_source_)
          .toStdString();
  made.basis = std::make_shared<const sampling::PmdBasis>(sampling::make_pmd_basis(
      hand_, source, postures_.joints(), postures_.components(options.free_joints), options));
  made.postures = {hand_, source, postures_.joints(), postures_.table()};
  return made;
}

void PmdExplorer::rebuild_axes() {
  axes_ = {};
  made_ = shows_own_basis() ? made_basis() : HandBasis{};
  options_->setVisible(shows_own_basis() && postures_.count() >= kLeastPostures);
  const HandBasis* shown = shown_basis();
  QString reason;
  if (!model_) {
    reason = tr("Open a scene with a robot first");
  } else if (shown) {
    axes_ = HandAxes(model_, *shown->basis);
  } else if (shows_own_basis()) {
    reason = tr("No postures yet: connect a glove, or choose a recording");
  } else {
    reason =
        tr("The scene has no hand basis. Capture postures, or choose a recording, and use the "
           "basis of these postures");
  }
  save_->setEnabled(shown != nullptr);
  use_->setEnabled(shown != nullptr && shown != &scene_basis_);
  if (axes_.dimension() < 2) {
    pad_->clear(reason.isEmpty() ? tr("The basis does not fit the hand of the scene") : reason);
  }
  show_comparison();
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

// The other bases are all that could be shown.
void PmdExplorer::show_comparison() {
  const HandBasis* shown = shown_basis();
  std::vector<HandBasis> others;
  const auto add = [&](const HandBasis& basis) {
    if (basis.basis && &basis != shown) {
      others.push_back(basis);
    }
  };
  add(scene_basis_);
  if (!shows_own_basis()) {
    add(made_basis());
  }
  std::ranges::for_each(bases_, add);
  comparison_->set_bases(model_, shown ? std::optional(*shown) : std::nullopt, std::move(others));
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
