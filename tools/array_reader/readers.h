#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

/// Readers of files with arrays, by libraries that damaged files may crash.

namespace handway::array_reader {

/// Most numbers of an array: 1 GB.
inline constexpr std::size_t kMostNumbers = std::size_t{1} << 27;

/// Refusal of a file or an array, with fields of geometric::InputProblem.
class Refusal : public std::runtime_error {
 public:
  explicit Refusal(const std::string& found, std::string expected = "", std::string advice = "")
      : std::runtime_error(found), expected_(std::move(expected)), advice_(std::move(advice)) {}

  [[nodiscard]] const std::string& expected() const { return expected_; }
  [[nodiscard]] const std::string& advice() const { return advice_; }

 private:
  std::string expected_;
  std::string advice_;
};

/// An array without its elements.
struct ArrayInfo {
  std::string name;
  std::vector<std::size_t> shape;
  std::string type;     ///< "float64", "text", …
  std::string problem;  ///< Reason why it can't be read; empty if it can.
};

/// Elements of an array: numbers or words.
struct Elements {
  std::size_t rows = 1;
  std::size_t columns = 1;
  bool by_column = false;       ///< The first index of `numbers` runs fastest.
  std::vector<double> numbers;  ///< Shape [rows, columns].
  std::vector<std::string> words;
  bool are_words = false;
};

/// Reader of a format. All functions throw Refusal for damaged files.
struct Reader {
  std::vector<ArrayInfo> (*list)(const std::string& file);
  /// @param info one of list() without a problem.
  Elements (*read)(const std::string& file, const ArrayInfo& info);
};

[[nodiscard]] const Reader& hdf5_reader();
[[nodiscard]] const Reader& matlab_reader();

}  // namespace handway::array_reader
