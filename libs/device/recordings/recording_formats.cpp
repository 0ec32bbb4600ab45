#include "recordings/recording_formats.h"

#include "handway/geometric/io/input_error.h"
#include "recordings/array_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

namespace handway::device {

std::unique_ptr<ArrayFile> RecordingFormat::open(const RecordingFile& /*file*/) const {
  return nullptr;
}

const std::vector<const RecordingFormat*>& recording_formats() {
  static const std::vector<const RecordingFormat*> kFormats{
      &lerobot_format(),
      &pickle_format(),
      &joint_message_format(),
      &table_map_format(),
      &matlab_format(),
      &numpy_format(),
      &hdf5_format(),
      &ros1_bag_format(),
      &ros_bag_format(),
      &hand_message_format(),
      &landmark_document_format(),
      &landmark_line_format(),
      &handway_recording_format(),
      &virtual_hand_log_format(),
      &text_table_format(),
  };
  return kFormats;
}

const RecordingFormat& format_of(const RecordingFile& file) {
  const std::vector<const RecordingFormat*>& formats = recording_formats();
  return **std::ranges::find_if(
      formats.begin(), formats.end() - 1,
      [&](const RecordingFormat* format) { return format->recognises(file); });
}

std::unique_ptr<ArrayFile> open_arrays(const RecordingFile& file) {
  for (const RecordingFormat* format : recording_formats()) {
    if (format->has_variables() && format->recognises(file)) {
      return format->open(file);
    }
  }
  return nullptr;
}

Recording read_recording(const std::filesystem::path& given) {
  const RecordingFile file(given);
  const RecordingFormat& format = format_of(file);
  if (!file.variable().empty() && !format.has_variables()) {
    throw geometric::InputError({file.path().string(), "variable " + file.variable(),
                                 "a file with one table", "a file with several variables",
                                 "Leave out the name behind the #."});
  }
  return format.read(file);
}

std::string to_string(const RecordingVariable& variable) {
  return fmt::format("{} ({})", variable.name, fmt::join(variable.shape, " x "));
}

std::vector<RecordingKindOfFile> recording_kinds_of_file() {
  std::vector<RecordingKindOfFile> kinds;
  for (const RecordingFormat* format : recording_formats()) {
    kinds.push_back(format->kind());
  }
  return kinds;
}

RecordingContents recording_contents(const std::filesystem::path& given) {
  const RecordingFile file(given);
  const RecordingFormat& format = format_of(file);
  const std::unique_ptr<ArrayFile> arrays = format.open(file);
  return {format.kind(), arrays ? arrays->variables() : std::vector<RecordingVariable>{}};
}

bool is_recording(const std::filesystem::path& file) {
  return &format_of(RecordingFile(file)) != recording_formats().back();
}

}  // namespace handway::device
