#include "features/microscope/microscope_panel.h"

#include "features/workbench.h"
#include "model/document/document.h"
#include "model/planning/path_history.h"
#include "model/planning/plan_settings.h"
#include "view3d/microscope_drawing.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QFontDatabase>
#include <QLabel>
#include <QObject>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QTextBlock>
#include <QToolButton>

#include <algorithm>
#include <array>

namespace handway::gui {
namespace {

constexpr auto kSampleArm = std::to_array<std::string_view>({
    "i ← 0",
    "while i < most samples",
    "  cₐ ← point at step of the arm segment + random offset in ±ρₐ",
    "  if the arm at cₐ is free of itself",
    "    return cₐ",
    "  end",
    "  i ← i + 1",
    "end",
    "return nothing",
});

constexpr auto kSampleHand = std::to_array<std::string_view>({
    "i ← 0",
    "while i < most samples",
    "  u ← random point of the unit cube, one axis for each of SCʰ",
    "  cₕ ← posture of the hand at u (Eq. 1)",
    "  c ← (cₐ, cₕ)",
    "  if c is free of itself",
    "    if c is free of the objects",
    "      return c",
    "    end",
    "  end",
    "  i ← i + 1",
    "end",
    "return nothing",
});

constexpr auto kConnectSample = std::to_array<std::string_view>({
    "add s to the roadmap G",
    "neighbours ← the K nodes of G nearest to s",
    "for each neighbour g",
    "  if g and s are not joined yet",
    "    if the straight motion from g to s is free",
    "      add the edge (g, s) to G",
    "      update the components of G",
    "    end",
    "  end",
    "end",
    "return G",
});

constexpr auto kRoadmap = std::to_array<std::string_view>({
    "G ← empty",
    "add the start to G",
    "add the goal to G",
    "samples ← 2",
    "k ← 1",
    "repeat",
    "  ρₐ ← k · ρₐ",
    "  k ← k + 1",
    "  n ← number of hypercubes along the arm segment",
    "  range ← [0, 1]",
    "  for i from 1 to n",
    "    step ← i-th point of the Van der Corput sequence of n",
    "    if step is in the range",
    "      for j from 1 to nA",
    "        if cₐ ← SampleArm(step, ρₐ)",
    "          axes of SCʰ ← thumb base and one PMD",
    "          for h from 1 to nH",
    "            if c ← SampleHand(cₐ, axes)",
    "              ConnectSample(c, G)",
    "              if start and goal are joined",
    "                return the path between them",
    "              end",
    "              range ← what lies between the two components",
    "              leave the loop of j",
    "            else",
    "              one PMD more",
    "            end",
    "            samples ← samples + 1",
    "          end",
    "        end",
    "      end",
    "    end",
    "  end",
    "until samples > N",
    "return failure",
});

constexpr std::array<AlgorithmListing, 4> kListings{{
    {1, "SampleArm(step, ρₐ)", kSampleArm},
    {2, "SampleHand(cₐ, axes)", kSampleHand},
    {3, "ConnectSample(s, G)", kConnectSample},
    {4, "Roadmap(start, goal)", kRoadmap},
}};

}  // namespace

const AlgorithmListing& algorithm_listing(int algorithm) {
  return kListings[static_cast<std::size_t>(algorithm - 1)];
}

namespace {

constexpr double kMark = 0.28;  // opacity
constexpr double kCallMark = 0.12;
constexpr int kLinesAround = 3;  // lines seen above and below the marked one

// Indented by half as much as the listings are, so that more of the lines is seen.
QString listing_text(const AlgorithmListing& listing) {
  QString text;
  int number = 0;
  for (const std::string_view line : listing.lines) {
    const std::string_view seen = line.substr(line.find_first_not_of(' ') / 2);
    text += QStringLiteral("%1%2  %3")
                .arg(number == 0 ? QString() : QStringLiteral("\n"))
                .arg(number + 1, 2)
                .arg(QString::fromUtf8(seen.data(), static_cast<int>(seen.size())));
    ++number;
  }
  return text;
}

}  // namespace

ListingView::ListingView(QWidget* parent)
    : QWidget(parent), title_(heading()), text_(new QPlainTextEdit) {
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // panels keep their widths
  text_->setReadOnly(true);
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
  font.setPixelSize(scaled(12));
  text_->setFont(font);
  lay_out(*this, in_column({title_, {text_, 1}}, 2));
  follow_theme(*this, [this] { mark(); });
}

void ListingView::show_line(int algorithm, int line, bool calls) {
  if (algorithm != algorithm_) {
    const AlgorithmListing& listing = algorithm_listing(algorithm);
    text_->setPlainText(listing_text(listing));
  }
  algorithm_ = algorithm;
  show_title();
  line_ = line;
  calls_ = calls;
  mark();
}

// Shows as much of the title as fits.
void ListingView::show_title() {
  if (algorithm_ > 0) {
    const QString title = tr("Algorithm %1: %2")
                              .arg(algorithm_)
                              .arg(QString::fromUtf8(algorithm_listing(algorithm_).title));
    title_->setText(title_->fontMetrics().elidedText(title, Qt::ElideRight, title_->width()));
    title_->setToolTip(title);
  }
}

void ListingView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  show_title();
}

