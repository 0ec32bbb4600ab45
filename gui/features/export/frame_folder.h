#pragma once

#include "features/export/film_sink.h"

#include <QImage>
#include <QString>

#include <memory>

namespace handway::gui {

/// Writes numbered PNG files into a new folder. They are made in the background, in a folder beside
/// that takes the new name when all are there; if they are not wanted any more, or one can't be
/// written, nothing of them stays.
class FrameFolder : public FilmSink {
  Q_OBJECT

 public:
  static constexpr int kMostWaiting = 4;  ///< Pictures.

  /// @throws geometric::InputError if the folder is there already, or can't be made.
  explicit FrameFolder(const QString& folder);
  ~FrameFolder() override;

  [[nodiscard]] bool has_room() const override { return waiting_ < kMostWaiting; }
  void add(const QImage& picture) override;
  void finish() override;

 private:
  class Parts;

  void take_written(const QString& fault);
  void end();

  QString folder_;
  std::shared_ptr<Parts> parts_;  ///< Shared with those that write to it.
  int count_ = 0;
  int waiting_ = 0;
  bool complete_ = false;  ///< No more are to come.
  bool failed_ = false;
};

}  // namespace handway::gui
