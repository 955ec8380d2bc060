// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

constexpr std::size_t kPiece_bytes = 65536;
constexpr Duration kFlushPeriod = std::chrono::seconds{1};

[[nodiscard]] std::string reason(const std::filesystem::path& path, int error_number) {
  return path.string() + ": cannot be written: " + std::generic_category().message(error_number);
}

// 0, or the error's number.
[[nodiscard]] int write_all(int descriptor, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno != EINTR) {
      return errno;
    }
    text.remove_prefix(count < 0 ? 0 : static_cast<std::size_t>(count));
  }
  return 0;
}

[[nodiscard]] int open_empty(const std::filesystem::path& path) noexcept {
  return open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

[[noreturn]] void refuse(const std::filesystem::path& path, int error_number) {
  std::error_code ignored;
  std::filesystem::remove(unfinished(path), ignored);
  throw StartupError(reason(path, error_number));
}

}  // namespace

std::filesystem::path unfinished(const std::filesystem::path& path) {
  std::filesystem::path beside = path;
  beside += ".part";
  return beside;
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  ReservedFile{path, 0}.write(text);
}

ReservedFile::ReservedFile(std::filesystem::path path, std::size_t bytes)
    : path_{std::move(path)}, descriptor_{open_empty(unfinished(path_))} {
  const int failed = descriptor_ < 0 ? errno
                     : bytes == 0    ? 0
                                     : posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  if (failed != 0) {
    if (descriptor_ >= 0) {
      close(descriptor_);
    }
    refuse(path_, failed);
  }
}

ReservedFile::~ReservedFile() {
  if (descriptor_ >= 0) {
    close(descriptor_);
    std::error_code ignored;
    std::filesystem::remove(unfinished(path_), ignored);
  }
}

void ReservedFile::write(std::string_view text) {
  const int descriptor = std::exchange(descriptor_, -1);
  int failed = write_all(descriptor, text);
  if (failed == 0 && ftruncate(descriptor, static_cast<off_t>(text.size())) != 0) {
    failed = errno;
  }
  // A full disk may show only here.
  if (close(descriptor) != 0 && failed == 0) {
    failed = errno;
  }
  if (failed == 0 && rename(unfinished(path_).c_str(), path_.c_str()) != 0) {
    failed = errno;
  }
  if (failed != 0) {
    refuse(path_, failed);
  }
}

LineFile::LineFile(std::filesystem::path path)
    : path_{std::move(path)}, descriptor_{open_empty(path_)} {
  if (descriptor_ < 0) {
    throw StartupError(reason(path_, errno));
  }
}

LineFile::~LineFile() {
  flush();
  close(descriptor_);
}

void LineFile::add(std::string_view line) {
  if (!fault_.empty()) {
    return;
  }
  waiting_ += line;
  if (const Time now = SteadyClock{}.now();
      waiting_.size() >= kPiece_bytes || now - flushed_ >= kFlushPeriod) {
    flushed_ = now;
    flush();
  }
}

void LineFile::flush() {
  if (!fault_.empty() || waiting_.empty()) {
    return;
  }
  const off_t start = lseek(descriptor_, 0, SEEK_CUR);
  if (const int failed = write_all(descriptor_, waiting_); failed != 0) {
    fault_ = reason(path_, failed);
    const off_t written = lseek(descriptor_, 0, SEEK_CUR) - start;
    const auto line_end =
        std::string_view{waiting_}.substr(0, static_cast<std::size_t>(written)).rfind('\n');
    const off_t whole = line_end == std::string_view::npos ? 0 : static_cast<off_t>(line_end) + 1;
    static_cast<void>(ftruncate(descriptor_, start + whole) == 0);  // a device has no length
  }
  waiting_.clear();
}

}  // namespace lodesman::cli
