// SPDX-License-Identifier: Apache-2.0
// The blackboard in shared memory: made by lodesman-low, or taken over from one that died, and
// opened by the others after its header has been checked. Who is alive is judged by locks on the
// segment itself, which the kernel drops with their process, never by process numbers (ADR 0002,
// ADR 0017). One thread, at start-up and shut-down.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

// The first bytes of a segment. `ready` is stored last, when everything behind it is in place.
struct SegmentHeader {
  static constexpr std::uint64_t kMagic = 0x4c4f4445534d414eULL;  // "LODESMAN"
  static constexpr std::uint64_t kReady = 0x7265616479ULL;

  std::atomic<std::uint64_t> magic{0};
  std::atomic<std::uint64_t> layout_hash{0};
  std::atomic<std::uint64_t> size_bytes{0};
  std::atomic<std::uint64_t> ready{0};
};

// What two programs must agree on to share a blackboard: every channel's name, size and fields.
[[nodiscard]] std::uint64_t layout_hash();

// Why a mapped header cannot be used; empty when it can. `mapped_bytes` is what really is mapped.
[[nodiscard]] std::string header_fault(const SegmentHeader& header, std::uint64_t mapped_bytes);

class SharedBlackboard {
 public:
  // For the low level. Where there is none, makes the segment, of memory that is really there.
  // Takes over a dead one of this build, with all that is in it: whoever has it mapped goes on.
  // Makes another dead one anew. Refuses, with StartupError, one that is alive or another user's.
  [[nodiscard]] static SharedBlackboard create(const std::string& name);
  // Opens it for a program that writes. Waits up to `patience` until there is one that a living low
  // level holds, then throws NotYetError; StartupError where it is another user's or another
  // build's, or a program in the same role is running. The claims of a dead one are freed.
  [[nodiscard]] static SharedBlackboard open(const std::string& name, Role role, Duration patience);
  // Maps it read-only, dead or alive, for a program that only looks on. Throws as open() does.
  [[nodiscard]] static SharedBlackboard observe(const std::string& name, Duration patience);

  SharedBlackboard(const SharedBlackboard&) = delete;
  SharedBlackboard& operator=(const SharedBlackboard&) = delete;
  SharedBlackboard(SharedBlackboard&&) noexcept;
  SharedBlackboard& operator=(SharedBlackboard&&) noexcept;
  // The low level's also removes the name, unless that is another file's by now.
  ~SharedBlackboard();

  [[nodiscard]] Blackboard& writable() noexcept;  // not for an observer
  [[nodiscard]] const Blackboard& operator*() const noexcept;
  [[nodiscard]] const Blackboard* operator->() const noexcept { return &**this; }

  // Whether another program in that role (kLow or kHigh) holds its lock.
  [[nodiscard]] bool alive(Role role) const noexcept;
  // Whether a living low level has made another segment of this name: this one is left for good.
  [[nodiscard]] bool is_superseded() const;
  // Whether a program in this one's role died here: it held claims that it never gave up.
  [[nodiscard]] bool found_dead() const noexcept;
  // What the low level found under the name and did with it, for people; empty for nothing.
  [[nodiscard]] const std::string& legacy() const noexcept;

 private:
  struct Impl;
  explicit SharedBlackboard(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

// Removes this user's segment if no living program in either role holds it; true when it did.
bool remove_dead_segment(const std::string& name);

}  // namespace lodesman
