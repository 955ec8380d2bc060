// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/segment.h"

#include <fcntl.h>
#include <unistd.h>

#include <boost/interprocess/mapped_region.hpp>
#include <boost/interprocess/shared_memory_object.hpp>
#include <cstring>
#include <new>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/messages/layout.h"

namespace lodesman {
namespace bip = boost::interprocess;
namespace {

struct SegmentLayout {
  SegmentHeader header;
  Blackboard board;
};

// Byte ranges of the segment that programs lock: one a role.
[[nodiscard]] struct flock role_lock(Role role) noexcept {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(role);
  lock.l_len = 1;
  return lock;
}

// Open-file-description locks: dropped by the kernel when the last descriptor goes, so a killed
// program never leaves one behind, and closing another descriptor of the file does no harm.
[[nodiscard]] bool take_lock(int descriptor, Role role) noexcept {
  auto lock = role_lock(role);
  return fcntl(descriptor, F_OFD_SETLK, &lock) == 0;
}

[[nodiscard]] bool is_locked(int descriptor, Role role) noexcept {
  auto lock = role_lock(role);
  return fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

[[nodiscard]] int descriptor_of(const bip::shared_memory_object& memory) noexcept {
  return memory.get_mapping_handle().handle;
}

[[nodiscard]] bip::shared_memory_object open_object(const std::string& name, bip::mode_t mode) {
  return bip::shared_memory_object{bip::open_only, name.c_str(), mode};
}

class Fnv {
 public:
  void add(const char* text) noexcept {
    for (; *text != '\0'; ++text) {
      add_byte(static_cast<std::uint8_t>(*text));
    }
    add_byte(0);
  }
  void add(std::uint64_t number) noexcept {
    for (int i = 0; i < 8; ++i) {
      add_byte(static_cast<std::uint8_t>(number >> (8 * i)));
    }
  }
  void operator()(const char* text) noexcept { add(text); }
  void operator()(std::uint64_t number) noexcept { add(number); }
  [[nodiscard]] std::uint64_t value() const noexcept { return hash_; }

 private:
  void add_byte(std::uint8_t byte) noexcept { hash_ = (hash_ ^ byte) * 0x100000001b3ULL; }
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

[[nodiscard]] Time deadline_after(Duration patience) { return SteadyClock{}.now() + patience; }

// Polls until `attempt` gives something or the deadline passes; then throws what it last said.
template <class Attempt>
[[nodiscard]] auto wait_for(Duration patience, Attempt attempt) {
  const Time deadline = deadline_after(patience);
  for (;;) {
    try {
      return attempt();
    } catch (const StartupError&) {
      if (SteadyClock{}.now() >= deadline) {
        throw;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
}

}  // namespace

std::uint64_t layout_hash() {
  Fnv hash;
  hash.add(LODESMAN_BUILD);
  hash.add(sizeof(SegmentLayout));
  const auto board = std::make_unique<Blackboard>();
  for_each_channel(*board, [&]<class C>(const ChannelInfo& info, const C& /*channel*/) {
    hash.add(info.name);
    hash.add(C::kSlots);
    hash.add(sizeof(C));
    visit_layout<typename C::Value>(hash);
  });
  return hash.value();
}

std::string header_fault(const SegmentHeader& header, std::uint64_t mapped_bytes) {
  if (mapped_bytes < sizeof(SegmentHeader)) {
    return "is shorter than a header";
  }
  if (header.ready.load(std::memory_order_acquire) != SegmentHeader::kReady) {
    return "is not ready";
  }
  if (header.magic.load(std::memory_order_relaxed) != SegmentHeader::kMagic) {
    return "is no Lodesman segment";
  }
  if (header.layout_hash.load(std::memory_order_relaxed) != layout_hash()) {
    return "was made by a build with another layout; use programs of one build";
  }
  if (header.size_bytes.load(std::memory_order_relaxed) != mapped_bytes ||
      mapped_bytes != sizeof(SegmentLayout)) {
    return "has the wrong size";
  }
  return {};
}

struct SharedBlackboard::Impl {
  std::string name;
  bip::shared_memory_object memory;
  bip::mapped_region region;
  bool owner = false;
  bool writable = false;
  bool found_dead = false;

  [[nodiscard]] SegmentLayout* layout() const noexcept {
    return static_cast<SegmentLayout*>(region.get_address());
  }
};

SharedBlackboard::SharedBlackboard(std::unique_ptr<Impl> impl) noexcept : impl_{std::move(impl)} {}
SharedBlackboard::SharedBlackboard(SharedBlackboard&&) noexcept = default;
SharedBlackboard& SharedBlackboard::operator=(SharedBlackboard&&) noexcept = default;

SharedBlackboard::~SharedBlackboard() {
  if (impl_ != nullptr && impl_->owner) {
    bip::shared_memory_object::remove(impl_->name.c_str());
  }
}

SharedBlackboard SharedBlackboard::create(const std::string& name) {
  auto impl = std::make_unique<Impl>();
  impl->name = name;
  try {
    const auto old = open_object(name, bip::read_write);
    if (!take_lock(descriptor_of(old), Role::kLow)) {
      throw StartupError("segment " + name + " is in use by a running lodesman-low");
    }
    impl->found_dead = true;
    bip::shared_memory_object::remove(name.c_str());
  } catch (const bip::interprocess_exception&) {
    // There is none: the usual case.
  }
  try {
    impl->memory = bip::shared_memory_object{bip::create_only, name.c_str(), bip::read_write};
    if (!take_lock(descriptor_of(impl->memory), Role::kLow)) {
      throw StartupError("segment " + name + " is in use by a running lodesman-low");
    }
    impl->memory.truncate(sizeof(SegmentLayout));
    impl->region = bip::mapped_region{impl->memory, bip::read_write};
  } catch (const bip::interprocess_exception& error) {
    throw StartupError("segment " + name + " cannot be made: " + error.what());
  }
  impl->owner = true;
  impl->writable = true;
  auto* layout = ::new (impl->region.get_address()) SegmentLayout;
  layout->header.magic.store(SegmentHeader::kMagic, std::memory_order_relaxed);
  layout->header.layout_hash.store(layout_hash(), std::memory_order_relaxed);
  layout->header.size_bytes.store(impl->region.get_size(), std::memory_order_relaxed);
  layout->header.creator_pid.store(static_cast<std::uint64_t>(getpid()), std::memory_order_relaxed);
  layout->header.ready.store(SegmentHeader::kReady, std::memory_order_release);
  return SharedBlackboard{std::move(impl)};
}

namespace {

template <class Impl>
[[nodiscard]] std::unique_ptr<Impl> map_existing(const std::string& name, bip::mode_t mode) {
  auto impl = std::make_unique<Impl>();
  impl->name = name;
  try {
    impl->memory = open_object(name, mode);
    bip::offset_t size = 0;
    if (!impl->memory.get_size(size) || size < static_cast<bip::offset_t>(sizeof(SegmentHeader))) {
      throw StartupError("segment " + name + " is shorter than a header");
    }
    impl->region = bip::mapped_region{impl->memory, mode};
  } catch (const bip::interprocess_exception&) {
    throw StartupError("segment " + name + " does not exist: is lodesman-low running?");
  }
  const auto* header = static_cast<const SegmentHeader*>(impl->region.get_address());
  if (const auto fault = header_fault(*header, impl->region.get_size()); !fault.empty()) {
    throw StartupError("segment " + name + " " + fault);
  }
  impl->writable = mode == bip::read_write;
  return impl;
}

}  // namespace

SharedBlackboard SharedBlackboard::open(const std::string& name, Role role, Duration patience) {
  auto impl = wait_for(patience, [&] { return map_existing<Impl>(name, bip::read_write); });
  if (!take_lock(descriptor_of(impl->memory), role)) {
    throw StartupError("segment " + name + ": a program in the same role is running");
  }
  for_each_channel(impl->layout()->board, [&](const ChannelInfo& info, auto& channel) {
    if (info.writer == role) {
      impl->found_dead = impl->found_dead || channel.head.newest.load() != 0;
      channel.release_claim_of(role);
    }
  });
  return SharedBlackboard{std::move(impl)};
}

SharedBlackboard SharedBlackboard::observe(const std::string& name, Duration patience) {
  return SharedBlackboard{
      wait_for(patience, [&] { return map_existing<Impl>(name, bip::read_only); })};
}

Blackboard& SharedBlackboard::writable() noexcept {
  LODESMAN_CHECK(impl_->writable);
  return impl_->layout()->board;
}

const Blackboard& SharedBlackboard::operator*() const noexcept { return impl_->layout()->board; }

bool SharedBlackboard::alive(Role role) const noexcept {
  return is_locked(descriptor_of(impl_->memory), role);
}

bool SharedBlackboard::found_dead() const noexcept { return impl_->found_dead; }

bool remove_dead_segment(const std::string& name) {
  try {
    const auto old = open_object(name, bip::read_write);
    return take_lock(descriptor_of(old), Role::kLow) &&
           bip::shared_memory_object::remove(name.c_str());
  } catch (const bip::interprocess_exception&) {
    return false;
  }
}

}  // namespace lodesman
