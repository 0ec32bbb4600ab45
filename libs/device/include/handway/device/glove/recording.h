#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/raw_columns.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Recordings of a glove, and their files.
///
/// A recording file is CSV: lines that begin with `#` describe it, then a header and a row for
/// every frame:
///
///     # handway glove recording 1
///     # kind: counts
///     # device: CyberGlove II, serial 1234
///     # date: 2026-03-01T12:00:00
///     # origin: right hand of a person, free motion
///     time,ThumbRotate,ThumbMPJ,…
///     0,146,121,…
///     0.01,146,122,…
///
/// `kind` is `counts` (raw, 0 … 255) or `angles` (rad, flexion and spreading positive); `time` is
/// in seconds; the other columns are sensors by name (see cyberglove_sensors()), and after them the
/// columns of the source from which the values were derived: `raw:NAME [UNIT]`. Their cells may be
/// empty.

namespace handway::device {

/// Kind of the values of a recording.
enum class RecordingKind {
  kCounts,  ///< Raw counts of the glove: 1 … 255; 0 for missing sensors.
  kAngles,  ///< rad after calibration, flexion and spreading positive.
};

/// "counts" or "angles".
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string to_string(RecordingKind kind);

/// Header of a recording. Texts are single lines.
struct RecordingHeader {
  RecordingKind kind = RecordingKind::kCounts;
  std::string device;     ///< "CyberGlove II, serial 1234"; may be empty.
  std::string date;       ///< Start, ISO 8601; may be empty.
  std::string origin;     ///< Origin: person, generator and seed, file.
  SensorIndices sensors;  ///< Column i is cyberglove_sensors()[sensors[i]].
};

/// A recording in memory: one frame a row, in order of time.
struct Recording {
  RecordingHeader header;
  Eigen::VectorXd times;              ///< s, never falling, shape [rows].
  Eigen::MatrixXd values;             ///< Counts or rad, finite, shape [rows, sensors].
  std::vector<std::string> warnings;  ///< Warnings of the reader about lines left out or guessed.
  std::optional<HandBones> bones = std::nullopt;  ///< The person's, if landmarks were measured.
  /// Columns of the source, a row for each of `values`, if these were derived from others.
  std::optional<RawColumns> raw = std::nullopt;
};

/// Header of a recording of the glove's counts or angles: kind, device and sensors.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RecordingHeader recording_header(const GloveInfo& info);

/// Column of the sensor (index into cyberglove_sensors()), or -1.
[[nodiscard]] HANDWAY_DEVICE_EXPORT int column_of(const RecordingHeader& header, int sensor);

/// The angles of a row; NaN for sensors that the recording doesn't have.
/// @throws geometric::InputError if it holds counts.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveAngles angles_of_row(const Recording& recording,
                                                              Eigen::Index row);

/// Reads a recording. The content, not the name, decides the kind of file:
///   - a recording of Handway as above. A last line without its end, as a killed program leaves
///     it, is left out with a warning;
///   - other CSV (separated by commas, semicolons or tabs) with a header of `time` (s) and
///     names or letters of sensors; whole numbers from 0 to 255 are counts, else angles in rad;
///   - JSON lines of 21 landmarks of a hand in m, in MediaPipe's order: {"time": s, "hand":
///     "right" or "left", "landmarks": [[x, y, z], …]}, points as {"x", "y", "z"} too. The
///     recording holds the angles between them (see glove_angles()); a left hand is mirrored, and
///     if both are there, the hand of the first row is taken;
///   - JSON lines with the joints of OpenXR, frames of Rokoko Studio or ergonomics of Manus Core,
///   as
///     they are sent (see hand_message.h), each with its time;
///   - text rows of a VirtualHand log: year month day hour minute second switch, then 23 angles
///     in rad in the order of its slots, with its signs (flexion negative; they are converted);
///   - tables of such angles without times: rows of 23, or of 22 (all but the wrist's abduction)
///   and a
///     label, with or without a header;
///   - MATLAB files (version 5 and 7.3) with "angles" (degrees) or "glove" (counts) of 18 or 22
///     columns in the order of a CyberGlove's records, as Ninapro's;
///   - a variable of a file with several, behind a `#`: arrays of NumPy and HDF5, episodes of
///     LeRobot data sets and other tables in Parquet, topics of ROS 2 bags in SQLite or MCAP (see
///     recording_contents());
///   - any table of numbers, text or MATLAB, by a YAML map of its columns, which names it:
///
///         table: postures.csv        # from this file's folder; lines end in CR, LF or both
///         variable: q                # of a MATLAB file
///         separator: ","             # ",", ";", tab or blank; found if left out
///         skip: 2                    # lines before the table
///         unit: deg                  # rad (default), deg or counts
///         signs: negative            # flexion and spreading; positive (default), virtual_hand
///         time: {column: 1, gain: 0.001}   # in s; or, without times,
///         rate: 60                   # rows a second (default 1)
///         columns:                   # by number from 1, or by name if there is a header
///           IndexMPJ: 3
///           ThumbRotate: {column: TR, gain: -1, offset: 12}
///
/// @throws geometric::InputError with file and line for a file of another kind, without rows, with
/// an unknown sensor or one twice, a row of the wrong length, or a value that is no number or out
/// of range.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording read_recording(const std::filesystem::path& file);

/// Replaces the file whole; the same recording gives the same bytes.
/// @throws geometric::InputError if the file can't be written.
/// @throws std::invalid_argument if the shapes don't agree or a value isn't finite.
HANDWAY_DEVICE_EXPORT void write_recording(const Recording& recording,
                                           const std::filesystem::path& file);

/// Writes a recording during the measurement. Every row is passed to the system whole
/// before append() returns: a killed program loses no appended row. For one thread at a
/// time.
class HANDWAY_DEVICE_EXPORT RecordingWriter {
 public:
  /// Replaces the file.
  /// @throws geometric::InputError if it can't be written.
  /// @throws std::invalid_argument for an unknown sensor, or one twice.
  /// @param raw names and units of the source's columns, whose values are appended, too.
  RecordingWriter(const std::filesystem::path& file, RecordingHeader header, RawColumns raw = {});

  /// @param time s since the recording began, not below that of the previous row.
  /// @param values counts or rad, finite, shape [sensors].
  /// @throws geometric::InputError if the row can't be written (a full disk).
  /// @throws std::invalid_argument if the shape differs, a value isn't finite or time
  /// runs backwards.
  /// @param raw the source's columns; empty, or of another number than the columns: missing.
  void append(double time, std::span<const double> values, std::span<const double> raw = {});
  /// The header's sensors of a frame: its counts or its angles, by the header's kind.
  /// @throws std::invalid_argument if the header's kind is kAngles and the frame has none.
  void append(const GloveFrame& frame);
  /// The header's sensors of a frame. @pre the header's kind is kAngles.
  void append(const GloveAngles& angles);

  [[nodiscard]] std::size_t rows() const { return rows_; }

 private:
  // An open file, closed with the object.
  class Descriptor {
   public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&&) = delete;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }

   private:
    int number_;
  };

  void write(std::string_view text) const;

  std::filesystem::path file_;
  RecordingHeader header_;
  RawColumns raw_;
  Descriptor descriptor_;
  double last_time_ = 0.0;
  std::size_t rows_ = 0;
};

}  // namespace handway::device
