#include "recordings/table_bytes.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace handway::device {
namespace {

/// An identifier of the library, closed with the object.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) {
      throw std::runtime_error("HDF5 can't write this recording");
    }
  }
  ~Hdf5Handle() { close_(id_); }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  [[nodiscard]] hid_t get() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void write_data(const Hdf5Handle& file, const char* name, hid_t type,
                const std::vector<hsize_t>& shape, const void* data) {
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                         H5Sclose);
  const Hdf5Handle settings(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(settings.get(), false);  // equal tables give equal bytes
  const Hdf5Handle set(
      H5Dcreate2(file.get(), name, type, space.get(), H5P_DEFAULT, settings.get(), H5P_DEFAULT),
      H5Dclose);
  if (H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    throw std::runtime_error("HDF5 can't write this recording");
  }
}

void write_matrix(const Hdf5Handle& file, const char* name, const Eigen::MatrixXd& matrix) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor values = matrix;
  write_data(file, name, H5T_NATIVE_DOUBLE,
             {static_cast<hsize_t>(values.rows()), static_cast<hsize_t>(values.cols())},
             values.data());
}

void write_names(const Hdf5Handle& file, const char* set, const std::vector<std::string>& names) {
  std::size_t longest = 1;
  for (const std::string& name : names) {
    longest = std::max(longest, name.size());
  }
  std::string bytes;
  for (const std::string& name : names) {
    bytes += name + std::string(longest - name.size(), '\0');
  }
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), longest);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  write_data(file, set, type.get(), {names.size()}, bytes.data());
}

}  // namespace

std::string hdf5_bytes(const RecordedTable& table) {
  static std::mutex mutex;  // Debian's library is not for several threads
  const std::lock_guard lock(mutex);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  constexpr std::size_t kGrowth = std::size_t{1} << 20;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), kGrowth, false);  // in memory
  const Hdf5Handle file(H5Fcreate("recording", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
  write_data(file, "time", H5T_NATIVE_DOUBLE, {static_cast<hsize_t>(table.times.size())},
             table.times.data());
  write_matrix(file, "values", table.values);
  write_names(file, "names", table.names);
  if (table.raw) {
    write_matrix(file, "raw", table.raw->values);
    write_names(file, "raw_names", labels_of(*table.raw));
  }
  H5Fflush(file.get(), H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
  std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(file.get(), bytes.data(), bytes.size()) != size) {
    throw std::runtime_error("HDF5 can't write this recording");
  }
  return bytes;
}

}  // namespace handway::device
