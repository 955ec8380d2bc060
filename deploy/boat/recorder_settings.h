// SPDX-License-Identifier: Apache-2.0
// The configuration's section [recorder]: read by every program, so that what is wrong in it is
// refused by all, and used by the recorder. One thread, at start-up; throws StartupError.
#pragma once

#include <cstdint>
#include <string>

#include "mid_level/config/toml_document.h"

namespace lodesman {

struct RecorderSettings {
  std::string directory;
  std::uint64_t rotate_bytes = 0;  // 0: never
  Duration rotate_after{};         // 0: never
  std::uint64_t free_floor_bytes = 0;
  std::size_t queue_bytes = 0;
  Duration chunk_span{};
};

[[nodiscard]] inline RecorderSettings read_recorder(const TomlTable& table) {
  const auto mebibytes = [&](const char* key, std::int64_t least, std::int64_t most) {
    return static_cast<std::uint64_t>(table.integer(key, least, most)) << 20U;
  };
  return {table.text("directory", 4096),
          mebibytes("rotate_mib", 0, 1 << 20),
          table.duration("rotate_after_s", Range::between(0.0, 1e6)),
          mebibytes("free_floor_mib", 0, 1 << 30),
          mebibytes("queue_mib", 4, 256),
          table.duration("chunk_s", Range::between(0.05, 1.0))};
}

}  // namespace lodesman