void ListingView::clear() {
  algorithm_ = 0;
  line_ = 0;
  title_->clear();
  text_->clear();
}

void ListingView::mark() {
  if (algorithm_ == 0) {
    return;
  }
  QTextEdit::ExtraSelection marked;
  marked.cursor = QTextCursor(text_->document()->findBlockByNumber(line_ - 1));
  QColor color = colors_of(current_theme()).accent;
  color.setAlphaF(calls_ ? kCallMark : kMark);
  marked.format.setBackground(color);
  marked.format.setProperty(QTextFormat::FullWidthSelection, true);
  text_->setExtraSelections({marked});
  const int last = text_->document()->blockCount() - 1;
  for (const int line :
       {qMin(line_ - 1 + kLinesAround, last), qMax(line_ - 1 - kLinesAround, 0), line_ - 1}) {
    text_->setTextCursor(QTextCursor(text_->document()->findBlockByNumber(line)));
    text_->ensureCursorVisible();
  }
}

namespace {

namespace lines = planning::algorithm_lines;
using planning::AlgorithmStep;

QString node_name(int node) {
  return node == 0   ? QObject::tr("the start")
         : node == 1 ? QObject::tr("the goal")
                     : QObject::tr("node %1").arg(node);
}

QString percent(double position) {
  return QObject::tr("%1 % of the arm segment").arg(100.0 * position, 0, 'f', 0);
}

QString edge_text(const AlgorithmStep& step, const QString& text) {
  QString whole = text.arg(node_name(step.from), node_name(step.to));
  whole.replace(0, 1, whole.front().toUpper());
  return whole;
}

QString arm_text(const AlgorithmStep& step, bool has_sample) {
  if (!has_sample) {
    return QObject::tr("No configuration of the arm reaches the sampled pose of the tool.");
  }
  return step.yes ? QObject::tr("Arm sample at %1: no self-collision.").arg(percent(step.position))
                  : QObject::tr("Arm sample at %1: self-collision, sampled again.")
                        .arg(percent(step.position));
}

QString hand_text(const RecordedRun& run, const AlgorithmStep& step) {
  const QString axes = step.count == 1 ? QObject::tr("The hand sampled on one axis")
                                       : QObject::tr("The hand sampled on %1 axes").arg(step.count);
  if (step.yes) {
    return QObject::tr("%1 is free: a sample.").arg(axes);
  }
  const auto& [a, b] = run.pairs[static_cast<std::size_t>(step.pair)];
  if (b.empty()) {
    return QObject::tr("%1 is refused: it violates constraint %2.")
        .arg(axes, QString::fromStdString(a));
  }
  return QObject::tr("%1 is refused: %2 touches %3.")
      .arg(axes, QString::fromStdString(a), QString::fromStdString(b));
}

}  // namespace

