# SPDX-License-Identifier: Apache-2.0
# How every room, program and test of this project is compiled, said once.

# With a sanitizer all is several times as slow, and malloc is the sanitizer's own.
set(LODESMAN_SANITIZED OFF)
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(LODESMAN_SANITIZED ON)
endif()

add_library(lodesman_flags INTERFACE)
target_include_directories(lodesman_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(lodesman_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion
  -Wold-style-cast -Wnon-virtual-dtor -Wimplicit-fallthrough
  -ffp-contract=off)
# clang 14 gives this one for a defaulted operator== too.
target_compile_options(lodesman_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wfloat-equal>)
# GCC 12 sees overlaps in std::string and unset values in std::optional that are not there when it
# optimises (its bugs 105651 and 80635); clang and the sanitizers watch for the real ones.
target_compile_options(lodesman_flags INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-maybe-uninitialized>)
target_compile_definitions(lodesman_flags INTERFACE _GLIBCXX_ASSERTIONS)
target_link_libraries(lodesman_flags INTERFACE Threads::Threads)
# A program loads no library that it calls nothing of, and finds all that it calls when it is loaded:
# no real-time step is the first to look a function up.
target_link_options(lodesman_flags INTERFACE LINKER:--as-needed LINKER:-z,relro,-z,now)

# For what nothing waits for: the tests themselves, and what speaks with people. Compiling it takes
# most of a cold build's time, half of that without much optimising, and most of the rest for the
# headers that all of them read.
function(lodesman_compile_fast name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1> $<$<CONFIG:None>:-O0>)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
endfunction()

# What is shipped: the same bytes wherever it was built, and lines for who reads a backtrace, which
# the package has apart.
function(lodesman_compile_to_ship name)
  target_compile_options(${name} PRIVATE
    -ffile-prefix-map=${PROJECT_SOURCE_DIR}/= $<$<CONFIG:Release>:-g1>)
endfunction()

# One static library a room, its target named by the whole path:
# lodesman_room(low_level/path grid.cpp search.cpp LINKS lodesman::mid_level::geometry) makes
# lodesman::low_level::path.
function(lodesman_room room)
  cmake_parse_arguments(ARG "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  string(REPLACE "/" "_" name ${room})
  string(REPLACE "/" "::" alias ${room})
  add_library(lodesman_${name} STATIC ${ARG_UNPARSED_ARGUMENTS})
  set_property(GLOBAL APPEND PROPERTY LODESMAN_ROOMS ${room})
  add_library(lodesman::${alias} ALIAS lodesman_${name})
  target_link_libraries(lodesman_${name} PUBLIC lodesman_flags ${ARG_LINKS}
                                         PRIVATE ${ARG_PRIVATE_LINKS})
  lodesman_compile_to_ship(lodesman_${name})
  if(room MATCHES "^deploy/")
    lodesman_compile_fast(lodesman_${name})
  endif()
  # Templates by the hundred, which nothing waits for: instrumented and optimised they take minutes.
  if(room MATCHES "^(mid_level/recording|high_level/mission)$")
    target_compile_options(lodesman_${name} PRIVATE $<$<CONFIG:None>:-O0>)
  endif()
endfunction()

# lodesman_program(lodesman-low main_low.cpp LINKS ...)
function(lodesman_program name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE lodesman_flags ${ARG_LINKS})
  lodesman_compile_to_ship(${name})
  lodesman_compile_fast(${name})
endfunction()
