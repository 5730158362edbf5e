# Message definitions become C++ in the build tree. A file is written only when its text changes, so an edit of one
# definition does not rebuild the world; the stamp tells the build system that the generator has run.

# ponte_add_dli_messages(FOLDER): the library ponte::dli_messages, headers `ponte/dli/messages/*.hpp`, and the
# reference page docs/dli-messages.md in the build folder.
function(ponte_add_dli_messages definitions)
  set(folder ${CMAKE_BINARY_DIR}/generated/dli)
  set(stamp ${CMAKE_BINARY_DIR}/generated/dli.stamp)
  set(sources ${folder}/ponte/dli/messages/catalogue.cpp ${folder}/ponte/dli/messages/enumerations.cpp)
  file(GLOB inputs CONFIGURE_DEPENDS ${definitions}/*.toml)
  add_custom_command(OUTPUT ${stamp} BYPRODUCTS ${sources}
                     COMMAND ponte_codegen dli --input ${definitions} --output ${folder}
                             --reference ${CMAKE_BINARY_DIR}/docs/dli-messages.md
                     COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
                     DEPENDS ponte_codegen ${inputs}
                     COMMENT "Generating the DLI messages" VERBATIM)
  add_library(ponte_dli_messages STATIC ${sources} ${stamp})
  add_library(ponte::dli_messages ALIAS ponte_dli_messages)
  target_include_directories(ponte_dli_messages PUBLIC ${folder})
  target_link_libraries(ponte_dli_messages PUBLIC ponte::dli PRIVATE ponte_options)
endfunction()
