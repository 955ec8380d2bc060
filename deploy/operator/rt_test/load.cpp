// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/load.h"

#include <array>

namespace lodesman::cli {
namespace {

constexpr std::array kKinds{LoadKind::kIdle, LoadKind::kCpu, LoadKind::kAll};

}  // namespace

const char* to_string(LoadKind kind) noexcept {
  switch (kind) {
    case LoadKind::kIdle: return "idle";
    case LoadKind::kCpu: return "cpu";
    case LoadKind::kAll: break;
  }
  return "all";
}

std::optional<LoadKind> load_named(std::string_view name) noexcept {
  for (const LoadKind kind : kKinds) {
    if (name == to_string(kind)) {
      return kind;
    }
  }
  return std::nullopt;
}

std::vector<std::string> load_words(LoadKind kind, unsigned cores, unsigned longest_s) {
  if (kind == LoadKind::kIdle) {
    return {};
  }
  std::vector<std::string> words{"stress-ng", "--quiet",
                                 "--timeout", std::to_string(longest_s) + "s",
                                 "--cpu",     std::to_string(cores)};
  if (kind == LoadKind::kAll) {
    for (const char* word :
         {"--vm",         "1",   "--vm-bytes",  "64M", "--hdd",    "1", "--hdd-bytes", "32M",
          "--sock",       "1",   "--pipe",      "1",   "--switch", "1", "--mmap",      "1",
          "--mmap-bytes", "16M", "--temp-path", "."}) {
      words.emplace_back(word);
    }
  }
  return words;
}

}  // namespace lodesman::cli
