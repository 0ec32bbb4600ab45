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

void write(const std::optional<UnsavedScene>& unsaved, const fs::path& folder) {
  if (!unsaved) {
    std::error_code ignored;
    fs::remove(folder / kSceneFile, ignored);
    return;
  }
  const QJsonObject about{{"file", qpath(unsaved->file)}, {"name", unsaved->name}};
  geometric::replace_file(folder / kAboutFile, QJsonDocument(about).toJson().toStdString());
  save_scene(unsaved->loaded, unsaved->shown, unsaved->planner, folder / kSceneFile);
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
                         .toStdString()),
      job_(std::make_unique<LatestJob>()) {
  QDir().mkpath(qpath(folder_));
  lock_ = make_lock(folder_);
  lock_->tryLock(0);
  connect(job_.get(), &LatestJob::failed, this, &Autosave::failed);
}

Autosave::~Autosave() {
  job_.reset();  // has written
  lock_.reset();
  remove_folder(folder_);
}

void Autosave::store(UnsavedScene scene, const std::optional<LostScene>& then_forget) {
  keep(std::move(scene), then_forget);
}

void Autosave::clear() { keep(std::nullopt, std::nullopt); }

void Autosave::keep(std::optional<UnsavedScene> scene,
                    const std::optional<LostScene>& then_forget) {
  to_forget_ = then_forget ? then_forget : to_forget_;
  job_->run_next([this, scene = std::move(scene), folder = folder_,
                  lost = to_forget_](const std::stop_token&) -> LatestJob::Answer {
    write(scene, folder);
    if (lost) {
      forget(*lost);
    }
    return [this] {
      to_forget_.reset();
      emit stored();
    };
  });
}

std::vector<LostScene> Autosave::find_lost() const {
  std::vector<LostScene> lost;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(all_, ignored)) {
    const fs::path& folder = entry.path();
    if (folder == folder_ || !entry.is_directory() || !make_lock(folder)->tryLock(0)) {
      continue;  // another program still uses it
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
