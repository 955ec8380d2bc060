// SPDX-License-Identifier: Apache-2.0
// Where a recording's bytes go: a file that only grows, and can be cut back to its last whole
// record when a write has failed. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace lodesman {

class RecordFile {
 public:
  RecordFile() = default;
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;
  virtual ~RecordFile() = default;

  // Each gives 0, or the error's number (errno). A write that fails may have written some.
  [[nodiscard]] virtual int write(std::span<const std::byte> bytes) noexcept = 0;
  [[nodiscard]] virtual int cut_to(std::uint64_t size_bytes) noexcept = 0;
  // What was written is on the disk once it returns.
  [[nodiscard]] virtual int sync() noexcept = 0;
  // It is whole: from now on it has its own name. Nothing is written after that.
  [[nodiscard]] virtual int keep() noexcept = 0;
};

// Under its name with `.part` behind it until it is kept.
class DiskFile final : public RecordFile {
 public:
  // Makes it. Throws StartupError where that cannot be, or where something of either name is there.
  explicit DiskFile(std::filesystem::path path);
  DiskFile(const DiskFile&) = delete;
  DiskFile& operator=(const DiskFile&) = delete;
  ~DiskFile() override;

  [[nodiscard]] int write(std::span<const std::byte> bytes) noexcept override;
  [[nodiscard]] int cut_to(std::uint64_t size_bytes) noexcept override;
  [[nodiscard]] int sync() noexcept override;
  [[nodiscard]] int keep() noexcept override;

  // What it is called until then.
  [[nodiscard]] static std::filesystem::path part_of(const std::filesystem::path& path);

 private:
  std::filesystem::path path_;
  std::filesystem::path part_;
  int descriptor_ = -1;
};

}  // namespace lodesman
