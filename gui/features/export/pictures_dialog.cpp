#include "features/export/pictures_dialog.h"

#include "features/export/ffmpeg_film.h"
#include "features/export/film_recorder.h"
#include "features/export/film_sink.h"
#include "features/export/frame_folder.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/file_dialogs.h"
#include "widgets/panels/playback_bar.h"
#include "widgets/plots/figure_file.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QStandardItemModel>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace handway::gui {

StripWriter::StripWriter(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, [this](const QString& message) {
    busy_ = false;
    writing_ = false;
    emit failed(message);
  });
}

void StripWriter::start(const QString& file, const QString& title,
                        const std::vector<QImage>& pictures) {
  busy_ = true;
  writing_ = false;
  job_.run([this, file, title, pictures](const std::stop_token&) {
    const std::vector<Strip> strips{{{}, pictures}};
    return
        [this, file, bytes = picture_bytes(file, title, strips_size(strips), draw_strips(strips))] {
          write(file, bytes);
        };
  });
}

void StripWriter::cancel() {
  if (!writing_) {
    busy_ = false;
    job_.cancel();
  }
}

void StripWriter::write(const QString& file, const QByteArray& bytes) {
  writing_ = true;
  emit writing();
  job_.run([this, file, bytes](const std::stop_token&) {
    write_bytes(file, bytes);
    return [this] {
      busy_ = false;
      writing_ = false;
      emit written();
    };
  });
}

namespace {

constexpr int kStripPictures = 6;
constexpr int kMostStripPictures = 20;
constexpr int kFineStrips = 2;  // oversampling

}  // namespace

PicturesDialog::PicturesDialog(Film film, const OrbitCamera& camera, QWidget* parent)
    : QDialog(parent),
      film_(std::move(film)),
      camera_(camera),
      kinds_(named("pictures_kind", new QComboBox)),
      pictures_(named("pictures_count", new QSpinBox)),
      sizes_(named("pictures_size", new QComboBox)),
      rates_(named("pictures_rate", new QComboBox)),
      speeds_(new QComboBox),
      count_(note()),
      file_(named("pictures_file",
                  new QLineEdit(
                      QDir(QDir::homePath()).filePath(film_.name.simplified().replace(' ', '_'))))),
      progress_(new QProgressBar),
      export_button_(named("pictures_export", new QPushButton(tr("Export")))),
      close_button_(named("pictures_close", new QPushButton(tr("Close")))),
      note_(named("pictures_note", note())) {
  setWindowTitle(film_.title);
  setAttribute(Qt::WA_DeleteOnClose);
  setMinimumWidth(scaled(520));
  lay_out(*this, in_column({make_settings(), make_destination()}, 12), {14, 12, 14, 14});
  connect(kinds_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &PicturesDialog::take_kind);
  for (QComboBox* box : {rates_, speeds_}) {
    connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this,
            &PicturesDialog::show_count);
  }
  connect(pictures_, qOverload<int>(&QSpinBox::valueChanged), this, &PicturesDialog::show_count);
  connect(export_button_, &QPushButton::clicked, this, &PicturesDialog::begin);
  connect(close_button_, &QPushButton::clicked, this, [this] {
    if (is_busy()) {
      cancel();
    } else {
      reject();
    }
  });
  connect_workers();
  show_busy(false);
  take_kind();
}

void PicturesDialog::connect_workers() {
  connect(&recorder_, &FilmRecorder::progressed, this, [this](int done, int all) {
    progress_->setMaximum(all);
    progress_->setValue(done);
  });
  connect(&recorder_, &FilmRecorder::taken, this, [this](const std::vector<QImage>& pictures) {
    note_->setText(tr("Drawing the strip…"));
    strip_.start(file_->text(), windowTitle(), pictures);
  });
  connect(&strip_, &StripWriter::writing, close_button_,
          [this] { close_button_->setEnabled(false); });
  const auto succeed = [this] {
    emit exported(file_->text());
    accept();
  };
  const auto fail = [this](const QString& message) {
    show_busy(false);
    show_problem(message);
  };
  connect(&recorder_, &FilmRecorder::finished, this, succeed);
  connect(&strip_, &StripWriter::written, this, succeed);
  connect(&recorder_, &FilmRecorder::failed, this, fail);
  connect(&strip_, &StripWriter::failed, this, fail);
}

void PicturesDialog::cancel() {
  recorder_.cancel();
  strip_.cancel();
  show_busy(false);
  note_->setText(tr("Cancelled; nothing was written."));
}

