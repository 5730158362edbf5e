# What others build with: find_package(ponte COMPONENTS mavlink reflection).
include(CMakePackageConfigHelpers)

set(PONTE_PACKAGE_DIR lib/cmake/ponte)

# ponte_install(COMPONENT TARGET...): the targets ponte_NAME with their headers, as ponte::NAME for those who find the
# component, which `cmake --install ... --component COMPONENT` installs alone.
function(ponte_install component)
  foreach(target ${ARGN})
    string(REGEX REPLACE "^ponte_" "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL EXECUTABLE)
      install(TARGETS ${target} EXPORT ponte-${component} RUNTIME COMPONENT ${component})
    elseif(name MATCHES "^mavlink_")  # a dialect; its headers are made when it is built
      install(TARGETS ${target} EXPORT ponte-${component} ARCHIVE DESTINATION lib COMPONENT ${component}
              INCLUDES DESTINATION include)
      install(DIRECTORY ${CMAKE_BINARY_DIR}/generated/${name}/ponte DESTINATION include COMPONENT ${component}
              FILES_MATCHING PATTERN *.hpp)
    else()
      install(TARGETS ${target} EXPORT ponte-${component} ARCHIVE DESTINATION lib COMPONENT ${component}
              FILE_SET HEADERS DESTINATION include COMPONENT ${component})
    endif()
  endforeach()
  install(EXPORT ponte-${component} NAMESPACE ponte:: DESTINATION ${PONTE_PACKAGE_DIR} COMPONENT ${component})
endfunction()

# The files that find_package reads first. Every component needs `mavlink`, so they come with it.
function(ponte_install_package)
  configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/ponteConfig.cmake.in ${CMAKE_BINARY_DIR}/ponteConfig.cmake
                                INSTALL_DESTINATION ${PONTE_PACKAGE_DIR})
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/ponteConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/ponteConfig.cmake ${CMAKE_BINARY_DIR}/ponteConfigVersion.cmake
                ${CMAKE_SOURCE_DIR}/cmake/PonteDialect.cmake
          DESTINATION ${PONTE_PACKAGE_DIR} COMPONENT mavlink)
endfunction()
