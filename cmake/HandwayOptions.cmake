# Compiler settings and switches that hold for every target.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(HANDWAY_PLUGIN_DIRECTORY "${CMAKE_BINARY_DIR}/lib/handway-plugins")
set(HANDWAY_PYTHON_DIRECTORY "${CMAKE_BINARY_DIR}/lib/handway-python")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

option(HANDWAY_BUILD_GUI "Build the workbench (Qt5, Coin3D)" ON)
option(HANDWAY_BUILD_TESTS "Build the tests" ON)
option(HANDWAY_SANITIZE "Instrument with AddressSanitizer and UBSan" OFF)
option(HANDWAY_FUZZ "Build the fuzz targets and what they need, and nothing else (clang)" OFF)

# Python is the one whose packages Debian's pybind11 and NumPy are.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python to build the package for")
endif()
find_package(Python 3.9 COMPONENTS Interpreter Development.Module NumPy QUIET)
find_package(pybind11 2.10 CONFIG QUIET)
include(CMakeDependentOption)
cmake_dependent_option(HANDWAY_BUILD_PYTHON "Build the Python package (pybind11, NumPy)" ON
                       "pybind11_FOUND;Python_FOUND;NOT HANDWAY_SANITIZE" OFF)

# Paths count relative to the clone, so that another clone finds what this one has compiled.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}"
                                  CCACHE_NOHASHDIR=1
                                  CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess)  # Without it ccache keeps nothing that uses such headers.
  endif()
endif()

set(HANDWAY_TEST_TIMEOUT 300)  # s
if(HANDWAY_SANITIZE)
  set(HANDWAY_TEST_TIMEOUT 900)
  # A null pointer that is used ends the program anyway, and this processor reads from any address.
  # Checks of every access for these would make searches in the tests much slower.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size
                      -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # GCC takes instrumented code of libraries for uninitialised.
  add_compile_options(-Wno-maybe-uninitialized -Wno-uninitialized)
endif()

if(HANDWAY_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "libFuzzer is a part of clang: cmake --preset fuzz")
  endif()
  # Types are compared across libraries by their names, which hidden ones keep to themselves.
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=vptr
                      -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined -fno-sanitize=vptr)
endif()

# Identical bits on every run and machine of one architecture: the compiler may
# not fuse or reorder floating-point operations on its own.
add_compile_options(-ffp-contract=off)
# Nobody asks for errno or the processor's flags after an operation; without these the compiler may
# take roots and compare in vectors. Results stay the same.
add_compile_options(-fno-math-errno -fno-trapping-math)
