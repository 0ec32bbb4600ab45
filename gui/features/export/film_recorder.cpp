#include "features/export/film_recorder.h"

#include "view3d/scene_pictures.h"

#include <exception>
#include <utility>

namespace handway::gui {
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
    pictures_ = std::make_unique<ScenePictures>(shot.film.scene, shot.oversampling);
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
  pictures_->begin(shot_.film.at(fraction), shot_.camera, shot_.size);
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
