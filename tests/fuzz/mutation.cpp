// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace lodesman::fuzz {
namespace {

constexpr std::size_t kMaxBytes = 1U << 16U;  // of an input: it could double for ever

// The library's distributions differ between machines; their generators do not.
[[nodiscard]] std::size_t below(std::size_t end, std::mt19937_64& chance) {
  return end == 0 ? 0 : chance() % end;
}

struct Part {
  std::size_t at = 0;
  std::size_t size = 0;
};

[[nodiscard]] Part part_of(const std::string& text, std::mt19937_64& chance) {
  const std::size_t at = below(text.size(), chance);
  const std::size_t left = text.size() - at;
  return {at, below(std::min<std::size_t>(left, 64) + 1, chance)};
}

[[nodiscard]] std::string_view edge_word(std::mt19937_64& chance) {
  using namespace std::string_view_literals;
  static constexpr std::array kWords{"nan"sv,    "-inf"sv,
                                     "-0"sv,     "1e400"sv,
                                     "1e-400"sv, "99999999999999999999"sv,
                                     "-1"sv,     "0x7f"sv,
                                     "[["sv,     "{"sv,
                                     "}"sv,      "]"sv,
                                     "\"\"\""sv, "'"sv,
                                     "#"sv,      "\n"sv,
                                     "\r\n"sv,   "\0"sv,
                                     "\xff"sv,   "\xef\xbb\xbf"sv,
                                     "."sv,      "="sv,
                                     ","sv,      ":"sv,
                                     "\\u0000"sv};
  return kWords[below(kWords.size(), chance)];
}

void change(std::string& text, std::span<const std::string> others, std::mt19937_64& chance) {
  const Part part = part_of(text, chance);
  switch (below(7, chance)) {
    case 0:
      if (!text.empty()) {
        text[part.at] = static_cast<char>(text[part.at] ^ (1 << below(8, chance)));
      }
      break;
    case 1: text.erase(part.at, part.size); break;
    case 2: text.insert(part.at, text.substr(part.at, part.size)); break;
    case 3: text.resize(part.at); break;
    case 4: text.insert(part.at, edge_word(chance)); break;
    case 5: text.replace(part.at, part.size, edge_word(chance)); break;
    default: {
      const std::string& other = others[below(others.size(), chance)];
      const Part from = part_of(other, chance);
      text.replace(part.at, part.size, other, from.at, from.size);
    }
  }
}

}  // namespace

std::string mutated(const std::string& seed, std::span<const std::string> others,
                    std::mt19937_64& chance) {
  std::string text = seed.substr(0, kMaxBytes);
  for (std::size_t changes = 1 + below(4, chance); changes > 0; --changes) {
    change(text, others, chance);
  }
  return text;
}

}  // namespace lodesman::fuzz
