// SPDX-License-Identifier: Apache-2.0
// The loops over a shape's lines that drawing spends its time in: written once for any machine
// (plain_span_loops.h), and compiled again for the wider vectors that most x86-64 machines have.
// Pure functions of their arguments; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "low_level/path/bit_lines.h"

namespace lodesman {

// An ellipse about a bitmap's lines: p runs along a line and q counts the lines, both from the
// centre; inside where along * p^2 + 2 * mixed * p * q + across * q^2 <= 1.
struct Conic {
  double centre_p;
  double centre_q;
  double chord;   // half the width of the line through the centre, in places
  double slope;   // by how much the middle moves a line
  double height;  // from the centre to the last line
  double width;   // from the centre to the last place
};

// The places of a shape in some lines, one below the other.
struct SpanBatch {
  static constexpr int kLines = 128;
  static constexpr int kGroup = 8;  // lines: as many as a vector of AVX2 holds

  std::array<std::int32_t, kLines> first;
  std::array<std::int32_t, kLines> last;
  std::array<float, kLines> surety;  // below zero: the places may be wrong

  // Asks for the spans of the lines that are not sure, as span_of(i).
  template <class SpanOf>
  void take_care(int count, SpanOf span_of) noexcept {
    for (int from = 0; from < count; from += kGroup) {
      if (!any_unsure(from)) {
        continue;
      }
      for (int i = from; i < std::min(from + kGroup, count); ++i) {
        if (surety.data()[i] < 0.0F) {
          const LineSpan span = span_of(i);
          first.data()[i] = span.first;
          last.data()[i] = span.last;
        }
      }
    }
  }

 private:
  // Of a group of lines: by the signs of two numbers at a time.
  [[nodiscard]] bool any_unsure(int from) const noexcept {
    std::array<std::uint64_t, kGroup / 2> pairs{};
    std::memcpy(pairs.data(), surety.data() + from, sizeof pairs);
    return ((pairs[0] | pairs[1] | pairs[2] | pairs[3]) & 0x8000000080000000U) != 0;
  }
};

struct SpanLoops {
  // Of a tame ellipse (ellipse_raster.cpp): what lies in the view, whose lines have `length`
  // places, of `count` lines. A few more are worked out, so that no vector is left half full.
  void (*work_out)(SpanBatch& batch, const Conic& conic, int first_line, int count,
                   int length) noexcept;
  // Whether the lines from one to before another have a place each and touch their neighbours, if
  // only at a corner.
  bool (*touch)(const SpanBatch& batch, int from, int to) noexcept;
  // Clears bits from first[i] to last[i], which all lie in some places, in `count` lines of words:
  // words[i] is the first of a line, and the next is `stride` further.
  void (*block)(std::uint64_t* words, std::ptrdiff_t stride, LineSpan places, int count,
                const std::int32_t* first, const std::int32_t* last) noexcept;
};

// The fastest that this machine can run. All give the same results.
[[nodiscard]] const SpanLoops& span_loops() noexcept;

}  // namespace lodesman
