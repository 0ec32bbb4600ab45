# Headers of other projects that most sources include are compiled once, and shared by targets whose
# flags are the same: GCC refuses them elsewhere (-Winvalid-pch, which is an error here). Sources
# still include what they use: clang-tidy compiles them without these.

# handway_headers(NAME HEADERS <HEADER>… [LINK …] [OPTIONS …]): compiles these headers.
function(handway_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Owns the headers that are compiled once.\n")
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  _handway_warnings(${name})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# handway_use_headers(TARGET NAME): includes headers that were compiled once in all its sources.
function(handway_use_headers target name)
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

set(handway_common_headers
    <Eigen/Geometry>
    <algorithm>
    <array>
    <cmath>
    <cstdint>
    <filesystem>
    <functional>
    <map>
    <memory>
    <optional>
    <set>
    <span>
    <sstream>
    <stop_token>
    <string>
    <string_view>
    <utility>
    <variant>
    <vector>)

# For libraries and plugins; they link fmt.
handway_headers(
  handway_library_headers
  LINK Eigen3::Eigen fmt::fmt
  HEADERS ${handway_common_headers} <fmt/format.h>)
