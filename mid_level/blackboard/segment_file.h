// SPDX-License-Identifier: Apache-2.0
// The file behind a shared-memory segment: whose it is, which programs live on it, and whether its
// name still leads to it. Two rules make one name one owner, however starts interleave: a name is
// removed only by who holds the low level's lock on the very file it leads to, and a lock counts
// only after the name has been seen to lead to the file that was locked. One thread.
#pragma once

#include <boost/interprocess/mapped_region.hpp>
#include <boost/interprocess/shared_memory_object.hpp>
#include <cstdint>
#include <string>

#include "mid_level/blackboard/channel.h"

namespace lodesman {

class SegmentFile {
 public:
  using Mode = boost::interprocess::mode_t;

  // Throws NotYetError where there is none, StartupError where it cannot be opened.
  [[nodiscard]] static SegmentFile open(const std::string& name, Mode mode);
  // A new one is empty, and for its user alone whatever the umask. Throws StartupError.
  [[nodiscard]] static SegmentFile open_or_create(const std::string& name);

  // Refuses, with StartupError, a file that is not this user's, nor root's where that will do:
  // whoever can write it commands the boat.
  void require_own() const;
  void require_own_or_root() const;

  // Takes the lock of a role, one byte of the file each; false where another program has it. The
  // kernel drops it with the last descriptor, so that a killed program never leaves one behind, and
  // closing another descriptor of the file does no harm (ADR 0002).
  [[nodiscard]] bool lock(Role role) const noexcept;
  [[nodiscard]] bool is_locked(Role role) const noexcept;
  // Whether the name (still) leads to this file.
  [[nodiscard]] bool has_name() const noexcept;
  // Only for who holds the low level's lock. Does nothing where the name is another file's by now.
  void remove_name() const noexcept;

  [[nodiscard]] std::uint64_t size() const noexcept;  // [byte] 0 where it cannot be told
  // Gives the new file memory that is really there, so that no access to it can fail later. Throws
  // StartupError.
  void reserve(std::uint64_t bytes) const;
  void make_private() const noexcept;  // nobody else's, whatever was done to it
  [[nodiscard]] boost::interprocess::mapped_region map(Mode mode) const;  // throws StartupError

 private:
  SegmentFile(std::string name, boost::interprocess::shared_memory_object memory) noexcept;
  [[nodiscard]] int descriptor() const noexcept { return memory_.get_mapping_handle().handle; }
  void require_owner(bool root_will_do) const;

  std::string name_;
  boost::interprocess::shared_memory_object memory_;
};

}  // namespace lodesman
