# What every target of ponte is compiled with, and the switches a builder has.

option(PONTE_TESTS "Build the unit tests and the tools of the integration tests" ON)
option(PONTE_BENCH "Build the benchmarks" OFF)
option(PONTE_FUZZ "Build the fuzz targets (clang only)" OFF)
option(PONTE_WERROR "Treat warnings as errors" OFF)
set(PONTE_SANITIZE "" CACHE STRING "Value for -fsanitize=, empty for none")
set(PONTE_MAVLINK_XML "" CACHE PATH
    "Folder with the MAVLink XML definitions; empty: those of the pinned pymavlink in build/venv")
set(PONTE_DIALECTS "" CACHE STRING
    "Dialects of that folder to be built besides ours, e.g. common;uAvionix: libraries ponte::mavlink_NAME, in lower case")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)

find_program(PONTE_CCACHE ccache)
if(PONTE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PONTE_CCACHE})
endif()

if(NOT PONTE_MAVLINK_XML)
  file(GLOB found ${CMAKE_SOURCE_DIR}/build/venv/lib/python3*/site-packages/pymavlink/dialects/v20)
  if(NOT found)
    message(FATAL_ERROR "No MAVLink definitions: `./run build` installs the pinned pymavlink package into "
                        "build/venv, or pass -DPONTE_MAVLINK_XML=DIR")
  endif()
  list(GET found 0 PONTE_MAVLINK_XML)
endif()
# Where the files that a dialect includes are looked for.
set(PONTE_DIALECT_PATH ${CMAKE_SOURCE_DIR}/definitions/mavlink ${PONTE_MAVLINK_XML})

find_package(fmt REQUIRED)
find_package(pugixml REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(spdlog REQUIRED)
find_library(PONTE_GEOGRAPHICLIB GeographicLib REQUIRED)
# libzip's own CMake file, as Debian ships it, asks for programs of another package.
find_library(PONTE_LIBZIP zip REQUIRED)

# Same seed, same bytes on every compiler: no fused multiply-add behind our back.
add_library(ponte_options INTERFACE)
target_compile_options(ponte_options INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                               -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # g++ 12 sees overlaps and overflows in the standard library's own code that are none (gcc bugs 105651, 105329).
  target_compile_options(ponte_options INTERFACE -Wno-restrict -Wno-stringop-overflow)
endif()
if(PONTE_WERROR)
  target_compile_options(ponte_options INTERFACE -Werror)
endif()
if(PONTE_SANITIZE)
  target_compile_options(ponte_options INTERFACE -fsanitize=${PONTE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(ponte_options INTERFACE -fsanitize=${PONTE_SANITIZE})
  if(PONTE_SANITIZE MATCHES undefined)
    target_compile_options(ponte_options INTERFACE -fno-sanitize-recover=undefined)
  endif()
endif()
