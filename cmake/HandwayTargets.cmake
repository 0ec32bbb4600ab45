# The few kinds of targets that the project is made of.
include(GenerateExportHeader)

function(_handway_warnings target)
  # Warnings are those of g++, which builds what users get.
  if(HANDWAY_FUZZ)
    return()
  endif()
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                           -Woverloaded-virtual -Werror)
  # Warns of types of a nameless namespace in headers, and takes a unity build's sources for such.
  if(CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# handway_library(NAME SOURCES … [PUBLIC …] [PRIVATE …])
# A layer: shared library handway_NAME, target handway::NAME, public headers in
# include/handway/NAME/, export macro HANDWAY_<NAME>_EXPORT in handway/NAME/export.h.
function(handway_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target handway_${name})
  add_library(${target} SHARED ${ARG_SOURCES})
  add_library(handway::${name} ALIAS ${target})
  string(TOUPPER ${name} upper)
  generate_export_header(
    ${target}
    BASE_NAME handway_${name}
    EXPORT_MACRO_NAME HANDWAY_${upper}_EXPORT
    EXPORT_FILE_NAME ${CMAKE_CURRENT_BINARY_DIR}/include/handway/${name}/export.h)
  target_include_directories(
    ${target}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  _handway_warnings(${target})
  handway_use_headers(${target} handway_library_headers)
  if(HANDWAY_SANITIZE)
    target_compile_options(${target} PRIVATE -O2)  # The tests run what is here most.
  endif()
  # Before 1.0, minor versions may change the interface.
  set_target_properties(
    ${target} PROPERTIES VERSION ${PROJECT_VERSION}
                         SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  _handway_install_library(${name} ${ARG_PUBLIC})
endfunction()

# What a user runs: the programs and their plugins, without the tests.
add_custom_target(programs)

# handway_executable(NAME SOURCES … LINK …): a program in bin/.
function(handway_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  add_dependencies(programs ${name})
  _handway_warnings(${name})
  _handway_install_program(${name})
endfunction()

# handway_plugin(NAME SOURCES … LINK …): a module that the program finds beside its libraries.
# With OUTPUT FOLDER it is built there instead, and not installed: for tests.
# handway_plugin(NAME LIBRARY TARGET): of what is in a static library, which tests link, too.
function(handway_plugin name)
  cmake_parse_arguments(ARG "" "OUTPUT;LIBRARY" "SOURCES;LINK" ${ARGN})
  if(ARG_LIBRARY)
    set(ARG_SOURCES $<TARGET_OBJECTS:${ARG_LIBRARY}>)
    set(ARG_LINK ${ARG_LIBRARY})
    target_compile_definitions(${ARG_LIBRARY} PRIVATE HANDWAY_VERSION="${PROJECT_VERSION}")
  endif()
  add_library(${name} MODULE ${ARG_SOURCES})
  target_compile_definitions(${name} PRIVATE HANDWAY_VERSION="${PROJECT_VERSION}")
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  set_target_properties(${name} PROPERTIES PREFIX "")
  _handway_warnings(${name})
  if(ARG_OUTPUT)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${ARG_OUTPUT}")
  else()
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY
                                             "${HANDWAY_PLUGIN_DIRECTORY}")
    add_dependencies(programs ${name})
    _handway_install_plugin(${name})
  endif()
endfunction()

# handway_plugin_part(NAME PLUGIN P LIBRARY L): a library that the plugin P loads itself, when it needs it, from
# the folder P beside it.
function(handway_plugin_part name)
  cmake_parse_arguments(ARG "" "PLUGIN;LIBRARY" "" ${ARGN})
  add_library(${name} MODULE $<TARGET_OBJECTS:${ARG_LIBRARY}>)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARY})
  set_target_properties(
    ${name}
    PROPERTIES LINKER_LANGUAGE CXX
               PREFIX ""
               LIBRARY_OUTPUT_DIRECTORY "${HANDWAY_PLUGIN_DIRECTORY}/${ARG_PLUGIN}")
  _handway_install_plugin(${name} ${ARG_PLUGIN})
endfunction()

# handway_benchmark(NAME SOURCES … LINK …): a program in bin/ that is not installed.
function(handway_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  _handway_warnings(${name})
endfunction()

# handway_test(NAME [SLOW] [REAL_TIME] [WINDOW] SOURCES … LINK …): a GoogleTest program whose cases CTest lists
# one by one, labelled "fast" or "slow": all fast ones together take less than a minute. Those of
# programs that have to keep up with the clock are slow, too; they run while no other test does, and
# again if the machine itself did not keep up. Those with WINDOW link Qt.
function(handway_test name)
  cmake_parse_arguments(ARG "SLOW;REAL_TIME;WINDOW" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  if(ARG_REAL_TIME)
    set(main handway_test_real_time_main)
  else()
    set(main GTest::gtest_main)
  endif()
  target_link_libraries(${name} PRIVATE ${ARG_LINK} handway_test_support GTest::gmock GTest::gtest
                                        ${main})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  _handway_warnings(${name})
  if(ARG_SLOW OR ARG_REAL_TIME)
    set(label slow)
  else()
    set(label fast)
  endif()
  # What they test is optimised; tests themselves are not worth the compiler's time.
  target_compile_options(${name} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
  # GCC 12 takes "text" + std::string() for an overflow (its PR 105651).
  target_compile_options(${name} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                         -Wno-stringop-overread)
  if(ARG_WINDOW)
    handway_use_headers(${name} handway_window_test_headers)
  else()
    handway_use_headers(${name} handway_test_headers)
  endif()
  gtest_discover_tests(
    ${name}
    DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT ${HANDWAY_TEST_TIMEOUT} RUN_SERIAL ${ARG_REAL_TIME} LABELS ${label}
               ENVIRONMENT "XDG_CACHE_HOME=${CMAKE_BINARY_DIR}/cache")
endfunction()

# handway_fuzz_target(NAME SOURCES … LINK …): a program fuzz_NAME that libFuzzer drives; its first
# inputs are the files of tests/fuzz/corpora/NAME.
function(handway_fuzz_target name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(fuzz_${name} ${ARG_SOURCES})
  target_link_libraries(fuzz_${name} PRIVATE ${ARG_LINK})
  target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  set_target_properties(fuzz_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/fuzz")
endfunction()
