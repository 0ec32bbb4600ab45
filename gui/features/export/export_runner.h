#pragma once

#include "handway/planning/core/plugin.h"
#include "handway/planning/timing/time_path.h"
#include "model/jobs/latest_job.h"

#include <QObject>
#include <QString>

#include <memory>
#include <vector>

namespace handway::gui {

/// Makes and writes the files of a motion off the GUI thread. Only the answer to the latest
/// request counts.
class ExportRunner : public QObject {
  Q_OBJECT

 public:
  using Files = std::vector<planning::ExportedFile>;

  explicit ExportRunner(std::shared_ptr<const planning::Extensions> extensions,
                        QObject* parent = nullptr);

  /// Makes the files; prepared() or failed() follows.
  /// @param format name of an exporter. @pre the motion is cleared().
  void prepare(const std::string& format, std::shared_ptr<const planning::TimedPath> motion,
               const planning::ExportOptions& options);
  /// Writes them; written() or failed() follows.
  void write(const std::string& format, std::shared_ptr<const planning::TimedPath> motion,
             std::filesystem::path folder, const planning::ExportOptions& options);
  /// No answer is wanted any more.
  void forget() { job_.cancel(); }

 signals:
  void prepared(const std::shared_ptr<const handway::gui::ExportRunner::Files>& files);
  void written(const QStringList& files);
  void failed(const QString& message);

 private:
  /// @param work may throw.
  void run(std::function<LatestJob::Answer()> work);

  std::shared_ptr<const planning::Extensions> extensions_;
  LatestJob job_;
};

}  // namespace handway::gui
