#include "features/export/export_runner.h"

#include <QStringList>

#include <exception>
#include <functional>
#include <utility>

namespace handway::gui {

ExportRunner::ExportRunner(std::shared_ptr<const planning::Extensions> extensions, QObject* parent)
    : QObject(parent), extensions_(std::move(extensions)) {}

void ExportRunner::run(std::function<LatestJob::Answer()> work) {
  job_.run([this, work = std::move(work)](const std::stop_token& /*stop*/) -> LatestJob::Answer {
    try {
      return work();
    } catch (const std::exception& error) {
      return [this, message = QString::fromUtf8(error.what())] { emit failed(message); };
    }
  });
}

void ExportRunner::prepare(const std::string& format,
                           std::shared_ptr<const planning::TimedPath> motion,
                           const planning::ExportOptions& options) {
  run([this, &exporter = extensions_->exporter(format), motion = std::move(motion), options] {
    const auto files = std::make_shared<const Files>(exporter.files(motion->motion, options));
    return [this, files] { emit prepared(files); };
  });
}

void ExportRunner::write(const std::string& format,
                         std::shared_ptr<const planning::TimedPath> motion,
                         std::filesystem::path folder, const planning::ExportOptions& options) {
  run([this, &exporter = extensions_->exporter(format), motion = std::move(motion),
       folder = std::move(folder), options] {
    QStringList files;
    for (const std::filesystem::path& file : exporter.write(motion->motion, folder, options)) {
      files << QString::fromStdString(file.string());
    }
    return [this, files] { emit written(files); };
  });
}

}  // namespace handway::gui
