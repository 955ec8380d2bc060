// SPDX-License-Identifier: Apache-2.0
// The blackboard in shared memory: made by lodesman-low, opened by the others after its header has
// been checked. Who is alive is judged by locks on the segment itself, which the kernel drops with
// their process, never by process numbers. One thread, at start-up and shut-down.
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
  std::atomic<std::uint64_t> creator_pid{0};  // for people; nothing is decided by it
  std::atomic<std::uint64_t> ready{0};
};

// What two programs must agree on to share a blackboard: every channel's name, size and fields.
[[nodiscard]] std::uint64_t layout_hash();

// Why a mapped header cannot be used; empty when it can. `mapped_bytes` is what really is mapped.
[[nodiscard]] std::string header_fault(const SegmentHeader& header, std::uint64_t mapped_bytes);

class SharedBlackboard {
 public:
  // Makes the segment, for the low level. A dead one of that name is cleaned away; a live one is
  // refused with StartupError.
  [[nodiscard]] static SharedBlackboard create(const std::string& name);
  // Opens it for a program that writes, waiting up to `patience` until it is ready. The claims of
  // a dead program in the same role are freed; a live one is refused.
  [[nodiscard]] static SharedBlackboard open(const std::string& name, Role role, Duration patience);
  // Maps it read-only, for a program that only looks on.
  [[nodiscard]] static SharedBlackboard observe(const std::string& name, Duration patience);

  SharedBlackboard(const SharedBlackboard&) = delete;
  SharedBlackboard& operator=(const SharedBlackboard&) = delete;
  SharedBlackboard(SharedBlackboard&&) noexcept;
  SharedBlackboard& operator=(SharedBlackboard&&) noexcept;
  // The maker also removes the name.
  ~SharedBlackboard();

  [[nodiscard]] Blackboard& writable() noexcept;  // not for an observer
  [[nodiscard]] const Blackboard& operator*() const noexcept;
  [[nodiscard]] const Blackboard* operator->() const noexcept { return &**this; }

  // Whether a program in that role (kLow or kHigh) holds its lock.
  [[nodiscard]] bool alive(Role role) const noexcept;
  // Whether a dead program in this one's role had left the segment behind.
  [[nodiscard]] bool found_dead() const noexcept;

 private:
  struct Impl;
  explicit SharedBlackboard(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

// Removes a segment if no living program holds it; true when it did.
bool remove_dead_segment(const std::string& name);

}  // namespace lodesman
