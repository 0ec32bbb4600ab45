#pragma once

#include "handway/planning/campaigns/run_database.h"
#include "handway/planning/extensions/plugin.h"
#include "model/jobs/background.h"
#include "widgets/panels/run_table.h"
#include "widgets/panels/run_view.h"

#include <QObject>
#include <QString>
#include <QTimer>
#include <QWidget>

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSortFilterProxyModel;

namespace handway::gui {

class EcdfPlot;
class RunView;
class Workbench;

/// Carries out a campaign, or reads the runs of one, in the background. Runs go to
/// `runs.sqlite` in a folder beside the campaign's file, named after it, as `handway bench` does;
/// those that are there already are kept.
class CampaignRunner : public QObject {
  Q_OBJECT

 public:
  explicit CampaignRunner(std::shared_ptr<const planning::PluginManager> plugins,
                          QObject* parent = nullptr);
  ~CampaignRunner() override;

  /// Reads a run database, then ended().
  void read(const std::filesystem::path& database);
  /// Carries out what is left of a campaign: one run at a time for each core but one.
  void run(const std::filesystem::path& campaign);
  /// Stops the campaign; finished runs are kept.
  void stop();
  [[nodiscard]] bool is_running() const { return job_.is_busy(); }

 signals:
  /// @param name of the campaign. @param all runs; those done before come with found().
  void began(const QString& name, int all);
  /// A few runs at a time.
  void found(const std::vector<planning::ArchivedRun>& runs);
  /// @param problem empty if all went well.
  void ended(const QString& problem);

 private:
  void start(std::function<void(const std::stop_token&)> work);
  void carry_out(const std::filesystem::path& file, const std::stop_token& stop);
  void hand_over(std::vector<planning::ArchivedRun> runs);

  std::shared_ptr<const planning::PluginManager> plugins_;
  std::stop_source stop_{std::nostopstate};
  LatestJob job_;
};

/// Runs of campaigns: carried out in the background or read from a run database, in a table
/// and as distributions of planning time. A run that is clicked is asked to be shown.
class CampaignsPanel : public QWidget {
  Q_OBJECT

 public:
  explicit CampaignsPanel(std::shared_ptr<const planning::PluginManager> plugins,
                          QWidget* parent = nullptr);

  /// Reads a run database, or carries out a campaign (.yaml).
  void open(const QString& file);
  /// Chooses the tab that the panel is in.
  void come_to_front();
  /// Draws the plot in the colours of the theme that was applied last.
  void take_theme();
  [[nodiscard]] const CampaignRunner& runner() const { return runner_; }

 signals:
  void run_chosen(const planning::ArchivedRun& run);

 private:
  QWidget* make_actions();
  void choose_file();
  void begin(const QString& name, int all);
  void take(const std::vector<planning::ArchivedRun>& runs);
  void end(const QString& problem);
  void show_problem();
  void draw();
  void show_run(const QModelIndex& index);

  CampaignRunner runner_;
  std::vector<planning::ArchivedRun> runs_;  ///< In the order of the table.
  RunTable* table_;
  QSortFilterProxyModel* shown_;
  RunView* view_;
  EcdfPlot* plot_;
  QPushButton* open_;
  QPushButton* stop_;
  QProgressBar* progress_;
  QLabel* state_;
  QComboBox* problems_;
  QString name_;
  QTimer redraw_;  ///< Many runs, one drawing.
};

/// Adds the panel of campaigns; a run that is clicked is planned again, and played.
void add_campaigns(Workbench& workbench);

}  // namespace handway::gui
