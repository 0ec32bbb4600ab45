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

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

option(HANDWAY_BUILD_GUI "Build the workbench (Qt5, Coin3D)" ON)
option(HANDWAY_BUILD_TESTS "Build the tests" ON)
option(HANDWAY_SANITIZE "Instrument with AddressSanitizer and UBSan" OFF)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

if(HANDWAY_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # GCC takes instrumented code of libraries for uninitialised.
  add_compile_options(-Wno-maybe-uninitialized -Wno-uninitialized)
endif()

# Identical bits on every run and machine of one architecture: the compiler may
# not fuse or reorder floating-point operations on its own.
add_compile_options(-ffp-contract=off)
