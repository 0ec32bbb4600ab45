#include "features/export/ffmpeg_film.h"

#include "features/export/film_parts.h"

#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>

#include <cstdio>

namespace handway::gui {
namespace {

constexpr qint64 kMostBytesWaiting = 32 << 20;  // on their way to ffmpeg

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

bool FfmpegFilm::has_room() const { return process_.bytesToWrite() < kMostBytesWaiting; }

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

}  // namespace handway::gui
