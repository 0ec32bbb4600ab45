#include "handway/geometric/formats/numpy_array.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/array_recording.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace handway::device {
namespace {

using geometric::InputError;
using geometric::is_numpy;
using geometric::kNumpyPreamble;
using geometric::numpy_header_bytes;
using geometric::NumpyHeader;
using geometric::parse_numpy_header;

/// Reads at most that many of the next bytes; fewer at the end.
/// @throws InputError if they are damaged.
using ByteSource = std::function<std::string(std::size_t)>;

/// An array's header, from the beginning of its file.
NumpyHeader read_numpy_header(const ByteSource& next, const std::string& source) {
  std::string head = next(kNumpyPreamble);
  const std::size_t size = numpy_header_bytes(head, source);
  if (size > head.size()) {
    head += next(size - head.size());
  }
  return parse_numpy_header(head, source);
}

/// The elements behind the header. @throws InputError if some are missing.
std::string read_elements(const ByteSource& next, const NumpyHeader& header,
                          const std::string& source) {
  std::string elements = next(header.bytes());
  if (elements.size() < header.bytes()) {
    throw InputError({source, "", fmt::format("{} bytes of elements", elements.size()),
                      fmt::format("{} by the shape in the header", header.bytes()),
                      "The file is cut off: copy it again."});
  }
  return elements;
}

/// Reads in pieces: memory is taken only for bytes that are there.
template <typename Read>
std::string read_pieces(std::size_t size, const Read& read) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::string bytes;
  while (bytes.size() < size) {
    const std::size_t before = bytes.size();
    const std::size_t piece = std::min(kPiece, size - before);
    bytes.resize(before + piece);
    const std::size_t got = read(bytes.data() + before, piece);
    bytes.resize(before + got);
    if (got == 0) {
      break;
    }
  }
  return bytes;
}

/// Arrays whose headers are known and whose elements are read on demand.
class NumpyArrays : public NamedArrays {
 public:
  using NamedArrays::NamedArrays;

 protected:
  void add(const std::string& name, NumpyHeader header) {
    variables_.push_back({name, header.shape, header.type_name(), header.problem});
    headers_.emplace(name, std::move(header));
  }

 private:
  /// A source at the beginning of an array.
  [[nodiscard]] virtual ByteSource open(const std::string& name) const = 0;

  [[nodiscard]] std::string elements_of(const std::string& name) const {
    const std::string source = fmt::format("{}, array {}", path().string(), name);
    const ByteSource next = open(name);
    return read_elements(next, read_numpy_header(next, source), source);
  }
  [[nodiscard]] Eigen::MatrixXd numbers(const RecordingVariable& variable) const final {
    return numpy_numbers(headers_.at(variable.name), elements_of(variable.name));
  }
  [[nodiscard]] std::vector<std::string> words(const RecordingVariable& variable) const final {
    return numpy_words(headers_.at(variable.name), elements_of(variable.name));
  }

  std::map<std::string, NumpyHeader> headers_;
};

/// A file with one array, which has no name.
class SingleArray final : public NumpyArrays {
 public:
  explicit SingleArray(const std::filesystem::path& file) : NumpyArrays(file) {
    const ByteSource next = open("array");
    add("array", read_numpy_header(next, file.string()));
  }

 private:
  [[nodiscard]] ByteSource open(const std::string& /*name*/) const override {
    auto stream = std::make_shared<std::ifstream>(path(), std::ios::binary);
    return [stream](std::size_t size) {
      return read_pieces(size, [&](char* to, std::size_t piece) {
        stream->read(to, static_cast<std::streamsize>(piece));
        return static_cast<std::size_t>(stream->gcount());
      });
    };
  }
};

/// Arrays in a ZIP archive, each as a file NAME.npy.
class ArchivedArrays final : public NumpyArrays {
 public:
  explicit ArchivedArrays(const std::filesystem::path& file)
      : NumpyArrays(file), archive_(zip_open(file.c_str(), ZIP_RDONLY, nullptr), zip_discard) {
    if (!archive_) {
      throw InputError({file.string(), "", "a damaged ZIP archive", "arrays of NumPy (.npz)",
                        "Save them again by numpy.savez()."});
    }
    const zip_int64_t count = std::min<zip_int64_t>(zip_get_num_entries(archive_.get(), 0), kMost);
    for (zip_int64_t i = 0; i < count; ++i) {
      const char* entry = zip_get_name(archive_.get(), static_cast<zip_uint64_t>(i), 0);
      const std::string name = entry == nullptr ? "" : entry;
      if (name.ends_with(kEnding) && indices_.count(name) == 0) {
        add_entry(name.substr(0, name.size() - kEnding.size()), static_cast<zip_uint64_t>(i));
      }
    }
  }

 private:
  static constexpr std::string_view kEnding = ".npy";
  static constexpr zip_int64_t kMost = 10000;

  void add_entry(const std::string& name, zip_uint64_t index) {
    indices_[name] = index;
    add(name, read_numpy_header(open(name), fmt::format("{}, array {}", path().string(), name)));
  }

  [[nodiscard]] ByteSource open(const std::string& name) const override {
    const std::string source = fmt::format("{}, array {}", path().string(), name);
    const std::shared_ptr<zip_file_t> entry(zip_fopen_index(archive_.get(), indices_.at(name), 0),
                                            [](zip_file_t* opened) {
                                              if (opened != nullptr) {
                                                zip_fclose(opened);
                                              }
                                            });
    if (!entry) {
      refuse(source);
    }
    return [entry, source](std::size_t size) {
      return read_pieces(size, [&](char* to, std::size_t piece) {
        const zip_int64_t got = zip_fread(entry.get(), to, piece);
        if (got < 0) {
          refuse(source);
        }
        return static_cast<std::size_t>(got);
      });
    };
  }

  [[noreturn]] static void refuse(const std::string& source) {
    throw InputError({source, "", "an entry of the archive that is damaged or encrypted",
                      "an array", "Save the arrays again by numpy.savez()."});
  }

  std::unique_ptr<zip_t, void (*)(zip_t*)> archive_;
  std::map<std::string, zip_uint64_t> indices_;
};

class NumpyFiles final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"NumPy", "Arrays of NumPy, one (.npy) or several with names (.npz)."};
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    return is_numpy(file.head()) || is_archive(file);
  }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    if (is_archive(file)) {
      return std::make_unique<ArchivedArrays>(file.path());
    }
    return std::make_unique<SingleArray>(file.path());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_array_recording(*open(file), file.variable());
  }

 private:
  static bool is_archive(const RecordingFile& file) {
    return file.head().starts_with("PK\x03\x04") &&
           (geometric::has_extension(file.path(), ".npz") ||
            file.head().find(".npy") != std::string::npos);
  }
};

}  // namespace

const RecordingFormat& numpy_format() {
  static const NumpyFiles kFormat;
  return kFormat;
}

}  // namespace handway::device
