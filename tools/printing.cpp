#include "printing.h"

#include "handway/geometric/io/printable.h"

namespace handway::tools {

void write_printable(std::FILE* stream, std::string_view text) {
  fmt::print(stream, "{}", geometric::printable(text));
}

}  // namespace handway::tools