QString step_text(const RecordedRun& run, std::size_t index) {
  const RecordedStep& recorded = run.steps[index];
  const AlgorithmStep& step = recorded.step;
  if (step.line == lines::kArmFree) {
    return arm_text(step, recorded.sample >= 0);
  }
  if (step.line == lines::kNoArm) {
    return QObject::tr("All samples for the arm are used. Next attempt.");
  }
  if (step.line == lines::kHandFreeOfSelf || step.line == lines::kHandFree) {
    return hand_text(run, step);
  }
  if (step.line == lines::kAddNode) {
    return step.from <= 1 ? QObject::tr("The roadmap begins with %1.").arg(node_name(step.from))
                          : QObject::tr("The sample becomes %1.").arg(node_name(step.from));
  }
  if (step.line == lines::kNeighbours) {
    return (step.count == 1 ? QObject::tr("%1 has one neighbour near enough.")
                            : QObject::tr("%1 has %2 neighbours near enough.")
                                  .arg(QStringLiteral("%1"))
                                  .arg(step.count))
        .arg(node_name(step.from).replace(0, 1, QLatin1Char('N')));
  }
  if (step.line == lines::kSameComponent) {
    return edge_text(step, QObject::tr("%1 and %2 are joined already: no edge is needed."));
  }
  if (step.line == lines::kLocalPlan) {
    return edge_text(step, step.yes ? QObject::tr("%1 to %2: the straight motion is free.")
                                    : QObject::tr("%1 to %2: the straight motion collides."));
  }
  if (step.line == lines::kAddEdge) {
    return edge_text(step, QObject::tr("%1 and %2 get an edge."));
  }
  if (step.line == lines::kWiden) {
    return QObject::tr("Another pass along the arm segment, with hypercubes of ±%1.")
        .arg(step.rho_a, 0, 'g', 3);
  }
  if (step.line == lines::kHypercube) {
    return QObject::tr("The hypercube at %1 is next.").arg(percent(step.position));
  }
  if (step.line == lines::kJoined) {
    return step.yes ? QObject::tr("Start and goal are joined: there is a path.")
                    : QObject::tr("Start and goal are not joined yet.");
  }
  if (step.line == lines::kSearchRange) {
    return QObject::tr("From now on only from %1 % to %2 % of the arm segment is searched.")
        .arg(100.0 * step.position, 0, 'f', 0)
        .arg(100.0 * step.range_end, 0, 'f', 0);
  }
  return QObject::tr("The search ends without a path.");
}

namespace {

constexpr int kMain = 4;           // the algorithm that calls the others
constexpr double kLongest = 30.0;  // s, of planning
constexpr int kControlsWidth = 280;
constexpr const char* kPlanner = "pmd-prm";
constexpr const char* kFullPlanner = "full-prm";

// The line of the main algorithm from which another one is called.
int calling_line(int algorithm) {
  constexpr int kCalls[] = {15, 18, 19};
  return kCalls[algorithm - 1];
}

}  // namespace

