#pragma once

#include "model/devices/glove_session.h"

#include <QTimer>
#include <QWidget>

#include <filesystem>

class QLabel;
class QPushButton;

namespace handway::gui {

/// A new, empty file in `folder`, named by the time. Nothing else gets it: another window that
/// begins to record in the same second has a file of its own.
/// @throws handway::geometric::InputError if none can be made.
[[nodiscard]] std::filesystem::path new_recording_file(const std::filesystem::path& folder);

/// Records what comes from the glove. Rows go to a file in the user's data folder as they come;
/// when the recording is stopped it is moved to where the person wants it, or stays there.
class RecordBar : public QWidget {
  Q_OBJECT

 public:
  explicit RecordBar(GloveSession& session, QWidget* parent = nullptr);

  /// Returns the folder of recordings that have no name yet.
  [[nodiscard]] static std::filesystem::path unnamed_folder();

  void begin();
  /// Ends the recording and asks for its name.
  void finish();
  /// Gives the last recording a name. @throws std::filesystem::filesystem_error
  void keep_as(const std::filesystem::path& file);
  void refresh_icon();
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 signals:
  void recorded(const QString& file);

 private:
  void toggle();
  void ask_for_name();
  void show_progress();
  void show_idle();

  GloveSession& session_;
  QPushButton* button_;
  QLabel* progress_;
  QTimer ticker_;
  std::filesystem::path file_;
};

}  // namespace handway::gui
