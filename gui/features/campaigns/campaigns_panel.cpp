#include "features/campaigns/campaigns_panel.h"

#include "features/workbench.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_database.h"
#include "handway/planning/campaigns/run_workers.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/run_table.h"
#include "widgets/panels/run_view.h"
#include "widgets/plots/ecdf_plot.h"
#include "widgets/plots/screen_colors.h"
#include "widgets/style/color_math.h"
#include "widgets/style/rich_text.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QSplitter>

#include <algorithm>
#include <iterator>
#include <set>
#include <thread>
#include <utility>

namespace handway::gui {
namespace {

namespace fs = std::filesystem;
using planning::ArchivedRun;

int workers_beside_the_window() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

}  // namespace

CampaignRunner::CampaignRunner(std::shared_ptr<const planning::PluginManager> plugins,
                               QObject* parent)
    : QObject(parent), plugins_(std::move(plugins)) {
  connect(&job_, &LatestJob::failed, this, &CampaignRunner::ended);
}

CampaignRunner::~CampaignRunner() { stop(); }

void CampaignRunner::start(std::function<void(const std::stop_token&)> work) {
  if (is_running()) {
    return;
  }
  stop_ = {};
  job_.run([this, work = std::move(work),
            stop = stop_.get_token()](const std::stop_token&) -> LatestJob::Answer {
    work(stop);
    return [this] { emit ended({}); };
  });
}

void CampaignRunner::read(const fs::path& database) {
  start([this, database](const std::stop_token&) { hand_over(planning::read_runs(database)); });
}

void CampaignRunner::run(const fs::path& campaign) {
  start([this, campaign](const std::stop_token& stop) { carry_out(campaign, stop); });
}

void CampaignRunner::stop() { stop_.request_stop(); }

void CampaignRunner::hand_over(std::vector<ArchivedRun> runs) {
  QMetaObject::invokeMethod(
      this, [this, runs = std::move(runs)] { emit found(runs); }, Qt::QueuedConnection);
}

void CampaignRunner::carry_out(const fs::path& file, const std::stop_token& stop) {
  const fs::path folder = file.parent_path() / file.stem();
  const planning::RunExecutor executor(planning::read_campaign(file, plugins_->planners()),
                                       *plugins_);
  const planning::Campaign& campaign = executor.campaign();
  fs::create_directories(folder);
  planning::RunDatabase database(folder / "runs.sqlite", campaign,
                                 QCoreApplication::applicationVersion().toStdString(),
                                 planning::RunDatabase::Opening::kResume);
  QMetaObject::invokeMethod(
      this,
      [this, name = QString::fromStdString(campaign.name),
       all = static_cast<int>(campaign.run_count())] { emit began(name, all); },
      Qt::QueuedConnection);
  const auto notify = [&](std::span<const planning::RunRecord> records) {
    std::vector<ArchivedRun> runs;
    runs.reserve(records.size());
    for (const planning::RunRecord& record : records) {
      runs.push_back(planning::archived(campaign, record));
    }
    if (!runs.empty()) {
      hand_over(std::move(runs));
    }
  };
  notify(database.records());
  planning::ThreadWorkers workers(workers_beside_the_window());
  workers.carry_out(
      executor, database.pending(),
      [&](std::span<const planning::RunRecord> records) {
        if (!records.empty()) {
          database.add(records);
          notify(records);
        }
      },
      stop);
}

namespace {

constexpr QSize kLeastPlot(240, 140);
constexpr int kLeastTable = 80;  // px high

constexpr int kRedrawInterval = 250;  // ms
constexpr int kPlotHeight = 300;      // px
constexpr int kTableHeight = 330;

/// The runs on one problem.
class RunsOfProblem : public QSortFilterProxyModel {
 public:
  RunsOfProblem(const std::vector<planning::ArchivedRun>& runs, const QComboBox& problems,
                QObject* parent)
      : QSortFilterProxyModel(parent), runs_(runs), problems_(problems) {}

 protected:
  [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& /*parent*/) const override {
    return problems_.currentText() ==
           QString::fromStdString(runs_[static_cast<std::size_t>(row)].problem);
  }

