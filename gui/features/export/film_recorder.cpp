#include "features/export/film_recorder.h"

#include "handway/geometric/io/input_error.h"
#include "model/jobs/background.h"
#include "view3d/scene_pictures.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>
#include <QSysInfo>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <mutex>
#include <utility>

namespace handway::gui {
namespace {

// On disks that several machines share, each knows its own.
QString start_of_name() {
  return QStringLiteral(".handway-film-%1-").arg(QSysInfo::machineHostName());
}

bool is_running(qint64 program) {
  return ::kill(static_cast<pid_t>(program), 0) == 0 || errno == EPERM;
}

void remove_leftovers(const QDir& folder) {
  const QString start = start_of_name();
  for (const QString& name :
       folder.entryList({start + QLatin1Char('*')}, QDir::Dirs | QDir::Hidden)) {
    bool is_number = false;
    const qint64 program =
        name.mid(start.size()).section(QLatin1Char('-'), 0, 0).toLongLong(&is_number);
    if (is_number && program > 0 && !is_running(program)) {
      QDir(folder.filePath(name)).removeRecursively();
    }
  }
}

}  // namespace

QString parts_beside(const QString& file) {
  return QFileInfo(file).absoluteDir().filePath(
      start_of_name() + QStringLiteral("%1-XXXXXX").arg(QCoreApplication::applicationPid()));
}

void need_writable(const QTemporaryDir& parts, const QString& file) {
  if (!parts.isValid()) {
    throw geometric::InputError({QFileInfo(file).absolutePath().toStdString(), "",
                                 "a folder that can't be written to",
                                 "a folder that can be written to", ""});
  }
}

void remove_leftovers_beside(const QString& file) {
  run_in_background([folder = QFileInfo(file).absoluteDir()] { remove_leftovers(folder); });
}

namespace {

constexpr qint64 kMostWaiting = 32 << 20;  // bytes on their way to ffmpeg

}  // namespace

QString FfmpegFilm::program() { return QStandardPaths::findExecutable(QStringLiteral("ffmpeg")); }

FfmpegFilm::FfmpegFilm(const QString& file, const QSize& size, double rate)
    : file_(file), parts_(std::make_unique<QTemporaryDir>(parts_beside(file))) {
  need_writable(*parts_, file);
  remove_leftovers_beside(file);
  part_ = parts_->filePath(QStringLiteral("film.") + QFileInfo(file).suffix().toLower());
  QStringList arguments{"-loglevel", "error",
                        "-f",        "rawvideo",
                        "-pix_fmt",  "rgb24",
                        "-s",        QStringLiteral("%1x%2").arg(size.width()).arg(size.height()),
                        "-r",        QString::number(rate),
                        "-i",        "-"};
  if (part_.endsWith(QStringLiteral(".gif"))) {
    arguments << "-vf"
              << "split[a][b];[a]palettegen[p];[b][p]paletteuse";
  } else {
    arguments << "-c:v"
              << "libx264"
              << "-crf"
              << "18"
              << "-pix_fmt"
              << "yuv420p"
              << "-movflags"
              << "+faststart";
  }
  arguments << part_;
  connect(&process_, &QProcess::bytesWritten, this, [this] {
    if (has_room()) {
      emit drained();
    }
  });
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) {
      ended_ = true;
      emit failed(tr("ffmpeg can't be started"));
    }
  });
  connect(&process_, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
          &FfmpegFilm::take_end);
  process_.start(program(), arguments);
}

FfmpegFilm::~FfmpegFilm() {
  process_.disconnect(this);
  if (process_.state() != QProcess::NotRunning) {
    process_.kill();
    process_.waitForFinished(1000);
  }
}

bool FfmpegFilm::has_room() const { return process_.bytesToWrite() < kMostWaiting; }

