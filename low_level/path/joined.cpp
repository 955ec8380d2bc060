// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/joined.h"

#include <bit>
#include <cstddef>

namespace lodesman {

Joined::Joined(int lines, int length)
    : runs_(static_cast<std::size_t>(lines) * static_cast<std::size_t>(length / 2 + 1)) {}

std::int32_t Joined::root_of(std::int32_t run) noexcept {
  Run* const runs = runs_.data();
  while (runs[run].parent != run) {
    runs[run].parent = runs[runs[run].parent].parent;
    run = runs[run].parent;
  }
  return run;
}

void Joined::join(std::int32_t a, std::int32_t b) noexcept {
  a = root_of(a);
  b = root_of(b);
  // Towards the older one: chains stay short, for most runs join the run just before.
  (a < b ? runs_.data()[b] : runs_.data()[a]).parent = a < b ? a : b;
}

// Adds a line's runs from `count` on, and says how many there are then.
std::int32_t Joined::cut(const BitLines& lines, int line, std::int32_t count) noexcept {
  const LineSpan outline = lines.outline(line);
  if (outline.first > outline.last) {
    return count;
  }
  Run* const runs = runs_.data();
  std::uint64_t before = 0;  // the last place of the word before, as the lowest bit
  std::int32_t ends = count;
  for (int i = outline.first >> 6; i <= (outline.last + 1) >> 6; ++i) {
    const std::uint64_t free = lines.word(line, i);
    const std::uint64_t shifted = free << 1 | before;
    before = free >> 63;
    // Places where free and blocked change, alternately a run's first and the one after its last.
    for (std::uint64_t begins = free & ~shifted; begins != 0; begins &= begins - 1) {
      runs[count] = {(i << 6) + std::countr_zero(begins), 0, count};
      ++count;
    }
    for (std::uint64_t past = shifted & ~free; past != 0; past &= past - 1) {
      runs[ends++].last = (i << 6) + std::countr_zero(past) - 1;
    }
  }
  return count;
}

bool Joined::joined(const BitLines& lines, int line_a, int place_a, int line_b,
                    int place_b) noexcept {
  const Run* const runs = runs_.data();
  std::int32_t above = 0;
  std::int32_t begin = 0;
  std::int32_t run_a = -1;
  std::int32_t run_b = -1;
  for (int line = 0; line < lines.lines(); ++line) {
    const std::int32_t end = cut(lines, line, begin);
    for (std::int32_t upper = above, lower = begin; upper < begin && lower < end;) {
      if (runs[upper].first <= runs[lower].last && runs[lower].first <= runs[upper].last) {
        join(upper, lower);
      }
      (runs[upper].last < runs[lower].last ? upper : lower) += 1;
    }
    for (std::int32_t i = begin; i < end; ++i) {
      if (line == line_a && runs[i].first <= place_a && place_a <= runs[i].last) {
        run_a = i;
      }
      if (line == line_b && runs[i].first <= place_b && place_b <= runs[i].last) {
        run_b = i;
      }
    }
    above = begin;
    begin = end;
  }
  return root_of(run_a) == root_of(run_b);
}

}  // namespace lodesman
