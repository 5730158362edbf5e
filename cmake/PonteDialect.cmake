# For ponte itself, and for everyone who has it installed: C++ from a MAVLink dialect. A file is written only when its text
# changes; the stamp tells the build system that the generator has run.

# ponte_add_dialect(NAME XML [DIGEST FILE]): the library ponte::mavlink_NAME with the messages of a MAVLink dialect,
# headers `ponte/mavlink/NAME/*.hpp`, namespace ponte::mavlink::NAME, and the reference page
# docs/mavlink-NAME.md in the build folder. Files that the XML includes are looked for beside it, then in the folders of
# PONTE_DIALECT_PATH.
function(ponte_add_dialect name xml)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "DIGEST" "")
  set(folder ${CMAKE_BINARY_DIR}/generated/mavlink_${name})
  set(stamp ${CMAKE_BINARY_DIR}/generated/mavlink_${name}.stamp)
  set(sources ${folder}/ponte/mavlink/${name}/dialect.cpp ${folder}/ponte/mavlink/${name}/enums.cpp)
  cmake_path(ABSOLUTE_PATH xml)
  cmake_path(GET xml PARENT_PATH beside)
  set(command ponte::codegen mavlink --input ${xml} --name ${name} --output ${folder}
              --reference ${CMAKE_BINARY_DIR}/docs/mavlink-${name}.md)
  file(GLOB inputs CONFIGURE_DEPENDS ${beside}/*.xml)
  foreach(place ${PONTE_DIALECT_PATH})
    file(GLOB found CONFIGURE_DEPENDS ${place}/*.xml)
    list(APPEND inputs ${found})
    list(APPEND command --include-dir ${place})
  endforeach()
  if(arg_DIGEST)
    list(APPEND command --digest ${arg_DIGEST})
  endif()
  add_custom_command(OUTPUT ${stamp} BYPRODUCTS ${sources}
                     COMMAND ${command} COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
                     DEPENDS ponte::codegen ${inputs} ${arg_DIGEST}
                     COMMENT "Generating the MAVLink dialect ${name}" VERBATIM)
  add_library(ponte_mavlink_${name} STATIC ${sources} ${stamp})
  add_library(ponte::mavlink_${name} ALIAS ponte_mavlink_${name})
  target_include_directories(ponte_mavlink_${name} PUBLIC $<BUILD_INTERFACE:${folder}>)
  target_link_libraries(ponte_mavlink_${name} PUBLIC ponte::mavlink
                        PRIVATE $<BUILD_INTERFACE:$<TARGET_NAME_IF_EXISTS:ponte_options>>)
endfunction()
