#include "readers.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

namespace handway::array_reader {
namespace {

constexpr std::size_t kMostArrays = 100000;
constexpr int kMostSides = 32;
/// Deflate compresses by a factor of 1032 at most; sets of data without any content are refused.
constexpr std::size_t kLargestRatio = 1100;

/// An identifier of the library with its closing function.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) {
      close_(id_);
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle open_file(const std::string& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return {H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
}

void need(bool valid, const char* what) {
  if (!valid) {
    throw Refusal(std::string("a damaged ") + what, "an HDF5 file", "Copy the file again.");
  }
}

std::string type_name(hid_t type) {
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return "float" + bits;
    case H5T_INTEGER:
      return (H5Tget_sign(type) == H5T_SGN_NONE ? "uint" : "int") + bits;
    case H5T_STRING:
      return "text";
    case H5T_ENUM:
      return "enum";
    case H5T_COMPOUND:
      return "records";
    default:
      return "other";
  }
}

std::string filter_problem(hid_t properties) {
  for (int i = 0; i < H5Pget_nfilters(properties); ++i) {
    unsigned flags = 0;
    std::size_t count = 0;
    std::array<char, 64> name{};
    const H5Z_filter_t filter = H5Pget_filter2(properties, static_cast<unsigned>(i), &flags, &count,
                                               nullptr, name.size(), name.data(), nullptr);
    if (H5Zfilter_avail(filter) <= 0) {
      name.back() = '\0';
      return "numbers compressed by a filter that Debian's library lacks (" +
             std::string(name.data()) + "); convert the file by h5repack -f GZIP=4";
    }
  }
  return "";
}

std::string problem_of(hid_t data, hid_t type, const std::vector<std::size_t>& shape,
                       std::size_t file_size) {
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER && kind != H5T_STRING) {
    return "elements that are no numbers";
  }
  std::size_t count = 1;
  for (const std::size_t side : shape) {
    if (side != 0 && count > kMostNumbers / side) {
      return "more numbers than can be read";
    }
    count *= side;
  }
  const std::size_t item = std::max<std::size_t>(1, H5Tget_size(type));
  if (count > kLargestRatio * file_size / item) {
    return "more numbers than the file can hold";
  }
  const Handle properties(H5Dget_create_plist(data), H5Pclose);
  if (H5Pget_external_count(properties.get()) > 0 ||
      H5Pget_layout(properties.get()) == H5D_VIRTUAL) {
    return "numbers in other files";
  }
  return filter_problem(properties.get());
}

std::optional<ArrayInfo> info_of(hid_t file, const std::string& name, std::size_t file_size) {
  const Handle data(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(data.valid() ? H5Dget_space(data.get()) : -1, H5Sclose);
  const Handle type(data.valid() ? H5Dget_type(data.get()) : -1, H5Tclose);
  if (!space.valid() || !type.valid()) {
    return std::nullopt;
  }
  ArrayInfo info;
  info.name = name;
  std::array<hsize_t, kMostSides> sides{};
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0 || rank > kMostSides ||
      H5Sget_simple_extent_dims(space.get(), sides.data(), nullptr) < 0) {
    return std::nullopt;
  }
  info.shape.assign(sides.begin(), sides.begin() + rank);
  info.type = type_name(type.get());
  info.problem = problem_of(data.get(), type.get(), info.shape, file_size);
  return info;
}

herr_t collect(hid_t /*top*/, const char* name, const H5O_info_t* object, void* to) {
  auto& names = *static_cast<std::vector<std::string>*>(to);
  if (object->type == H5O_TYPE_DATASET) {
    names.push_back(std::string("/") + name);
  }
  return names.size() < kMostArrays ? 0 : 1;
}

std::vector<ArrayInfo> list_hdf5(const std::string& path) {
  const Handle file = open_file(path);
  need(file.valid(), "file");
  std::vector<std::string> names;
  need(H5Ovisit2(file.get(), H5_INDEX_NAME, H5_ITER_INC, collect, &names, H5O_INFO_BASIC) >= 0,
       "group");
  std::vector<ArrayInfo> arrays;
  const std::size_t size = std::filesystem::file_size(path);
  for (const std::string& name : names) {
    if (std::optional<ArrayInfo> info = info_of(file.get(), name, size)) {
      arrays.push_back(*std::move(info));
    }
  }
  return arrays;
}

std::vector<std::string> read_words(hid_t data, std::size_t count) {
  const Handle stored(H5Dget_type(data), H5Tclose);
  std::vector<std::string> words;
  if (H5Tis_variable_str(stored.get()) > 0) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), H5T_VARIABLE);
    H5Tset_cset(type.get(), H5Tget_cset(stored.get()));
    std::vector<char*> texts(count, nullptr);
    need(H5Dread(data, type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()) >= 0, "data set");
    for (const char* text : texts) {
      words.emplace_back(text == nullptr ? "" : text);
    }
    return words;
  }
  const std::size_t size = H5Tget_size(stored.get());
  if (size == 0 || count > kMostNumbers / size) {
    throw Refusal("texts that are too long");
  }
  std::string bytes(count * size, '\0');
  need(H5Dread(data, stored.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0, "data set");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string word = bytes.substr(i * size, size);
    words.push_back(word.substr(0, word.find('\0')));
  }
  return words;
}

Elements read_hdf5(const std::string& path, const ArrayInfo& info) {
  const Handle file = open_file(path);
  need(file.valid(), "file");
  const Handle data(H5Dopen2(file.get(), info.name.c_str(), H5P_DEFAULT), H5Dclose);
  need(data.valid(), "data set");
  Elements elements;
  elements.rows = info.shape.empty() ? 1 : info.shape.front();
  for (std::size_t i = 1; i < info.shape.size(); ++i) {
    elements.columns *= info.shape[i];
  }
  const std::size_t count = elements.rows * elements.columns;
  if (info.type == "text") {
    elements.are_words = true;
    elements.words = read_words(data.get(), count);
    return elements;
  }
  elements.numbers.resize(count);
  need(H5Dread(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
               elements.numbers.data()) >= 0,
       "data set");
  return elements;
}

}  // namespace

const Reader& hdf5_reader() {
  static const Reader kReader{list_hdf5, read_hdf5};
  return kReader;
}

}  // namespace handway::array_reader
