// SPDX-License-Identifier: Apache-2.0
// From where a shape about crosses a line of pixels to the places that it covers there, exactly.
// Pure functions; any thread.
#pragma once

#include "low_level/path/bit_lines.h"

namespace lodesman {

// The next whole number up, of one that an int can hold: std::ceil is a call where the machine is
// not known to round by itself.
[[nodiscard]] inline int whole_up(double value) noexcept {
  const int below = static_cast<int>(value);
  return below + (value > below ? 1 : 0);
}

// The same within [low, high]. What is not a number gives the widest span: a first place falls to
// `low`, a last one to `high`.
[[nodiscard]] inline int first_from(double value, int low, int high) noexcept {
  if (!(value > low)) {
    return low;
  }
  return value >= high ? high : whole_up(value);
}
[[nodiscard]] inline int last_from(double value, int low, int high) noexcept {
  if (!(value < high)) {
    return high;
  }
  return value <= low ? low : whole_up(value);
}

// The lines that a shape between two heights can touch, and one more to each side for rounding.
[[nodiscard]] inline LineSpan lines_between(double top, double bottom, int lines) noexcept {
  return {first_from(top - 1.0, 0, lines), last_from(bottom + 2.0, 0, lines) - 1};
}

// The places of a convex shape in a line, within the line's outline, given about where they begin
// and end. `contains(place)` has the last word.
template <class Contains>
[[nodiscard]] LineSpan exact_span(LineSpan outline, double low, double high,
                                  Contains contains) noexcept {
  int first = first_from(low - 1.0, outline.first, outline.last + 1);
  int last = last_from(high + 1.0, outline.first - 1, outline.last);
  while (first <= last && !contains(first)) {
    ++first;
  }
  if (first > last) {
    return {};
  }
  while (!contains(last)) {  // ends at `first`, which is inside
    --last;
  }
  while (first > outline.first && contains(first - 1)) {
    --first;
  }
  while (last < outline.last && contains(last + 1)) {
    ++last;
  }
  return {first, last};
}

}  // namespace lodesman
