#include "features/export/frame_folder.h"

#include "features/export/film_parts.h"
#include "handway/geometric/io/input_error.h"
#include "model/jobs/background.h"

#include <QBuffer>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QObject>
#include <QTemporaryDir>

#include <atomic>
#include <mutex>
#include <utility>

namespace handway::gui {
namespace {

bool write_all(QFile& file, const QByteArray& bytes) {
  qint64 done = 0;
  while (done < bytes.size()) {
    const qint64 written = file.write(bytes.constData() + done, bytes.size() - done);
    if (written <= 0) {
      return false;
    }
    done += written;  // a disk that becomes full takes a part, and says why the next time
  }
  return true;
}

// Returns the error in words; empty if there is none.
QString write_png(const QImage& picture, const QString& path) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  picture.save(&buffer, "PNG");
  QFile file(path);
  return file.open(QIODevice::WriteOnly | QIODevice::Unbuffered) && write_all(file, bytes)
             ? QString()
             : QObject::tr("%1 can't be written: %2")
                   .arg(QFileInfo(path).fileName(), file.errorString());
}

}  // namespace

/// The folder of the parts, and the functions that wait for them.
class FrameFolder::Parts {
 public:
  Parts(FrameFolder& owner, const QString& folder)
      : owner_(&owner), folder_(parts_beside(folder)) {}

  [[nodiscard]] QTemporaryDir& folder() { return folder_; }
  [[nodiscard]] bool are_wanted() const { return wanted_; }
  void forget_owner() {
    const std::lock_guard lock(mutex_);
    owner_ = nullptr;
    wanted_ = false;
  }
  void notify(const QString& fault) {
    const std::lock_guard lock(mutex_);
    if (owner_) {
      QMetaObject::invokeMethod(
          owner_, [owner = owner_, fault] { owner->take_written(fault); }, Qt::QueuedConnection);
    }
  }

 private:
  std::mutex mutex_;
  FrameFolder* owner_;
  std::atomic<bool> wanted_ = true;
  QTemporaryDir folder_;
};

FrameFolder::FrameFolder(const QString& folder)
    : folder_(folder), parts_(std::make_shared<Parts>(*this, folder)) {
  if (QFileInfo::exists(folder)) {
    throw geometric::InputError(
        {folder.toStdString(), "", "a file or folder of that name", "a new name", ""});
  }
  need_writable(parts_->folder(), folder);
  remove_leftovers_beside(folder);
}

FrameFolder::~FrameFolder() {
  parts_->forget_owner();
  // To remove many files takes a while.
  run_in_background([parts = std::exchange(parts_, nullptr)]() mutable { parts.reset(); });
}

void FrameFolder::add(const QImage& picture) {
  if (failed_) {
    return;
  }
  const QString name = QStringLiteral("frame_%1.png").arg(++count_, 5, 10, QLatin1Char('0'));
  ++waiting_;
  run_in_background([parts = parts_, picture, path = parts_->folder().filePath(name)] {
    if (parts->are_wanted()) {
      parts->notify(write_png(picture, path));
    }
  });
}

void FrameFolder::finish() {
  complete_ = true;
  end();
}

void FrameFolder::take_written(const QString& fault) {
  --waiting_;
  if (failed_) {
    return;
  }
  if (!fault.isEmpty()) {
    failed_ = true;
    emit failed(fault);
  } else if (complete_) {
    end();
  } else if (has_room()) {
    emit drained();
  }
}

void FrameFolder::end() {
  if (failed_ || waiting_ > 0) {
    return;
  }
  QTemporaryDir& parts = parts_->folder();
  if (!QDir().rename(parts.path(), folder_)) {
    failed_ = true;
    emit failed(tr("%1 can't be written").arg(folder_));
    return;
  }
  QFile::setPermissions(folder_, QFile::permissions(QFileInfo(folder_).absolutePath()));
  parts.setAutoRemove(false);
  emit done();
}

}  // namespace handway::gui
