#include "model/document/autosave.h"

#include "handway/geometric/io/replace_file.h"
#include "model/document/document.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>

#include <algorithm>
#include <system_error>
#include <utility>

namespace handway::gui {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSceneFile = "scene.yaml";
constexpr const char* kAboutFile = "about.json";
constexpr const char* kLockFile = "window.lock";

QString qpath(const fs::path& path) { return QString::fromStdString(path.string()); }

std::unique_ptr<QLockFile> make_lock(const fs::path& folder) {
  auto lock = std::make_unique<QLockFile>(qpath(folder / kLockFile));
  lock->setStaleLockTime(0);  // however long a window is open
  return lock;
}

void remove_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

}  // namespace

fs::path Autosave::default_folder() {
  return fs::path(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation).toStdString()) /
         "unsaved";
}

Autosave::Autosave(fs::path folder, QObject* parent)
    : QObject(parent),
      all_(std::move(folder)),
      folder_(all_ / QStringLiteral("%1-%2")
                         .arg(QCoreApplication::applicationPid())
                         .arg(QDateTime::currentMSecsSinceEpoch())
                         .toStdString()) {
  QDir().mkpath(qpath(folder_));
  lock_ = make_lock(folder_);
  lock_->tryLock(0);
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

Autosave::~Autosave() {
  thread_.request_stop();
  wake_.notify_all();
  thread_.join();
  lock_.reset();
  remove_folder(folder_);
}

void Autosave::add(Job job) {
  {
    const std::lock_guard guard(mutex_);
    if (next_ && next_->then_forget && !job.then_forget) {
      job.then_forget = next_->then_forget;
    }
    next_ = std::move(job);
  }
  wake_.notify_all();
}

void Autosave::store(UnsavedScene scene, const std::optional<LostScene>& then_forget) {
  add({std::move(scene), then_forget});
}

void Autosave::clear() { add({}); }

void Autosave::work(const std::stop_token& stop) {
  while (true) {
    Job job;
    {
      std::unique_lock guard(mutex_);
      if (!wake_.wait(guard, stop, [this] { return next_.has_value(); })) {
        return;
      }
      job = *std::exchange(next_, std::nullopt);
    }
    try {
      run(job);
      QMetaObject::invokeMethod(
          this, [this] { emit stored(); }, Qt::QueuedConnection);
    } catch (const std::exception& error) {
      QMetaObject::invokeMethod(
          this, [this, message = QString::fromUtf8(error.what())] { emit failed(message); },
          Qt::QueuedConnection);
    }
  }
}

void Autosave::run(const Job& job) const {
  if (!job.scene) {
    std::error_code ignored;
    fs::remove(folder_ / kSceneFile, ignored);
  } else {
    const UnsavedScene& unsaved = *job.scene;
    const QJsonObject about{{"file", qpath(unsaved.file)}, {"name", unsaved.name}};
    geometric::replace_file(folder_ / kAboutFile, QJsonDocument(about).toJson().toStdString());
    save_scene(unsaved.loaded, unsaved.shown, unsaved.planner, folder_ / kSceneFile);
  }
  if (job.then_forget) {
    forget(*job.then_forget);
  }
}

std::vector<LostScene> Autosave::find_lost() const {
  std::vector<LostScene> lost;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(all_, ignored)) {
    const fs::path& folder = entry.path();
    if (folder == folder_ || !entry.is_directory() || !make_lock(folder)->tryLock(0)) {
      continue;  // somebody still works there
    }
    if (!fs::exists(folder / kSceneFile)) {
      remove_folder(folder);
      continue;
    }
    QFile about(qpath(folder / kAboutFile));
    const bool readable = about.open(QIODevice::ReadOnly);
    const QJsonObject words =
        readable ? QJsonDocument::fromJson(about.readAll()).object() : QJsonObject();
    lost.push_back({folder, folder / kSceneFile, words["file"].toString().toStdString(),
                    words["name"].toString(),
                    QFileInfo(qpath(folder / kSceneFile)).lastModified()});
  }
  std::ranges::sort(lost, std::ranges::greater(), &LostScene::time);
  return lost;
}

void Autosave::forget(const LostScene& lost) { remove_folder(lost.folder); }

}  // namespace handway::gui
