#include "features/export/strip_writer.h"

#include "widgets/plots/strip_figure.h"

#include <exception>

namespace handway::gui {

void StripWriter::start(const QString& file, const QString& title,
                        const std::vector<QImage>& pictures) {
  busy_ = true;
  writing_ = false;
  job_.run([this, file, title, pictures](const std::stop_token&) -> LatestJob::Answer {
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
  job_.run([this, file, bytes](const std::stop_token&) -> LatestJob::Answer {
    QString fault;
    try {
      write_bytes(file, bytes);
    } catch (const std::exception& error) {
      fault = QString::fromUtf8(error.what());
    }
    return [this, fault] {
      busy_ = false;
      writing_ = false;
      if (fault.isEmpty()) {
        emit written();
      } else {
        emit failed(fault);
      }
    };
  });
}

}  // namespace handway::gui
