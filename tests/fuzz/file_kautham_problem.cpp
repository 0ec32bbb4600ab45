/// Problems of Kautham 2013 (XML), without the files that they name.
#include "input_file.h"
#include "kautham_problem.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("problem.xml");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(import_kautham::read_kautham_problem(file.hold(data, size))); });
}
