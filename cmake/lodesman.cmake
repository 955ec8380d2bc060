# SPDX-License-Identifier: Apache-2.0
# How every room, program and test of this project is compiled, said once.

add_library(lodesman_flags INTERFACE)
target_include_directories(lodesman_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(lodesman_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion
  -Wold-style-cast -Wnon-virtual-dtor -Wimplicit-fallthrough -Wfloat-equal -Werror
  -ffp-contract=off)
# GCC 12 sees overlaps in std::string and unset values in std::optional that are not there when it
# optimises (its bugs 105651 and 80635); clang and the sanitizers watch for the real ones.
target_compile_options(lodesman_flags INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-maybe-uninitialized>)
target_compile_definitions(lodesman_flags INTERFACE _GLIBCXX_ASSERTIONS)
target_link_libraries(lodesman_flags INTERFACE Threads::Threads)

# One static library a room: lodesman_room(low_level/path grid.cpp search.cpp LINKS lodesman::messages)
# makes the target lodesman::path.
function(lodesman_room room)
  cmake_parse_arguments(ARG "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  get_filename_component(name ${room} NAME)
  add_library(lodesman_${name} STATIC ${ARG_UNPARSED_ARGUMENTS})
  add_library(lodesman::${name} ALIAS lodesman_${name})
  target_link_libraries(lodesman_${name} PUBLIC lodesman_flags ${ARG_LINKS}
                                         PRIVATE ${ARG_PRIVATE_LINKS})
endfunction()

# lodesman_program(lodesman-low main_low.cpp LINKS ...)
function(lodesman_program name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE lodesman_flags ${ARG_LINKS})
endfunction()
