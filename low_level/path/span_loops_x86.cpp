// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "low_level/path/plain_span_loops.h"

namespace lodesman {
namespace {

// The plain loops again: compilers make wider vectors of them here. Floats are not contracted
// (cmake/lodesman.cmake), so that the results are the same.
[[gnu::target("avx2"), gnu::flatten]] void work_out_wide(SpanBatch& batch, const Conic& conic,
                                                         int first_line, int count,
                                                         int length) noexcept {
  work_out_spans(batch, conic, first_line, count, length);
}
[[gnu::target("avx2"), gnu::flatten]] bool touch_wide(const SpanBatch& batch, int from,
                                                      int to) noexcept {
  return spans_touch(batch, from, to);
}

// Of four words with their lowest bits at `base`, the bits from a place on.
[[gnu::target("avx2")]] __m256i bits_from(const std::int32_t* places, int base) noexcept {
  const __m128i four = _mm_loadu_si128(reinterpret_cast<const __m128i*>(places));
  const __m128i bits =
      _mm_max_epi32(_mm_sub_epi32(four, _mm_set1_epi32(base)), _mm_setzero_si128());
  // A shift by 64 and more leaves nothing.
  return _mm256_sllv_epi64(_mm256_set1_epi64x(-1), _mm256_cvtepi32_epi64(bits));
}

// Word by word, four lines at a time, and the last four twice where they are fewer. By hand, since
// shifts by different amounts are what GCC 12 makes no vectors of.
[[gnu::target("avx2")]] void block_wide(std::uint64_t* words, std::ptrdiff_t stride,
                                        LineSpan places, int count, const std::int32_t* first,
                                        const std::int32_t* last) noexcept {
  if (count < 4) {
    block_spans(words, stride, places, count, first, last);
    return;
  }
  for (int word = places.first >> 6; word <= places.last >> 6; ++word) {
    const int base = word << 6;
    for (int i = 0; i < count; i += 4) {
      const int at = std::min(i, count - 4);
      const __m256i blocked =
          _mm256_andnot_si256(bits_from(last + at, base - 1), bits_from(first + at, base));
      auto* const four = reinterpret_cast<__m256i*>(words + word * stride + at);
      _mm256_storeu_si256(four, _mm256_andnot_si256(blocked, _mm256_loadu_si256(four)));
    }
  }
}

constexpr SpanLoops kWideSpanLoops{work_out_wide, touch_wide, block_wide};
const bool kIsWide = __builtin_cpu_supports("avx2") != 0;

}  // namespace

const SpanLoops& span_loops() noexcept { return kIsWide ? kWideSpanLoops : kPlainSpanLoops; }

}  // namespace lodesman
