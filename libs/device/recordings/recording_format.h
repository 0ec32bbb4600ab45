#pragma once

#include "handway/device/glove/recording.h"
#include "handway/device/recordings/recording_contents.h"
#include "recordings/recording_file.h"

#include <memory>
#include <vector>

namespace handway::device {

class ArrayFile;

/// A kind of recording file and its reader.
class RecordingFormat {
 public:
  virtual ~RecordingFormat() = default;

  [[nodiscard]] virtual RecordingKindOfFile kind() const = 0;
  /// Returns whether a file is of this kind, by its name, its head or its first line. Formats are
  /// asked in the order of recording_formats().
  [[nodiscard]] virtual bool recognises(const RecordingFile& file) const = 0;
  /// Returns whether files of this kind have variables. Such a kind is recognised without text().
  [[nodiscard]] virtual bool has_variables() const { return false; }
  /// Opens the variables of a file; nullptr for a format without variables.
  /// @throws InputError if the file is damaged.
  [[nodiscard]] virtual std::unique_ptr<ArrayFile> open(const RecordingFile& file) const;
  /// @throws InputError with file and element if the file is not a recording of a glove.
  [[nodiscard]] virtual Recording read(const RecordingFile& file) const = 0;
};

}  // namespace handway::device
