// SPDX-License-Identifier: Apache-2.0
// Owns one file descriptor and closes it. Moved from thread to thread with whoever owns it; not
// shared.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <utility>

namespace lodesman {

// Of what read, write and their like return: an error has moved nothing.
[[nodiscard]] constexpr std::size_t count_of(ssize_t result) noexcept {
  return result > 0 ? static_cast<std::size_t>(result) : 0;
}

class FileDescriptor {
 public:
  FileDescriptor() noexcept = default;
  explicit FileDescriptor(int value) noexcept : value_{value} {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&& other) noexcept : value_{std::exchange(other.value_, -1)} {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~FileDescriptor() {
    if (value_ >= 0) {
      close(value_);
    }
  }

  [[nodiscard]] bool is_open() const noexcept { return value_ >= 0; }
  [[nodiscard]] int value() const noexcept { return value_; }

 private:
  int value_ = -1;
};

}  // namespace lodesman