 private:
  const std::vector<planning::ArchivedRun>& runs_;
  const QComboBox& problems_;
};

RunRow row_of(const planning::ArchivedRun& run) {
  RunRow row;
  row.planner = QString::fromStdString(run.planner.label);
  row.seed = run.record.spec.seed;
  row.time_s = run.record.time_s;
  row.outcome = QString::fromStdString(run.record.status);
  row.samples = run.record.samples;
  if (run.record.solved) {
    row.nodes = run.record.path_nodes;
    row.clearance = geometric::millimetres(run.record.min_clearance);
  }
  row.tip = QObject::tr("Open the scene of the run and plan again with its seed");
  return row;
}

}  // namespace

CampaignsPanel::CampaignsPanel(std::shared_ptr<const planning::PluginManager> plugins,
                               QWidget* parent)
    : QWidget(parent),
      runner_(std::move(plugins)),
      table_(new RunTable(this)),
      shown_(nullptr),
      view_(nullptr),
      plot_(new EcdfPlot),
      open_(named("campaign_open", new QPushButton(tr("Open…")))),
      stop_(named("campaign_stop", new QPushButton(tr("Stop")))),
      progress_(new QProgressBar),
      state_(named(
          "campaign_state",
          new QLabel(tr("Open a campaign to execute it, or a run database to show its runs.")))),
      problems_(named("campaign_problem", new QComboBox)) {
  shown_ = new RunsOfProblem(runs_, *problems_, this);
  shown_->setSourceModel(table_);
  view_ = new RunView(*shown_,
                      {RunTable::kPlanner, RunTable::kSeed, RunTable::kTime, RunTable::kOutcome,
                       RunTable::kSamples, RunTable::kNodes, RunTable::kClearance});
  view_->setObjectName(QStringLiteral("campaign_runs"));
  view_->setAccessibleName(tr("Runs of the campaign"));
  view_->horizontalHeader()->setSectionResizeMode(RunTable::kPlanner,
                                                  QHeaderView::ResizeToContents);
  view_->horizontalHeader()->setResizeContentsPrecision(50);
  view_->sortByColumn(RunTable::kSeed, Qt::AscendingOrder);
  connect(view_, &QTableView::clicked, this, &CampaignsPanel::show_run);
  // The panel shares its place with smaller ones.
  plot_->setMinimumSize(kLeastPlot);
  view_->setMinimumHeight(kLeastTable);
  problems_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  auto* parts = new QSplitter(Qt::Vertical);
  parts->addWidget(view_);
  parts->addWidget(plot_);
  parts->setSizes({kTableHeight, kPlotHeight});
  parts->setChildrenCollapsible(false);
  setLayout(in_column({make_actions(), progress_, state_, problems_, {parts, 1}}));
  state_->setTextFormat(Qt::RichText);
  state_->setWordWrap(true);
  progress_->setVisible(false);
  problems_->setVisible(false);
  redraw_.setSingleShot(true);
  redraw_.setInterval(kRedrawInterval);
  take_theme();
  connect(&redraw_, &QTimer::timeout, this, &CampaignsPanel::draw);
  connect(problems_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &CampaignsPanel::show_problem);
  connect(&runner_, &CampaignRunner::began, this, &CampaignsPanel::begin);
  connect(&runner_, &CampaignRunner::found, this, &CampaignsPanel::take);
  connect(&runner_, &CampaignRunner::ended, this, &CampaignsPanel::end);
}

void CampaignsPanel::take_theme() {
  const PlotColors colors = screen_colors();
  plot_->set_colors(colors,
                    [paper = colors.paper](const QColor& color) { return seen_on(paper, color); });
  draw();
}

QWidget* CampaignsPanel::make_actions() {
  open_->setToolTip(tr("Execute a campaign (.yaml), or open a run database (.sqlite)"));
  stop_->setToolTip(tr("Finished runs are kept; open the campaign again to continue"));
  stop_->setEnabled(false);
  connect(open_, &QPushButton::clicked, this, &CampaignsPanel::choose_file);
  connect(stop_, &QPushButton::clicked, &runner_, &CampaignRunner::stop);
  return boxed(in_row({{open_, 1}, {stop_, 1}}));
}

void CampaignsPanel::choose_file() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open a campaign or its runs"), {},
                                   tr("Campaigns and runs (*.yaml *.yml *.sqlite);;All files (*)"));
  if (!file.isEmpty()) {
    open(file);
  }
}