QFormLayout* PicturesDialog::make_settings() {
  kinds_->addItem(tr("Film strip: pictures side by side"), static_cast<int>(Kind::kStrip));
  kinds_->addItem(tr("Frames: a folder of numbered PNG files"), static_cast<int>(Kind::kFrames));
  kinds_->addItem(tr("Film: MP4"), static_cast<int>(Kind::kFilm));
  kinds_->addItem(tr("Animation: GIF"), static_cast<int>(Kind::kAnimation));
  if (FfmpegFilm::program().isEmpty()) {
    auto* model = qobject_cast<QStandardItemModel*>(kinds_->model());
    for (const Kind kind : {Kind::kFilm, Kind::kAnimation}) {
      QStandardItem* item = model->item(kinds_->findData(static_cast<int>(kind)));
      item->setEnabled(false);
      item->setText(tr("%1 (needs ffmpeg)").arg(item->text()));
    }
  }
  pictures_->setRange(2, kMostStripPictures);
  pictures_->setValue(kStripPictures);
  for (const QSize& size : {QSize(640, 360), QSize(1280, 720), QSize(1920, 1080)}) {
    sizes_->addItem(QStringLiteral("%1 × %2").arg(size.width()).arg(size.height()), size);
  }
  sizes_->setCurrentIndex(1);
  for (const int rate : {10, 15, 25, 30, 60}) {
    rates_->addItem(tr("%1 frames per second").arg(rate), rate);
  }
  rates_->setCurrentIndex(rates_->findData(25));
  offer_speeds(*speeds_);
  speeds_->setToolTip(tr("Speed of the film; 1× is real time"));
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(12);
  form->setVerticalSpacing(8);
  form->addRow(tr("What"), kinds_);
  form->addRow(tr("Pictures"), pictures_);
  form->addRow(tr("Size"), sizes_);
  form->addRow(tr("Rate"), rates_);
  form->addRow(tr("Speed"), speeds_);
  form->addRow(QString(), count_);
  return form;
}

QWidget* PicturesDialog::make_destination() {
  file_->setAccessibleName(tr("File"));
  export_button_->setProperty("role", "primary");
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  note_->setTextFormat(Qt::RichText);
  note_->setWordWrap(true);
  auto* browse = new QPushButton(tr("Browse…"));
  connect(browse, &QPushButton::clicked, this, &PicturesDialog::browse);
  return boxed(in_column({in_row({{file_, 1}, browse}), note_, progress_,
                          in_row({room(), close_button_, export_button_})},
                         10));
}

PicturesDialog::Kind PicturesDialog::kind() const {
  return static_cast<Kind>(kinds_->currentData().toInt());
}

void PicturesDialog::choose(Kind kind) {
  kinds_->setCurrentIndex(kinds_->findData(static_cast<int>(kind)));
}

void PicturesDialog::set_file(const QString& file) { file_->setText(file); }

QString PicturesDialog::suffix() const {
  switch (kind()) {
    case Kind::kStrip:
      return file_->text().endsWith(QStringLiteral(".svg")) ? QStringLiteral("svg")
                                                            : QStringLiteral("png");
    case Kind::kFilm:
      return QStringLiteral("mp4");
    case Kind::kAnimation:
      return QStringLiteral("gif");
    case Kind::kFrames:
      break;
  }
  return {};
}

QSize PicturesDialog::size() const { return sizes_->currentData().toSize(); }

FilmShot PicturesDialog::shot() const {
  if (kind() == Kind::kStrip) {
    return {film_, camera_, kStripScale * kStripFrame, pictures_->value(), kFineStrips};
  }
  const double seconds = film_.seconds / speeds_->currentData().toDouble();
  const int pictures = static_cast<int>(std::ceil(seconds * rates_->currentData().toInt())) + 1;
  return {film_, camera_, size(), std::max(pictures, 2), 1};
}

void PicturesDialog::take_kind() {
  const bool strip = kind() == Kind::kStrip;
  pictures_->setEnabled(strip);
  for (QComboBox* box : {sizes_, rates_, speeds_}) {
    box->setEnabled(!strip);
  }
  const QFileInfo old(file_->text());
  const QString bare = old.absoluteDir().filePath(old.completeBaseName());
  file_->setText(suffix().isEmpty() ? bare : bare + QLatin1Char('.') + suffix());
  note_->setText(FfmpegFilm::program().isEmpty()
                     ? tr("Films and animations need ffmpeg, which is not installed. On Debian and "
                          "Ubuntu: apt install ffmpeg")
                     : QString());
  show_count();
}

void PicturesDialog::show_count() {
  count_->setText(kind() == Kind::kStrip
                      ? tr("Like the present view, on white; PNG or SVG by the file's name")
                      : tr("%1 pictures like the present view, on white").arg(shot().pictures));
}

void PicturesDialog::browse() {
  const QString filter = suffix().isEmpty() ? QString()
                         : kind() == Kind::kStrip
                             ? tr("Picture (*.png);;Drawing (*.svg)")
                             : QStringLiteral("%1 (*.%2)").arg(suffix().toUpper(), suffix());
  const QString file = ask_where_to_save(this, windowTitle(), file_->text(), filter);
  if (!file.isEmpty()) {
    file_->setText(file);
  }
}

void PicturesDialog::begin() {
  try {
    const FilmShot wanted = shot();
    std::unique_ptr<FilmSink> sink;
    if (kind() == Kind::kFrames) {
      sink = std::make_unique<FrameFolder>(file_->text());
    } else if (kind() != Kind::kStrip) {
      sink = std::make_unique<FfmpegFilm>(file_->text(), wanted.size,
                                          rates_->currentData().toDouble());
    }
    note_->setText(tr("Taking pictures…"));
    show_busy(true);
    recorder_.start(wanted, std::move(sink));
  } catch (const std::exception& error) {
    show_problem(QString::fromUtf8(error.what()));
  }
}

void PicturesDialog::show_busy(bool busy) {
  progress_->setVisible(busy);
  progress_->setValue(0);
  export_button_->setEnabled(!busy);
  kinds_->setEnabled(!busy);
  file_->setEnabled(!busy);
  close_button_->setEnabled(true);
  close_button_->setText(busy ? tr("Cancel") : tr("Close"));
}

void PicturesDialog::show_problem(const QString& message) {
  note_->setText(colored(message, colors_of(current_theme()).bad));
}

}  // namespace handway::gui