// In one piece: QProcess passes on no more than one at a time.
void FfmpegFilm::add(const QImage& picture) {
  const QImage plain = picture.convertToFormat(QImage::Format_RGB888);
  QByteArray pixels;
  pixels.reserve(3 * plain.width() * plain.height());
  for (int row = 0; row < plain.height(); ++row) {
    pixels.append(reinterpret_cast<const char*>(plain.constScanLine(row)), 3 * plain.width());
  }
  if (!ended_) {
    process_.write(pixels);
  }
}

void FfmpegFilm::finish() { process_.closeWriteChannel(); }

void FfmpegFilm::take_end(int code, QProcess::ExitStatus status) {
  ended_ = true;
  if (status != QProcess::NormalExit || code != 0 || !QFileInfo::exists(part_)) {
    const QString why = QString::fromLocal8Bit(process_.readAllStandardError()).trimmed();
    emit failed(why.isEmpty() ? tr("ffmpeg failed") : tr("ffmpeg: %1").arg(why));
    return;
  }
  if (std::rename(QFile::encodeName(part_).constData(), QFile::encodeName(file_).constData()) !=
      0) {
    emit failed(tr("%1 can't be written").arg(file_));
    return;
  }
  emit done();
}

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

namespace {

constexpr int kPollMs = 3;  // until a picture is drawn

}  // namespace

FilmRecorder::FilmRecorder(QObject* parent) : QObject(parent) {
  next_.setSingleShot(true);
  next_.setInterval(0);
  connect(&next_, &QTimer::timeout, this, &FilmRecorder::step);
}

FilmRecorder::~FilmRecorder() = default;

void FilmRecorder::start(const FilmShot& shot) { start(shot, nullptr); }

void FilmRecorder::start(const FilmShot& shot, std::unique_ptr<FilmSink> sink) {
  cancel();
  shot_ = shot;
  sink_ = std::move(sink);
  try {
    pictures_ = std::make_unique<ScenePictures>(shot.scene, shot.oversampling);
  } catch (const std::exception& error) {
    end();
    emit failed(QString::fromUtf8(error.what()));
    return;
  }
  if (sink_) {
    connect(sink_.get(), &FilmSink::drained, &next_, [this] { next_.start(0); });
    connect(sink_.get(), &FilmSink::done, this, [this] {
      end();
      emit finished();
    });
    connect(sink_.get(), &FilmSink::failed, this, [this](const QString& message) {
      end();
      emit failed(message);
    });
  }
  next_.start();
}

void FilmRecorder::cancel() { end(); }

void FilmRecorder::end() {
  next_.stop();
  pictures_.reset();
  strip_.clear();
  count_ = 0;
  drawing_ = false;
  if (sink_) {
    sink_->disconnect(this);
    sink_.release()->deleteLater();  // it may be telling us just now
  }
}

void FilmRecorder::step() {
  if (!pictures_ || count_ >= shot_.pictures) {
    return;
  }
  try {
    if (!drawing_) {
      begin_picture();
    } else if (pictures_->is_drawn()) {
      take_picture();
    } else {
      next_.start(kPollMs);
    }
  } catch (const std::exception& error) {
    end();
    emit failed(QString::fromUtf8(error.what()));
  }
}

void FilmRecorder::begin_picture() {
  const double fraction = static_cast<double>(count_) / (shot_.pictures - 1);
  pictures_->begin(shot_.timeline.at(fraction), shot_.camera, shot_.size);
  drawing_ = true;
  next_.start(0);
}

void FilmRecorder::take_picture() {
  drawing_ = false;
  QImage picture = pictures_->take();
  emit progressed(++count_, shot_.pictures);
  if (sink_) {
    sink_->add(picture);
  } else {
    strip_.push_back(std::move(picture));
  }
  if (!pictures_) {
    return;  // the sink has failed
  }
  if (count_ < shot_.pictures) {
    if (!sink_ || sink_->has_room()) {
      next_.start(0);
    }
  } else if (sink_) {
    sink_->finish();
  } else {
    const std::vector<QImage> strip = std::exchange(strip_, {});
    end();
    emit taken(strip);
  }
}

}  // namespace handway::gui