MicroscopePanel::MicroscopePanel(Document& document, PlanSettings& planning, SceneView& view,
                                 QWidget* parent)
    : QWidget(parent),
      document_(document),
      planning_(planning),
      view_(view),
      record_(named("microscope_record", new QPushButton(tr("Record a run")))),
      rewind_(make_button("microscope_rewind", "step_back", tr("To the beginning"))),
      back_(make_button("microscope_back", "frame_back", tr("One step back"))),
      run_(make_button("microscope_run", "play", tr("Step by itself, or pause"))),
      forward_(make_button("microscope_forward", "frame_forward", tr("One step on"))),
      position_(named("microscope_position", new QSlider(Qt::Horizontal))),
      filter_(named("microscope_filter", new QComboBox)),
      pace_(new QComboBox),
      count_(note()),
      words_(named("microscope_words", new QLabel)),
      state_(note()),
      caller_(new ListingView),
      called_(new ListingView) {
  setAttribute(Qt::WA_StyledBackground);
  lay_out(*this, in_row({make_controls(), {caller_, 1}, {called_, 1}}, 14), {10, 6, 10, 6});
  follow_theme(*this, [this] { refresh_icons(); });
  connect(record_, &QPushButton::clicked, this, [this] {
    if (microscope_.is_recording()) {
      microscope_.forget();
      show_state();
    } else {
      record();
    }
  });
  connect(rewind_, &QToolButton::clicked, this, [this] {
    set_running(false);
    microscope_.go_to(0);
  });
  connect(back_, &QToolButton::clicked, this, [this] {
    set_running(false);
    step(-1);
  });
  connect(forward_, &QToolButton::clicked, this, [this] {
    set_running(false);
    step(1);
  });
  connect(run_, &QToolButton::clicked, this, [this] { set_running(!clock_.isActive()); });
  connect(position_, &QSlider::valueChanged, this, [this](int position) {
    set_running(false);
    microscope_.go_to(static_cast<std::size_t>(position));
  });
  connect(pace_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this] { clock_.setInterval(1000 / pace_->currentData().toInt()); });
  connect(&clock_, &QTimer::timeout, this, [this] { step(1); });
  connect(&microscope_, &Microscope::recorded, this, &MicroscopePanel::take_run);
  connect(&microscope_, &Microscope::moved, this, &MicroscopePanel::show_step);
  connect(&microscope_, &Microscope::failed, this, [this](const QString& message) {
    show_state();
    state_->setText(tr("Nothing to show: %1").arg(message));
  });
  connect(&document_, &Document::opened, &microscope_, &Microscope::forget);
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene() && microscope_.run()) {
      microscope_.forget();
    }
  });
  clock_.setInterval(1000 / pace_->currentData().toInt());
  show_step();
}

QWidget* MicroscopePanel::make_controls() {
  record_->setToolTip(
      tr("Plans with pmd-prm (or full-prm, if it is chosen), its settings and the seed of the "
         "planning panel, and keeps every step"));
  filter_->addItem(tr("All steps"), static_cast<int>(StepFilter::kAll));
  filter_->addItem(tr("Samples"), static_cast<int>(StepFilter::kSamples));
  filter_->addItem(tr("Nodes and edges"), static_cast<int>(StepFilter::kEdges));
  filter_->setToolTip(tr("Steps at which the buttons stop"));
  for (const int pace : {1, 3, 10, 25}) {
    pace_->addItem(tr("%1 per second").arg(pace), pace);
  }
  pace_->setCurrentIndex(1);
  for (QLabel* label : {words_, state_}) {
    label->setWordWrap(true);
    label->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  }
  auto* controls = new QWidget;
  controls->setMaximumWidth(scaled(kControlsWidth));
  lay_out(*controls, in_column({in_row({record_, room(), rewind_, back_, run_, forward_}, 2),
                                in_row({{position_, 1}, count_}), in_row({{filter_, 1}, pace_}),
                                words_, state_, room()},
                               6));
  return controls;
}

QToolButton* MicroscopePanel::make_button(const QString& name, const QString& icon_name,
                                          const QString& tip) {
  auto* button = new QToolButton;
  button->setObjectName(name);
  button->setProperty("icon_name", icon_name);
  button->setIcon(icon(icon_name));
  button->setIconSize({20, 20});
  button->setAutoRaise(true);
  button->setToolTip(tip);
  return button;
}

void MicroscopePanel::refresh_icons() {
  run_->setProperty("icon_name", clock_.isActive() ? "pause" : "play");
  for (QToolButton* button : {rewind_, back_, run_, forward_}) {
    button->setIcon(icon(button->property("icon_name").toString()));
  }
}

StepFilter MicroscopePanel::filter() const {
  return static_cast<StepFilter>(filter_->currentData().toInt());
}

std::shared_ptr<planning::Planner> MicroscopePanel::make_planner() const {
  const geometric::PlannerRequest choice = planning_.choice();
  const bool tells_steps = choice.name == kPlanner || choice.name == kFullPlanner;
  std::shared_ptr<planning::Planner> planner =
      planning_.registry().create(tells_steps ? choice.name : kPlanner);
  if (tells_steps) {
    for (const auto& [key, value] : choice.settings) {
      planner->set_parameter(key, value);
    }
  }
  return planner;
}

