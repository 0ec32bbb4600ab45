# Target `robot_meshes` (not built by default): rebuilds the meshes of all robots and objects
# from their OpenSCAD sources, in the source tree.
find_program(HANDWAY_OPENSCAD openscad DOC "Builds the meshes of robots and objects")
mark_as_advanced(HANDWAY_OPENSCAD)
add_custom_target(robot_meshes)

# _handway_mesh(TARGET STL SCAD [DEFINITION…]): one mesh, rebuilt whenever TARGET is.
function(_handway_mesh target stl scad)
  get_filename_component(folder ${stl} DIRECTORY)
  add_custom_command(
    TARGET ${target}
    POST_BUILD
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${HANDWAY_OPENSCAD} --quiet --export-format binstl ${ARGN} -o ${stl} ${scad}
    VERBATIM)
endfunction()

# _handway_mesh_target(NAME): part of robot_meshes; stops with advice if there is no OpenSCAD.
function(_handway_mesh_target name)
  add_custom_target(${name} COMMENT "Building the meshes of ${name}")
  if(NOT HANDWAY_OPENSCAD)
    add_custom_command(
      TARGET ${name}
      POST_BUILD
      COMMAND ${CMAKE_COMMAND} -E echo
              "OpenSCAD was not found: install it (Debian: openscad) and configure again."
      COMMAND ${CMAKE_COMMAND} -E false
      VERBATIM)
  endif()
  add_dependencies(robot_meshes ${name})
endfunction()

# handway_robot_meshes(ROBOT PARTS…): meshes of robots/ROBOT from its cad/ROBOT.scad.
# Each PART is a value of the file's variable `part`. LINK_collision becomes
# meshes/collision/LINK.stl; any other part becomes meshes/visual/PART.stl.
function(handway_robot_meshes robot)
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/resources/robots/${robot})
  _handway_mesh_target(${robot}_meshes)
  if(NOT HANDWAY_OPENSCAD)
    return()
  endif()
  foreach(part IN LISTS ARGN)
    if(part MATCHES "^(.*)_collision$")
      set(stl ${folder}/meshes/collision/${CMAKE_MATCH_1}.stl)
    else()
      set(stl ${folder}/meshes/visual/${part}.stl)
    endif()
    _handway_mesh(${robot}_meshes ${stl} ${folder}/cad/${robot}.scad -D "part=\"${part}\"")
  endforeach()
endfunction()

# handway_object_meshes(NAMES…): objects/NAME.stl from objects/cad/NAME.scad.
function(handway_object_meshes)
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/resources/objects)
  _handway_mesh_target(object_meshes)
  if(NOT HANDWAY_OPENSCAD)
    return()
  endif()
  foreach(name IN LISTS ARGN)
    _handway_mesh(object_meshes ${folder}/${name}.stl ${folder}/cad/${name}.scad)
  endforeach()
endfunction()

foreach(
  robot
  tx90
  sah_right
  iiwa14_class
  panda_class
  ur5e_class
  allegro_class_right
  leap_class_right
  shadow_class_right)
  include(${CMAKE_CURRENT_LIST_DIR}/${robot}/cad/meshes.cmake OPTIONAL)
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/../objects/cad/meshes.cmake OPTIONAL)
