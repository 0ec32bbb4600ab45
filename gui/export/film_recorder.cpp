#include "export/film_recorder.h"

#include "view3d/scene_pictures.h"

#include <exception>
#include <utility>

namespace handway::gui {

FilmRecorder::FilmRecorder(QObject* parent) : QObject(parent) {
  next_.setSingleShot(true);
  next_.setInterval(0);
  connect(&next_, &QTimer::timeout, this, &FilmRecorder::take_picture);
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
    connect(sink_.get(), &FilmSink::drained, &next_, qOverload<>(&QTimer::start));
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
  if (sink_) {
    sink_->disconnect(this);
    sink_.release()->deleteLater();  // it may be telling us just now
  }
}

void FilmRecorder::take_picture() {
  if (!pictures_ || count_ >= shot_.pictures) {
    return;
  }
  const double fraction = static_cast<double>(count_) / (shot_.pictures - 1);
  QImage picture;
  try {
    picture = pictures_->picture(shot_.timeline.at(fraction), shot_.camera, shot_.size);
  } catch (const std::exception& error) {
    end();
    emit failed(QString::fromUtf8(error.what()));
    return;
  }
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
      next_.start();
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
