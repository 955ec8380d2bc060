// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/segment_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <boost/interprocess/permissions.hpp>
#include <cerrno>
#include <system_error>
#include <utility>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace bip = boost::interprocess;
namespace {

constexpr int kOwnersAlone = S_IRUSR | S_IWUSR;

[[nodiscard]] struct flock lock_of(Role role) noexcept {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(role);
  lock.l_len = 1;
  return lock;
}

[[nodiscard]] std::string words_for(int error_number) {
  return std::generic_category().message(error_number);
}

[[noreturn]] void refuse(const std::string& name, const bip::interprocess_exception& error) {
  throw StartupError("segment " + name +
                     " cannot be opened: " + words_for(static_cast<int>(error.get_native_error())));
}

}  // namespace

SegmentFile::SegmentFile(std::string name, bip::shared_memory_object memory) noexcept
    : name_{std::move(name)}, memory_{std::move(memory)} {}

SegmentFile SegmentFile::open(const std::string& name, Mode mode) {
  try {
    return {name, bip::shared_memory_object{bip::open_only, name.c_str(), mode}};
  } catch (const bip::interprocess_exception& error) {
    if (error.get_error_code() == bip::not_found_error) {
      throw NotYetError("segment " + name + " does not exist: is lodesman-low running?");
    }
    refuse(name, error);
  }
}

SegmentFile SegmentFile::open_or_create(const std::string& name) {
  try {
    return {name, bip::shared_memory_object{bip::open_or_create, name.c_str(), bip::read_write,
                                            bip::permissions{kOwnersAlone}}};
  } catch (const bip::interprocess_exception& error) {
    refuse(name, error);
  }
}

void SegmentFile::require_own() const { require_owner(false); }
void SegmentFile::require_own_or_root() const { require_owner(true); }

void SegmentFile::require_owner(bool root_will_do) const {
  struct stat file {};
  const bool known = fstat(descriptor(), &file) == 0;
  if (!known || (file.st_uid != geteuid() && !(root_will_do && file.st_uid == 0))) {
    throw StartupError("segment " + name_ + " belongs to another user (" +
                       std::to_string(file.st_uid) + ")");
  }
}

bool SegmentFile::lock(Role role) const noexcept {
  auto lock = lock_of(role);
  return fcntl(descriptor(), F_OFD_SETLK, &lock) == 0;
}

bool SegmentFile::is_locked(Role role) const noexcept {
  auto lock = lock_of(role);
  return fcntl(descriptor(), F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

bool SegmentFile::has_name() const noexcept {
  struct stat file {};
  if (fstat(descriptor(), &file) != 0 || file.st_nlink == 0) {
    return false;
  }
  try {
    const bip::shared_memory_object named{bip::open_only, name_.c_str(), bip::read_only};
    struct stat other {};
    return fstat(named.get_mapping_handle().handle, &other) == 0 && other.st_ino == file.st_ino &&
           other.st_dev == file.st_dev;
  } catch (const bip::interprocess_exception&) {
    return false;
  }
}

void SegmentFile::remove_name() const noexcept {
  if (has_name()) {
    bip::shared_memory_object::remove(name_.c_str());
  }
}

std::uint64_t SegmentFile::size() const noexcept {
  bip::offset_t bytes = 0;
  return memory_.get_size(bytes) && bytes > 0 ? static_cast<std::uint64_t>(bytes) : 0;
}

void SegmentFile::reserve(std::uint64_t bytes) const {
  int error_number = EINTR;
  while (error_number == EINTR) {
    error_number = posix_fallocate(descriptor(), 0, static_cast<off_t>(bytes));
  }
  if (error_number != 0) {
    throw StartupError("segment " + name_ + " cannot be made: no shared memory for its " +
                       std::to_string(bytes) + " bytes: " + words_for(error_number));
  }
}

void SegmentFile::make_private() const noexcept {
  // It is this user's file: what could fail has been refused before.
  static_cast<void>(fchmod(descriptor(), kOwnersAlone));
}

bip::mapped_region SegmentFile::map(Mode mode) const {
  try {
    return {memory_, mode};
  } catch (const bip::interprocess_exception& error) {
    throw StartupError("segment " + name_ + " cannot be mapped: " +
                       words_for(static_cast<int>(error.get_native_error())));
  }
}

}  // namespace lodesman
