// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/jump_points.h"

namespace lodesman {
namespace {

// Jump points are few and pixels many: a hash keeps what a search touches within a cache.
constexpr std::size_t kHashes = 8192;
constexpr std::size_t hash_of(PathPixel pixel) noexcept {
  const auto column = static_cast<std::uint32_t>(pixel.column);
  const auto row = static_cast<std::uint32_t>(pixel.row);
  return (row * 40503U ^ column * 61U) % kHashes;
}

}  // namespace

JumpPoints::JumpPoints(std::size_t capacity)
    : points_(capacity), hash_heads_(kHashes, kNone), arrivals_(capacity) {}

void JumpPoints::clear() noexcept {
  count_ = 0;
  arrival_count_ = 0;
}

std::int32_t JumpPoints::at(PathPixel pixel) noexcept {
  const std::size_t hash = hash_of(pixel);
  std::int32_t& head = hash_heads_.data()[hash];
  JumpPoint* const points = points_.data();
  // What other searches left behind in the heads is told by its not fitting.
  const bool is_own = head >= 0 && head < count_ && hash_of(points[head].pixel) == hash;
  const std::int32_t first = is_own ? head : kNone;
  for (std::int32_t i = first; i != kNone; i = points[i].next) {
    if (same(points[i].pixel, pixel)) {
      return i;
    }
  }
  head = count_++;
  points[head] = {};
  points[head].pixel = pixel;
  points[head].next = first;
  return head;
}

bool JumpPoints::arrive(std::int32_t from, std::int32_t& first) noexcept {
  if (arrival_count_ == static_cast<std::int32_t>(arrivals_.size())) {
    return false;
  }
  arrivals_.data()[arrival_count_] = {from, first};
  first = arrival_count_++;
  return true;
}

}  // namespace lodesman
