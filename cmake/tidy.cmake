# SPDX-License-Identifier: Apache-2.0
# The target `tidy`: clang-tidy over every source of the compile database, on every core. It compiles
# nothing, goes on after a finding, and fails if there was one. .clang-tidy says what is checked.
find_program(RUN_CLANG_TIDY run-clang-tidy REQUIRED)

# What the preset `analyze` adds: what is slow and seldom finds anything.
set(more_checks
  clang-analyzer-*
  bugprone-assert-side-effect
  bugprone-dangling-handle
  bugprone-infinite-loop
  bugprone-not-null-terminated-result
  bugprone-sizeof-expression
  bugprone-stringview-nullptr
  bugprone-suspicious-string-compare
  bugprone-undelegated-constructor
  bugprone-unused-raii
  bugprone-unused-return-value
  bugprone-use-after-move
  cppcoreguidelines-slicing
  cppcoreguidelines-virtual-class-destructor
  misc-definitions-in-headers
  performance-move-const-arg
  performance-unnecessary-value-param)
string(JOIN "," more_checks ${more_checks})

add_custom_target(tidy
  COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR}
          $<$<BOOL:${LODESMAN_TIDY_MORE}>:-checks=${more_checks}>
  COMMAND_EXPAND_LISTS USES_TERMINAL VERBATIM)
