#pragma once

#include "features/campaigns/campaign_runner.h"
#include "widgets/panels/run_table.h"

#include <QTimer>
#include <QWidget>

#include <memory>
#include <vector>

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSortFilterProxyModel;

namespace handway::gui {

class EcdfPlot;
class RunView;

/// Runs of campaigns: carried out in the background or read from a run database, in a table
/// and as distributions of planning time. A run that is clicked is asked to be shown.
class CampaignsPanel : public QWidget {
  Q_OBJECT

 public:
  explicit CampaignsPanel(std::shared_ptr<const planning::Extensions> extensions,
                          QWidget* parent = nullptr);

  /// Reads a run database, or carries out a campaign (.yaml).
  void open(const QString& file);
  /// Chooses the tab that the panel is in.
  void come_to_front();
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
  std::vector<planning::ArchivedRun> runs_;  ///< As in the table.
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

}  // namespace handway::gui