void MicroscopePanel::record() {
  const auto& scene = document_.scene();
  if (!document_.problem() || !scene->start || !scene->goal) {
    state_->setText(tr("The scene needs a start and a goal."));
    return;
  }
  set_running(false);
  planning::PlanRequest request = planning_.request();
  request.threads = 1;
  request.time_limit_s = std::min(request.time_limit_s, kLongest);
  microscope_.record(make_planner(), document_.problem(), request, document_.palm());
  show_state();
}

void MicroscopePanel::take_run() {
  {
    const QSignalBlocker quiet(position_);
    position_->setRange(0, static_cast<int>(microscope_.run()->steps.size()) - 1);
  }
  show_state();
}

void MicroscopePanel::show_state() {
  const auto& run = microscope_.run();
  record_->setText(microscope_.is_recording() && !run ? tr("Cancel") : tr("Record a run"));
  for (QWidget* part :
       {static_cast<QWidget*>(rewind_), static_cast<QWidget*>(back_), static_cast<QWidget*>(run_),
        static_cast<QWidget*>(forward_), static_cast<QWidget*>(position_)}) {
    part->setEnabled(run != nullptr);
  }
  if (run) {
    QString text = result_line(run->result);
    if (run->left_out > 0) {
      text += QLatin1Char(' ') + tr("Only the first %1 steps are recorded; %2 more followed.")
                                     .arg(run->steps.size())
                                     .arg(run->left_out);
    }
    if (!run->departures.empty()) {
      QStringList departures;
      for (const std::string& departure : run->departures) {
        departures += QString::fromStdString(departure);
      }
      text += QLatin1Char(' ') +
              tr("Departs from the listings by %1.").arg(departures.join(QStringLiteral(", ")));
    }
    state_->setText(text);
  } else if (microscope_.is_recording()) {
    state_->setText(tr("Planning and recording every step…"));
  } else {
    state_->setText(
        tr("Record a run of the paper's planner and step through it line by line. The robot shows "
           "the current sample, the view the roadmap at that step."));
  }
}

void MicroscopePanel::show_step() {
  const auto& run = microscope_.run();
  for (QLabel* label : {count_, words_}) {
    label->setVisible(run != nullptr);
  }
  if (!run) {
    set_running(false);
    view_.set_overlay(Overlay::kSteps, nullptr);
    caller_->clear();
    called_->clear();
    words_->clear();
    count_->clear();
    show_state();
    return;
  }
  const RecordedStep& recorded = microscope_.step();
  const planning::AlgorithmLine line = recorded.step.line;
  const QSignalBlocker quiet(position_);
  position_->setValue(static_cast<int>(microscope_.position()));
  count_->setText(tr("Step %1 of %2").arg(microscope_.position() + 1).arg(run->steps.size()));
  words_->setText(step_text(*run, microscope_.position()));
  if (line.algorithm == kMain) {
    caller_->show_line(kMain, line.line, false);
    called_->clear();
  } else {
    caller_->show_line(kMain, calling_line(line.algorithm), true);
    called_->show_line(line.algorithm, line.line, false);
  }
  view_.set_overlay(Overlay::kSteps, make_steps_node(microscope_));
  if (recorded.sample >= 0) {
    emit taken();
    document_.set_configuration(run->samples[static_cast<std::size_t>(recorded.sample)]);
  }
}

void MicroscopePanel::step(int direction) {
  if (!microscope_.go(direction, filter())) {
    set_running(false);
  }
}

void MicroscopePanel::set_running(bool running) {
  if (running && microscope_.run()) {
    clock_.start();
  } else {
    clock_.stop();
  }
  refresh_icons();
}

void add_microscope(Workbench& workbench) {
  auto* panel = new MicroscopePanel(workbench.document, workbench.plan_settings, workbench.view);
  workbench.add_dock(DockArea::kBelow, 2, {"microscope", QObject::tr("Microscope"), panel});
  QObject::connect(panel, &MicroscopePanel::taken, &workbench.player, &PathPlayer::pause);
}

}  // namespace handway::gui