void CampaignsPanel::open(const QString& file) {
  if (runner_.is_running()) {
    return;
  }
  runs_.clear();
  table_->clear();
  problems_->clear();
  draw();
  name_ = QFileInfo(file).fileName();
  open_->setEnabled(false);
  stop_->setEnabled(true);
  progress_->setRange(0, 0);
  progress_->setVisible(true);
  state_->setText(tr("Reading %1…").arg(name_.toHtmlEscaped()));
  const std::filesystem::path path = QFileInfo(file).absoluteFilePath().toStdString();
  if (file.endsWith(QLatin1String(".sqlite"))) {
    runner_.read(path);
  } else {
    runner_.run(path);
  }
}

void CampaignsPanel::come_to_front() { bring_to_front(*this); }

void CampaignsPanel::begin(const QString& name, int all) {
  name_ = name;
  progress_->setRange(0, all);
  progress_->setValue(0);
  state_->setText(tr("%1: %n run(s)", nullptr, all).arg(name.toHtmlEscaped()));
}

void CampaignsPanel::take(const std::vector<planning::ArchivedRun>& runs) {
  for (const planning::ArchivedRun& run : runs) {
    const QString problem = QString::fromStdString(run.problem);
    if (problems_->findText(problem) < 0) {
      problems_->addItem(problem);
      problems_->setVisible(true);
    }
  }
  std::vector<RunRow> rows;
  rows.reserve(runs.size());
  std::ranges::transform(runs, std::back_inserter(rows), row_of);
  runs_.insert(runs_.end(), runs.begin(), runs.end());
  table_->add(rows);
  if (progress_->maximum() > 0) {
    progress_->setValue(table_->rowCount());
  }
  if (!redraw_.isActive()) {
    redraw_.start();
  }
}

void CampaignsPanel::end(const QString& problem) {
  open_->setEnabled(true);
  stop_->setEnabled(false);
  const bool complete = progress_->maximum() == 0 || table_->rowCount() == progress_->maximum();
  progress_->setVisible(false);
  const auto solved =
      std::ranges::count_if(runs_, &planning::RunRecord::solved, &planning::ArchivedRun::record);
  if (!problem.isEmpty()) {
    state_->setText(colored(problem, colors_of(current_theme()).bad));
  } else {
    state_->setText(tr("%1: %2 runs, %3 with a path%4")
                        .arg(name_.toHtmlEscaped(), QString::number(table_->rowCount()),
                             QString::number(solved),
                             complete ? QString() : tr("; stopped before its end")));
  }
  draw();
}

void CampaignsPanel::show_problem() {
  shown_->invalidate();
  draw();
}

void CampaignsPanel::draw() {
  std::vector<EcdfCurve> curves;
  for (const planning::ArchivedRun& run : runs_) {
    if (QString::fromStdString(run.problem) != problems_->currentText()) {
      continue;
    }
    const QString title = QString::fromStdString(run.planner.label);
    auto curve = std::find_if(curves.begin(), curves.end(),
                              [&](const EcdfCurve& other) { return other.title == title; });
    if (curve == curves.end()) {
      curve = curves.insert(curves.end(), EcdfCurve{title, {}, 0});
    }
    ++curve->runs;
    if (run.record.solved) {
      curve->times.push_back(run.record.time_s);
    }
  }
  plot_->set_curves(curves);
}

void CampaignsPanel::show_run(const QModelIndex& index) {
  const QModelIndex row = shown_->mapToSource(index);
  emit run_chosen(runs_[static_cast<std::size_t>(row.row())]);
}

void add_campaigns(Workbench& workbench) {
  auto* panel = new CampaignsPanel(workbench.plugins);
  workbench.add_dock(DockArea::kControl, 5, {"campaigns", QObject::tr("Campaigns"), panel});
  workbench.add_work([panel] { return panel->runner().is_running(); });
  QObject::connect(&workbench, &Workbench::theme_changed, panel, &CampaignsPanel::take_theme);
  QObject::connect(&workbench, &Workbench::begun, panel, [panel, &workbench] {
    if (!workbench.options.campaign.empty()) {
      panel->come_to_front();
      panel->open(QString::fromStdString(workbench.options.campaign.string()));
    }
  });
  // A run is its problem, planner, parameters and seed: planned again, it gives the same path.
  QObject::connect(panel, &CampaignsPanel::run_chosen, &workbench,
                   [&workbench](const planning::ArchivedRun& run) {
                     Options options;
                     options.play = true;
                     options.planner = run.planner.planner;
                     options.settings = run.planner.parameters;
                     options.seed = run.record.spec.seed;
                     workbench.open(run.file, options);
                   });
}

}  // namespace handway::gui
