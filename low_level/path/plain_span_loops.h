// SPDX-License-Identifier: Apache-2.0
// The loops of span_loops.h for any machine. Pure functions of their arguments; any thread.
#pragma once

#include <algorithm>
#include <cmath>

#include "low_level/path/span_loops.h"

namespace lodesman {

// In float numbers the ends of a tame ellipse are off by less than half of kUnsure, as long as the
// line is not among the first and last, where less than kFlat is left under the root. (The root
// magnifies an error of q by the ellipse's proportions over the root of kFlat, by 80 at most; q and
// all places are below 1600 and so exact to 2^-14.) An end that lies no nearer than kUnsure to a
// place's centre is therefore on the side that it seems.
inline constexpr float kUnsure = 1.0F / 256.0F;
inline constexpr float kFlat = 1.0F / 64.0F;

inline void work_out_spans(SpanBatch& batch, const Conic& conic, int first_line, int count,
                           int length) noexcept {
  // Places are counted from one that lies before all of the ellipse: a conversion to int then
  // rounds down.
  constexpr int kBefore = 1024;
  const int base = static_cast<int>(std::floor(conic.centre_p)) - kBefore;
  const auto centre = static_cast<float>(conic.centre_p - base);
  const auto begin = static_cast<float>(first_line - conic.centre_q);
  const auto per_height = static_cast<float>(1.0 / conic.height);
  const auto chord = static_cast<float>(conic.chord);
  const auto slope = static_cast<float>(conic.slope);
  // Between the last place before the view and its first, and between its last and the next:
  // nowhere near a place's centre.
  const float before_view = static_cast<float>(-base) - 0.75F;
  const float view_end = static_cast<float>(length - base) - 0.75F;
  const int whole_vectors = (count + SpanBatch::kGroup - 1) & -SpanBatch::kGroup;
  for (int i = 0; i < whole_vectors; ++i) {
    const float q = begin + static_cast<float>(i);
    const float share = q * per_height;
    const float left = 1.0F - share * share;
    const float half = chord * std::sqrt(std::max(left, 0.0F));
    const float middle = centre - slope * q;
    const float low = std::min(std::max(middle - half, before_view), view_end);
    const float high = std::min(std::max(middle + half, before_view), view_end);
    const auto below_low = static_cast<std::int32_t>(low);
    const auto below_high = static_cast<std::int32_t>(high);
    const float off_low = std::abs(low - static_cast<float>(below_low) - 0.5F);
    const float off_high = std::abs(high - static_cast<float>(below_high) - 0.5F);
    batch.first.data()[i] = below_low + 1 + base;
    batch.last.data()[i] = below_high + base;
    batch.surety.data()[i] = std::min(0.5F - kUnsure - std::max(off_low, off_high), left - kFlat);
  }
}

inline bool spans_touch(const SpanBatch& batch, int from, int to) noexcept {
  const std::int32_t* const first = batch.first.data();
  const std::int32_t* const last = batch.last.data();
  std::int32_t gap = last[from] - first[from];
  for (int i = from + 1; i < to; ++i) {
    gap |= (last[i] - first[i]) | (last[i - 1] + 1 - first[i]) | (last[i] + 1 - first[i - 1]);
  }
  return gap >= 0;
}

inline void block_spans(std::uint64_t* words, std::ptrdiff_t stride, LineSpan, int count,
                        const std::int32_t* first, const std::int32_t* last) noexcept {
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  for (int i = 0; i < count; ++i) {
    if (first[i] > last[i]) {
      continue;
    }
    std::uint64_t* const line = words + i;
    const int first_word = first[i] >> 6;
    const int last_word = last[i] >> 6;
    const std::uint64_t before = ~(kAll << (first[i] & 63));
    const std::uint64_t after = ~std::uint64_t{1} << (last[i] & 63);
    if (first_word == last_word) {
      line[first_word * stride] &= before | after;
      continue;
    }
    line[first_word * stride] &= before;
    line[last_word * stride] &= after;
    for (int word = first_word + 1; word < last_word; ++word) {
      line[word * stride] = 0;
    }
  }
}

inline constexpr SpanLoops kPlainSpanLoops{work_out_spans, spans_touch, block_spans};

}  // namespace lodesman
