// SPDX-License-Identifier: Apache-2.0
// The house rules about what is called: they hold for what the compiler made of a room, whatever
// the call looked like in its source and whichever header it came from. Pure; one thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/tidy/rules.h"

namespace lodesman::tidy {

// What must not be called, by the whole name of a symbol, in some places but for others. A place is
// a room, as "low_level/path", a source file in it, or, when empty, everything.
struct SymbolRule {
  const char* name;
  const char* pattern;
  std::vector<std::string_view> places;
  std::vector<std::string_view> but_for;
};

[[nodiscard]] const std::vector<SymbolRule>& symbol_rules();

// A symbol that a source file needs from elsewhere.
struct NeededSymbol {
  std::string source;  // "low_level/path/grid.cpp"
  std::string symbol;  // demangled
};

// Of what `nm -A -u --demangle` prints of a room's library.
[[nodiscard]] std::vector<NeededSymbol> needed_symbols(const std::string& room,
                                                       const std::string& nm_output);

[[nodiscard]] Findings forbidden_symbols(const SymbolRule& rule,
                                         const std::vector<NeededSymbol>& symbols);

}  // namespace lodesman::tidy
