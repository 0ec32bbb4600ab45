#include "features/glove/record_bar.h"

#include "handway/geometric/io/input_error.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QStandardPaths>
#include <QString>

#include <exception>

namespace handway::gui {

std::filesystem::path new_recording_file(const std::filesystem::path& folder) {
  const QString stem = QDir(QString::fromStdString(folder.string()))
                           .filePath(QDateTime::currentDateTime().toString(
                               QStringLiteral("'glove-'yyyyMMdd-HHmmss")));
  QFile file(stem + QStringLiteral(".csv"));
  for (int i = 2; !file.open(QIODevice::WriteOnly | QIODevice::NewOnly); ++i) {
    if (!file.exists()) {
      throw geometric::InputError({file.fileName().toStdString(), "",
                                   file.errorString().toStdString(), "a file that can be written",
                                   "Check whether the disk is full or the folder is read-only"});
    }
    file.setFileName(QStringLiteral("%1-%2.csv").arg(stem, QString::number(i)));
  }
  return file.fileName().toStdString();
}

namespace {

using device::StreamState;

constexpr int kTickMs = 250;
constexpr int kSecondsAMinute = 60;

QString clock_text(double seconds) {
  const int whole = static_cast<int>(seconds);
  return QStringLiteral("%1:%2")
      .arg(whole / kSecondsAMinute)
      .arg(whole % kSecondsAMinute, 2, 10, QLatin1Char('0'));
}

}  // namespace

RecordBar::RecordBar(GloveSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      button_(named("record", new QPushButton)),
      progress_(named("record_progress", note())) {
  progress_->setTextFormat(Qt::RichText);
  progress_->setWordWrap(true);
  lay_out(*this, in_row({button_, {progress_, 1}}, 10));
  ticker_.setInterval(kTickMs);
  connect(button_, &QPushButton::clicked, this, &RecordBar::toggle);
  connect(&ticker_, &QTimer::timeout, this, &RecordBar::show_progress);
  connect(&session_, &GloveSession::state_changed, this, [this](StreamState state) {
    const bool live = state == StreamState::kStreaming;
    button_->setEnabled(live || session_.link().tap().is_on());
    if ((state == StreamState::kStopped || state == StreamState::kFailed) &&
        session_.link().tap().is_on()) {
      finish();
    }
  });
  show_idle();
}

std::filesystem::path RecordBar::unnamed_folder() {
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  return std::filesystem::path(data.toStdString()) / "recordings";
}

void RecordBar::toggle() {
  if (session_.link().tap().is_on()) {
    finish();
  } else {
    begin();
  }
}

void RecordBar::begin() {
  const device::GloveInfo info = session_.link().info();
  device::RecordingHeader header = device::recording_header(info);
  header.date = QDateTime::currentDateTime().toString(Qt::ISODate).toStdString();
  header.origin = (info.right_hand ? "right hand, " : "left hand, ") + info.device;
  try {
    std::filesystem::create_directories(unnamed_folder());
    file_ = new_recording_file(unnamed_folder());
    session_.link().tap().begin(file_, std::move(header), info.raw);
  } catch (const std::exception& error) {
    progress_->setText(QString::fromUtf8(error.what()).toHtmlEscaped());
    return;
  }
  button_->setText(tr("Stop"));
  refresh_icon();
  ticker_.start();
  show_progress();
}

void RecordBar::finish() {
  session_.link().tap().end();
  show_idle();
  if (session_.link().tap().rows() == 0) {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    progress_->setText(tr("No data arrived: nothing was recorded"));
    return;
  }
  progress_->setText(tr("%1 rows kept as %2")
                         .arg(session_.link().tap().rows())
                         .arg(QString::fromStdString(file_.filename().string()).toHtmlEscaped()));
  progress_->setToolTip(QString::fromStdString(file_.string()));
  ask_for_name();
}

void RecordBar::ask_for_name() {
  auto* dialog = named(
      "record_name", new QFileDialog(this, tr("Save the recording"), {}, tr("Recordings (*.csv)")));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("csv"));
  dialog->selectFile(QString::fromStdString(file_.filename().string()));
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& name) {
    try {
      keep_as(name.toStdString());
    } catch (const std::exception& error) {
      progress_->setText(
          tr("Still in %1: %2")
              .arg(QString::fromStdString(file_.string()), QString::fromUtf8(error.what()))
              .toHtmlEscaped());
    }
  });
  connect(dialog, &QFileDialog::rejected, this,
          [this] { emit recorded(QString::fromStdString(file_.string())); });
  dialog->open();
}

void RecordBar::keep_as(const std::filesystem::path& file) {
  std::error_code other_disk;
  std::filesystem::rename(file_, file, other_disk);
  if (other_disk) {
    std::filesystem::path part = file;  // whole, or not at all
    part += ".part";
    std::filesystem::copy_file(file_, part, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::rename(part, file);
    std::filesystem::remove(file_);
  }
  file_ = file;
  progress_->setText(tr("%1 rows saved as %2")
                         .arg(session_.link().tap().rows())
                         .arg(QString::fromStdString(file.filename().string()).toHtmlEscaped()));
  progress_->setToolTip(QString::fromStdString(file.string()));
  emit recorded(QString::fromStdString(file.string()));
}

void RecordBar::show_progress() {
  const RecordingTap& tap = session_.link().tap();
  if (!tap.error().empty()) {
    const QString error = QString::fromStdString(tap.error());
    finish();
    progress_->setText(error.toHtmlEscaped());
    return;
  }
  progress_->setText(tr("<b>%1</b>, %2 rows").arg(clock_text(tap.duration())).arg(tap.rows()));
}

void RecordBar::show_idle() {
  ticker_.stop();
  button_->setText(tr("Record"));
  refresh_icon();
  button_->setToolTip(tr("Record the glove to a file; you choose its name when you stop"));
  button_->setEnabled(session_.link().state() == StreamState::kStreaming);
}

void RecordBar::refresh_icon() {
  button_->setIcon(session_.link().tap().is_on() ? icon("stop")
                                                 : icon("record", colors_of(current_theme()).bad));
}

}  // namespace handway::gui
