// SPDX-License-Identifier: Apache-2.0
// A recording's file in memory, on a disk that may be full or fail. One thread.
#pragma once

#include <cerrno>
#include <cstdint>
#include <memory>
#include <vector>

#include "mid_level/recording/record_file.h"

namespace lodesman::testing {

// What is left of a file once its writer has gone.
struct Disk {
  std::vector<std::byte> bytes;
  std::uint64_t room_bytes = UINT64_MAX;  // of the file, before the disk is full
  int full_error = ENOSPC;
  int sync_error = 0;
  unsigned syncs = 0;
  bool kept = false;
};

class MemoryFile : public RecordFile {
 public:
  explicit MemoryFile(Disk& disk) noexcept : disk_{disk} {}

  // As a disk does: what there is room for is written before the error.
  [[nodiscard]] int write(std::span<const std::byte> bytes) noexcept override {
    const std::uint64_t room =
        disk_.room_bytes > disk_.bytes.size() ? disk_.room_bytes - disk_.bytes.size() : 0;
    const std::uint64_t fits = std::min<std::uint64_t>(room, bytes.size());
    const auto written = bytes.first(static_cast<std::size_t>(fits));
    disk_.bytes.insert(disk_.bytes.end(), written.begin(), written.end());
    return fits < bytes.size() ? disk_.full_error : 0;
  }
  [[nodiscard]] int cut_to(std::uint64_t size_bytes) noexcept override {
    disk_.bytes.resize(static_cast<std::size_t>(size_bytes));
    return 0;
  }
  [[nodiscard]] int sync() noexcept override {
    ++disk_.syncs;
    return disk_.sync_error;
  }
  [[nodiscard]] int keep() noexcept override {
    disk_.kept = true;
    return 0;
  }

 private:
  Disk& disk_;
};

}  // namespace lodesman::testing
