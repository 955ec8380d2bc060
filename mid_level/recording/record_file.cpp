// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/record_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

// So that a name survives a power cut too.
void sync_directory(const std::filesystem::path& directory) noexcept {
  const int opened =
      open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened >= 0) {
    static_cast<void>(fsync(opened) == 0);
    close(opened);
  }
}

}  // namespace

std::filesystem::path DiskFile::part_of(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part += ".part";
  return part;
}

DiskFile::DiskFile(std::filesystem::path path) : path_{std::move(path)}, part_{part_of(path_)} {
  std::error_code error;
  const bool is_there = std::filesystem::exists(std::filesystem::symlink_status(path_, error));
  descriptor_ = is_there ? -1 : open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw StartupError(path_.string() + ": cannot be made: " +
                       std::generic_category().message(is_there ? EEXIST : errno));
  }
  // For whoever asks whether it is still being written; goes with this process, however that ends.
  static_cast<void>(flock(descriptor_, LOCK_EX | LOCK_NB));
  sync_directory(path_.parent_path());
}

DiskFile::~DiskFile() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

int DiskFile::write(std::span<const std::byte> bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) {
      return errno;
    }
    bytes = bytes.subspan(count < 0 ? 0 : static_cast<std::size_t>(count));
  }
  return 0;
}

int DiskFile::cut_to(std::uint64_t size_bytes) noexcept {
  const auto size = static_cast<off_t>(size_bytes);
  return ftruncate(descriptor_, size) == 0 && lseek(descriptor_, size, SEEK_SET) == size ? 0
                                                                                         : errno;
}

int DiskFile::sync() noexcept { return fdatasync(descriptor_) == 0 ? 0 : errno; }

int DiskFile::keep() noexcept {
  if (const int failed = sync(); failed != 0) {
    return failed;
  }
  // A full disk of another machine's may show only here.
  if (close(std::exchange(descriptor_, -1)) != 0) {
    return errno;
  }
  // Never over another file, which rename() would do.
  if (link(part_.c_str(), path_.c_str()) == 0) {
    unlink(part_.c_str());
  } else if (errno == EEXIST || rename(part_.c_str(), path_.c_str()) != 0) {
    return errno;  // where there are no links (FAT), a rename has to do
  }
  sync_directory(path_.parent_path());
  return 0;
}

}  // namespace lodesman
