#include "workers/export_runner.h"

#include <QStringList>

#include <exception>
#include <functional>
#include <utility>

namespace handway::gui {

ExportRunner::ExportRunner(std::shared_ptr<const planning::Extensions> extensions, QObject* parent)
    : QObject(parent), extensions_(std::move(extensions)) {}

void ExportRunner::run(std::function<std::function<void()>()> job) {
  threads_.run([this, ticket = ++asked_, job = std::move(job)] {
    std::function<void()> news;
    try {
      news = job();
    } catch (const std::exception& error) {
      news = [this, message = QString::fromUtf8(error.what())] { emit failed(message); };
    }
    QMetaObject::invokeMethod(
        this,
        [this, ticket, news] {
          if (ticket == asked_) {
            news();
          }
        },
        Qt::QueuedConnection);
  });
}

void ExportRunner::prepare(const std::string& format,
                           std::shared_ptr<const planning::TimedPath> motion) {
  run([this, &exporter = extensions_->exporter(format), motion = std::move(motion)] {
    const auto files = std::make_shared<const Files>(exporter.files(motion->motion));
    return [this, files] { emit prepared(files); };
  });
}

void ExportRunner::write(const std::string& format,
                         std::shared_ptr<const planning::TimedPath> motion,
                         std::filesystem::path folder) {
  run([this, &exporter = extensions_->exporter(format), motion = std::move(motion),
       folder = std::move(folder)] {
    QStringList files;
    for (const std::filesystem::path& file : exporter.write(motion->motion, folder)) {
      files << QString::fromStdString(file.string());
    }
    return [this, files] { emit written(files); };
  });
}

}  // namespace handway::gui
