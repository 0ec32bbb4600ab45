/// Bases of principal motion directions (YAML).
#include "handway/sampling/postures/pmd_basis.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("basis.yaml");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(sampling::read_pmd_basis(file.hold(data, size))); });
}
