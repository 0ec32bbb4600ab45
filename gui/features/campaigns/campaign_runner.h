#pragma once

#include "handway/planning/campaigns/run_archive.h"
#include "handway/planning/core/plugin.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

namespace handway::gui {

/// Carries out a campaign, or reads the runs of one, on a thread of its own. Runs go to
/// `runs.sqlite` in a folder beside the campaign's file, named after it, as `handway bench` does;
/// those that are there already are kept.
class CampaignRunner : public QObject {
  Q_OBJECT

 public:
  explicit CampaignRunner(std::shared_ptr<const planning::Extensions> extensions,
                          QObject* parent = nullptr);
  ~CampaignRunner() override;

  /// Reads a run database, then ended().
  void read(const std::filesystem::path& database);
  /// Carries out what is left of a campaign: one run at a time for each core but one.
  void run(const std::filesystem::path& campaign);
  /// Ends it; what is done is kept.
  void stop();
  [[nodiscard]] bool is_running() const { return running_; }

 signals:
  /// @param name of the campaign. @param all runs; those done before come with found().
  void began(const QString& name, int all);
  /// A few runs at a time.
  void found(const std::vector<planning::ArchivedRun>& runs);
  /// @param problem empty if all went well.
  void ended(const QString& problem);

 private:
  template <typename Work>
  void start(Work work);
  void carry_out(const std::filesystem::path& file, const std::stop_token& stop);
  void hand_over(std::vector<planning::ArchivedRun> runs);

  std::shared_ptr<const planning::Extensions> extensions_;
  bool running_ = false;
  std::jthread thread_;
};

}  // namespace handway::gui
