#include "features/campaigns/campaign_runner.h"

#include "handway/planning/campaigns/campaign_reader.h"
#include "handway/planning/campaigns/run_database.h"
#include "handway/planning/campaigns/run_executor.h"
#include "handway/planning/campaigns/run_workers.h"

#include <QCoreApplication>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

namespace fs = std::filesystem;
using planning::ArchivedRun;

int workers_beside_the_window() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

}  // namespace

CampaignRunner::CampaignRunner(std::shared_ptr<const planning::Extensions> extensions,
                               QObject* parent)
    : QObject(parent), extensions_(std::move(extensions)) {}

CampaignRunner::~CampaignRunner() { stop(); }

// The thread before this one has ended, but for its last line.
template <typename Work>
void CampaignRunner::start(Work work) {
  if (running_) {
    return;
  }
  running_ = true;
  thread_ = std::jthread([this, work = std::move(work)](const std::stop_token& stop) {
    QString problem;
    try {
      work(stop);
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, problem] {
          running_ = false;
          emit ended(problem);
        },
        Qt::QueuedConnection);
  });
}

void CampaignRunner::read(const fs::path& database) {
  start([this, database](const std::stop_token&) { hand_over(planning::read_runs(database)); });
}

void CampaignRunner::run(const fs::path& campaign) {
  start([this, campaign](const std::stop_token& stop) { carry_out(campaign, stop); });
}

void CampaignRunner::stop() { thread_.request_stop(); }

void CampaignRunner::hand_over(std::vector<ArchivedRun> runs) {
  QMetaObject::invokeMethod(
      this, [this, runs = std::move(runs)] { emit found(runs); }, Qt::QueuedConnection);
}

void CampaignRunner::carry_out(const fs::path& file, const std::stop_token& stop) {
  const planning::Campaign campaign = planning::read_campaign(file, extensions_->planners());
  const fs::path folder = file.parent_path() / file.stem();
  fs::create_directories(folder);
  const planning::RunExecutor executor(campaign, *extensions_);
  planning::RunDatabase database(folder / "runs.sqlite", executor.campaign(),
                                 QCoreApplication::applicationVersion().toStdString(),
                                 planning::RunDatabase::Opening::kResume);
  QMetaObject::invokeMethod(
      this,
      [this, name = QString::fromStdString(campaign.name),
       all = static_cast<int>(campaign.run_count())] { emit began(name, all); },
      Qt::QueuedConnection);
  const auto tell = [&](std::span<const planning::RunRecord> records) {
    std::vector<ArchivedRun> runs;
    runs.reserve(records.size());
    for (const planning::RunRecord& record : records) {
      runs.push_back(planning::archived(campaign, record));
    }
    if (!runs.empty()) {
      hand_over(std::move(runs));
    }
  };
  tell(database.records());
  planning::ThreadWorkers workers(workers_beside_the_window());
  workers.carry_out(
      executor, database.pending(),
      [&](std::span<const planning::RunRecord> records) {
        if (!records.empty()) {
          database.add(records);
          tell(records);
        }
      },
      stop);
}

}  // namespace handway::gui
