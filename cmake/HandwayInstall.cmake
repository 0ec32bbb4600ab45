# What `cmake --install` puts where, in four components: libraries (with headers and a CMake
# package), programs, plugins, data. Programs find the others by their place beside bin/.
include(CMakePackageConfigHelpers)

set(_HANDWAY_PACKAGE_FOLDER lib/cmake/Handway)

# Where a library, program or plugin finds our libraries: from its own place, which is the same in
# the build tree and installed. For two different paths CMake would fill the shorter one up with
# empty elements, which stand for the current folder.
function(_handway_find_libraries_at target place)
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "${place}" BUILD_WITH_INSTALL_RPATH ON)
endfunction()

# Each library is a component of the package, with a file of its own for its target. PUBLIC… are
# what it links publicly, other libraries of ours among them.
function(_handway_install_library name)
  set_target_properties(handway_${name} PROPERTIES EXPORT_NAME ${name})
  _handway_find_libraries_at(handway_${name} "$ORIGIN")
  install(
    TARGETS handway_${name}
    EXPORT handway_${name}
    LIBRARY DESTINATION lib COMPONENT libraries)
  install(
    EXPORT handway_${name}
    FILE ${name}.cmake
    NAMESPACE handway::
    DESTINATION ${_HANDWAY_PACKAGE_FOLDER}
    COMPONENT libraries)
  set(used ${ARGN})
  list(FILTER used INCLUDE REGEX "^handway::")
  list(TRANSFORM used REPLACE "^handway::" "")
  list(JOIN used " " used)
  set_property(GLOBAL APPEND PROPERTY HANDWAY_COMPONENTS ${name})
  set_property(GLOBAL APPEND PROPERTY HANDWAY_COMPONENTS_USED "set(_Handway_used_by_${name} ${used})")
  install(
    DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/ ${CMAKE_CURRENT_BINARY_DIR}/include/
    DESTINATION include
    COMPONENT libraries)
endfunction()

function(_handway_install_program name)
  _handway_find_libraries_at(${name} "$ORIGIN/../lib")
  install(TARGETS ${name} RUNTIME DESTINATION bin COMPONENT programs)
endfunction()

# _handway_install_plugin(NAME [FOLDER]): in that folder beside the plugins, or with them.
function(_handway_install_plugin name)
  set(folder lib/handway-plugins)
  set(libraries "$ORIGIN/..")
  if(ARGC GREATER 1)
    string(APPEND folder /${ARGV1})
    string(APPEND libraries /..)
  endif()
  _handway_find_libraries_at(${name} "${libraries}")
  install(TARGETS ${name} LIBRARY DESTINATION ${folder} COMPONENT plugins)
endfunction()

# Robots, objects, bases and scenes, and the package that find_package(Handway) reads.
function(handway_install_data)
  foreach(folder resources scenes)
    if(IS_DIRECTORY ${CMAKE_SOURCE_DIR}/${folder})
      install(
        DIRECTORY ${folder}
        DESTINATION share/handway
        COMPONENT data
        PATTERN cad EXCLUDE
        PATTERN cad.cmake EXCLUDE)
    endif()
  endforeach()
  get_property(components GLOBAL PROPERTY HANDWAY_COMPONENTS)
  get_property(components_used GLOBAL PROPERTY HANDWAY_COMPONENTS_USED)
  list(JOIN components " " components)
  list(JOIN components_used "\n" components_used)
  configure_package_config_file(
    ${CMAKE_SOURCE_DIR}/cmake/HandwayConfig.cmake.in ${CMAKE_BINARY_DIR}/HandwayConfig.cmake
    INSTALL_DESTINATION ${_HANDWAY_PACKAGE_FOLDER} NO_SET_AND_CHECK_MACRO
    NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/HandwayConfigVersion.cmake
                                   COMPATIBILITY SameMinorVersion)
  install(
    FILES ${CMAKE_BINARY_DIR}/HandwayConfig.cmake ${CMAKE_BINARY_DIR}/HandwayConfigVersion.cmake
    DESTINATION ${_HANDWAY_PACKAGE_FOLDER}
    COMPONENT libraries)
endfunction()
