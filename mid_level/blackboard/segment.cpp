// SPDX-License-Identifier: Apache-2.0
#include "mid_level/blackboard/segment.h"

#include <unistd.h>

#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "mid_level/base/clock.h"
#include "mid_level/blackboard/segment_file.h"
#include "mid_level/messages/layout.h"

namespace lodesman {
namespace bip = boost::interprocess;
namespace {

struct SegmentLayout {
  SegmentHeader header;
  Blackboard board;
};

constexpr const char* kNotReady = "is not ready";
// Each failed one means that somebody else has just made or removed the segment.
constexpr int kMaxAttempts = 1000;

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
    return kNotReady;
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
  Impl(std::string name_in, SegmentFile file_in)
      : name{std::move(name_in)}, file{std::move(file_in)} {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (owns_name) {
      file.remove_name();
    }
  }

  std::string name;
  SegmentFile file;
  bip::mapped_region region;
  bool owns_name = false;  // by the low level's lock
  bool writable = false;
  bool found_dead = false;
  std::string legacy;

  [[nodiscard]] SegmentLayout* layout() const noexcept {
    return static_cast<SegmentLayout*>(region.get_address());
  }

  void map(bip::mode_t mode) {
    region = file.map(mode);
    writable = mode == bip::read_write;
  }

  // Why the mapped segment cannot be used; empty when it can.
  [[nodiscard]] std::string fault() const {
    return header_fault(*static_cast<const SegmentHeader*>(region.get_address()),
                        region.get_size());
  }

  void make() {
    file.reserve(sizeof(SegmentLayout));
    map(bip::read_write);
    SegmentHeader& header = (::new (region.get_address()) SegmentLayout)->header;
    header.magic.store(SegmentHeader::kMagic, std::memory_order_relaxed);
    header.layout_hash.store(layout_hash(), std::memory_order_relaxed);
    header.size_bytes.store(region.get_size(), std::memory_order_relaxed);
    header.ready.store(SegmentHeader::kReady, std::memory_order_release);
  }

  // Goes on with a dead low level's segment: the file, and with it everyone who has it mapped,
  // stays. Gives why that cannot be; empty when it is done.
  [[nodiscard]] std::string adopt() {
    if (file.size() != sizeof(SegmentLayout)) {
      return "has the wrong size";
    }
    map(bip::read_write);
    std::string unfit = fault();
    if (!unfit.empty()) {
      return unfit;
    }
    for_each_channel(layout()->board, [&](const ChannelInfo& info, const auto& channel) {
      if (unfit.empty() && !channel.is_sound(info.writer)) {
        unfit = std::string{"holds a broken channel, "} + info.name;
      }
    });
    if (unfit.empty()) {
      file.make_private();
      free_claims_of(Role::kLow);
    }
    return unfit;
  }

  // Of a program that is dead, as who holds its role's lock knows. Only who died holds claims: at
  // an orderly end they are given up.
  void free_claims_of(Role role) noexcept {
    for_each_channel(layout()->board, [&](const ChannelInfo& /*info*/, auto& channel) {
      found_dead |= channel.release_claim_of(role);
    });
  }
};

SharedBlackboard::SharedBlackboard(std::unique_ptr<Impl> impl) noexcept : impl_{std::move(impl)} {}
SharedBlackboard::SharedBlackboard(SharedBlackboard&&) noexcept = default;
SharedBlackboard& SharedBlackboard::operator=(SharedBlackboard&&) noexcept = default;
SharedBlackboard::~SharedBlackboard() = default;

SharedBlackboard SharedBlackboard::create(const std::string& name) {
  std::string replaced;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    auto impl = std::make_unique<Impl>(name, SegmentFile::open_or_create(name));
    impl->file.require_own();
    const bool locked = impl->file.lock(Role::kLow);
    if (!impl->file.has_name()) {
      continue;  // removed between the two: it is nobody's segment any more
    }
    if (!locked) {
      break;
    }
    impl->owns_name = true;
    if (impl->file.size() == 0) {
      impl->make();
      impl->legacy = std::move(replaced);
      return SharedBlackboard{std::move(impl)};
    }
    const std::string unfit = impl->adopt();
    if (unfit.empty()) {
      impl->legacy = "taken over from a lodesman-low that died";
      return SharedBlackboard{std::move(impl)};
    }
    // Its name goes with `impl`; the next attempt makes a new file.
    replaced = "made anew: what was there " + unfit;
  }
  throw StartupError("segment " + name + " is in use by a running lodesman-low");
}

namespace {

// The segment as it is mapped by who did not make it.
template <class Impl>
[[nodiscard]] std::unique_ptr<Impl> map_existing(const std::string& name, bip::mode_t mode) {
  auto impl = std::make_unique<Impl>(name, SegmentFile::open(name, mode));
  impl->file.require_own_or_root();
  if (impl->file.size() < sizeof(SegmentHeader)) {
    throw NotYetError("segment " + name + " is not ready");
  }
  impl->map(mode);
  if (const auto fault = impl->fault(); fault == kNotReady) {
    throw NotYetError("segment " + name + " " + fault);
  } else if (!fault.empty()) {
    throw StartupError("segment " + name + " " + fault);
  }
  return impl;
}

}  // namespace

SharedBlackboard SharedBlackboard::open(const std::string& name, Role role, Duration patience) {
  return wait_for(patience, [&] {
    auto impl = map_existing<Impl>(name, bip::read_write);
    if (!impl->file.is_locked(Role::kLow)) {
      throw NotYetError("segment " + name + " was left by a lodesman-low that died");
    }
    if (!impl->file.lock(role)) {
      throw StartupError("segment " + name + ": a program in the same role is running");
    }
    if (!impl->file.has_name()) {
      throw NotYetError("segment " + name + " has just been removed");
    }
    impl->free_claims_of(role);
    return SharedBlackboard{std::move(impl)};
  });
}

SharedBlackboard SharedBlackboard::observe(const std::string& name, Duration patience) {
  return wait_for(patience,
                  [&] { return SharedBlackboard{map_existing<Impl>(name, bip::read_only)}; });
}

Blackboard& SharedBlackboard::writable() noexcept {
  LODESMAN_CHECK(impl_->writable);
  return impl_->layout()->board;
}

const Blackboard& SharedBlackboard::operator*() const noexcept { return impl_->layout()->board; }

bool SharedBlackboard::alive(Role role) const noexcept { return impl_->file.is_locked(role); }

bool SharedBlackboard::is_superseded() const {
  if (alive(Role::kLow) || impl_->file.has_name()) {
    return false;
  }
  try {
    return SegmentFile::open(impl_->name, bip::read_only).is_locked(Role::kLow);
  } catch (const StartupError&) {
    return false;
  }
}

bool SharedBlackboard::found_dead() const noexcept { return impl_->found_dead; }

const std::string& SharedBlackboard::legacy() const noexcept { return impl_->legacy; }

bool remove_dead_segment(const std::string& name) {
  try {
    const auto file = SegmentFile::open(name, bip::read_write);
    file.require_own();
    const bool is_dead = file.lock(Role::kLow) && file.lock(Role::kHigh) && file.has_name();
    if (is_dead) {
      file.remove_name();
    }
    return is_dead;
  } catch (const StartupError&) {
    return false;
  }
}

}  // namespace lodesman
