#pragma once

#include "handway/device/glove/raw_columns.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway/geometric/io/table_times.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Files with several arrays of numbers.

namespace handway::device {

/// Most numbers of an array that are read: 1 GB.
inline constexpr std::size_t kMostNumbers = std::size_t{1} << 27;

/// Rows of an array, with their times and the names of its columns if the file has them.
struct Series {
  RecordingVariable variable;
  Eigen::MatrixXd values;              ///< Further dimensions in one row; NaN: missing.
  std::vector<std::string> names;      ///< Names of the columns; may be empty.
  std::vector<double> times;           ///< Times of the rows as in the file; may be empty.
  geometric::TimeUnit time_unit = {};  ///< The named one.
  std::vector<std::string> warnings = {};
};

/// Returns whether an array of this shape is made of the landmarks of a hand: n x 21 x 3, with
/// dimensions of 1 in between, or n x 63.
[[nodiscard]] bool has_landmarks(const RecordingVariable& variable);

/// The product of all dimensions but the first; 1 for an array of one dimension.
[[nodiscard]] std::size_t columns_of(const RecordingVariable& variable);

/// An open file with several arrays.
class ArrayFile {
 public:
  explicit ArrayFile(std::filesystem::path path) : path_(std::move(path)) {}
  virtual ~ArrayFile() = default;
  ArrayFile(const ArrayFile&) = delete;
  ArrayFile& operator=(const ArrayFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::vector<RecordingVariable>& variables() const { return variables_; }
  /// @param name of a variable; columns of it, counted from 0, as "qpos[0:7]".
  /// @throws InputError if there is no such variable, or it can't be read.
  [[nodiscard]] Series series(std::string_view name) const;
  /// Returns the names of a variable's columns, if the file has them.
  /// @throws InputError if they are damaged.
  [[nodiscard]] virtual std::vector<std::string> column_names(
      const RecordingVariable& variable) const = 0;
  /// Returns the numbers from which a variable was derived: an array "raw" beside it, of as many
  /// rows, whose columns have names.
  [[nodiscard]] std::optional<RawColumns> raw_columns(const RecordingVariable& variable) const;
  /// Names and sizes of all variables, for messages.
  [[nodiscard]] std::string listed() const;

 protected:
  std::vector<RecordingVariable> variables_;

 private:
  /// Reads values, times and warnings.
  /// @pre the variable is one of variables() without a problem.
  [[nodiscard]] virtual Series read(const RecordingVariable& variable) const = 0;

  std::filesystem::path path_;
};

/// A file whose times and names of columns are arrays of their own, beside the others.
class NamedArrays : public ArrayFile {
 public:
  using ArrayFile::ArrayFile;

  [[nodiscard]] std::vector<std::string> column_names(
      const RecordingVariable& variable) const final;

 private:
  [[nodiscard]] Series read(const RecordingVariable& variable) const final;
  [[nodiscard]] const RecordingVariable* times_of(const RecordingVariable& variable) const;

  /// The numbers of an array, shape [rows, columns_of(variable)].
  [[nodiscard]] virtual Eigen::MatrixXd numbers(const RecordingVariable& variable) const = 0;
  /// The texts of an array of type kText.
  [[nodiscard]] virtual std::vector<std::string> words(const RecordingVariable& variable) const;
};

/// Returns the name of the only one of some variables, or of the one that all others are parts of
/// ("state" of "episode_0/state" and "episode_1/state").
/// @param expected what is looked for. @param advice how to choose, with the name of one as
/// example.
/// @throws InputError with both, and the variables of the file, if there are none or several.
[[nodiscard]] std::string only_variable(
    const ArrayFile& arrays, const std::vector<RecordingVariable>& fitting,
    const std::string& expected, const std::function<std::string(const std::string&)>& advice);

/// Leaves out arrays "raw", from which others were derived, if there are others.
[[nodiscard]] std::vector<RecordingVariable> without_raw(std::vector<RecordingVariable> variables);

/// The type of variables that contain text.
inline constexpr const char* kText = "text";

}  // namespace handway::device
