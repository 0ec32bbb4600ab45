/// Reads arrays of HDF5 and MATLAB files for Handway's libraries, each file in a process of its
/// own: their libraries may crash on damaged files. Users don't start it.
///
///     handway-array-reader list hdf5|matlab FILE
///     handway-array-reader read hdf5|matlab FILE ARRAY
///
/// The output is one line of JSON: the arrays, an error, the words of an array, or its size. The
/// numbers of an array follow as doubles, row by row.
#include "readers.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace handway::array_reader {
namespace {

using Json = nlohmann::ordered_json;

constexpr rlim_t kMostSeconds = 60;
constexpr rlim_t kMostMemory = rlim_t{4} << 30;

void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

void write_line(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
  std::fwrite(text.data(), 1, text.size(), stdout);
}

Json json_of(const ArrayInfo& info) {
  return {
      {"name", info.name}, {"shape", info.shape}, {"type", info.type}, {"problem", info.problem}};
}

void write_numbers(const Elements& elements) {
  write_line({{"rows", elements.rows}, {"columns", elements.columns}});
  if (!elements.by_column) {
    std::fwrite(elements.numbers.data(), sizeof(double), elements.numbers.size(), stdout);
    return;
  }
  std::vector<double> row(elements.columns);
  for (std::size_t r = 0; r < elements.rows; ++r) {
    for (std::size_t c = 0; c < elements.columns; ++c) {
      row[c] = elements.numbers[c * elements.rows + r];
    }
    std::fwrite(row.data(), sizeof(double), row.size(), stdout);
  }
}

void list(const Reader& reader, const std::string& file) {
  Json arrays = Json::array();
  for (const ArrayInfo& info : reader.list(file)) {
    arrays.push_back(json_of(info));
  }
  write_line({{"arrays", arrays}});
}

void read(const Reader& reader, const std::string& file, const std::string& name) {
  const std::vector<ArrayInfo> arrays = reader.list(file);
  const auto found = std::ranges::find(arrays, name, &ArrayInfo::name);
  if (found == arrays.end() || !found->problem.empty()) {
    throw Refusal(found == arrays.end() ? "no array of that name" : found->problem);
  }
  const Elements elements = reader.read(file, *found);
  if (elements.are_words) {
    write_line({{"words", elements.words}});
  } else {
    write_numbers(elements);
  }
}

int run(std::span<char*> arguments) {
  const std::vector<std::string> words(arguments.begin() + 1, arguments.end());
  if (words.size() < 3 || words.size() > 4) {
    std::fputs("Handway's libraries start this program to read arrays; it has no other use.\n",
               stderr);
    return 2;
  }
  limit(RLIMIT_CPU, kMostSeconds);
  limit(RLIMIT_AS, kMostMemory);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // folders for reading only have no locks
  const Reader& reader = words[1] == "matlab" ? matlab_reader() : hdf5_reader();
  try {
    if (words[0] == "list") {
      list(reader, words[2]);
    } else {
      read(reader, words[2], words.back());
    }
  } catch (const Refusal& refusal) {
    write_line({{"error", refusal.what()},
                {"expected", refusal.expected()},
                {"advice", refusal.advice()}});
  } catch (const std::bad_alloc&) {
    write_line({{"error", "more data than fits into memory"}, {"expected", ""}, {"advice", ""}});
  } catch (const std::exception& error) {
    write_line({{"error", error.what()}, {"expected", ""}, {"advice", ""}});
  }
  std::fflush(stdout);
  ::_exit(0);  // without destructors of libraries that have read damaged files
}

}  // namespace
}  // namespace handway::array_reader

int main(int argc, char** argv) {
  return handway::array_reader::run({argv, static_cast<std::size_t>(argc)});
}
