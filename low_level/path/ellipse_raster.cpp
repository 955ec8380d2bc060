// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/ellipse_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "low_level/path/line_ends.h"

namespace lodesman {
namespace {

// An ellipse about a bitmap's lines: p runs along a line and q counts the lines, both from the
// centre; inside where along * p^2 + 2 * mixed * p * q + across * q^2 <= 1.
struct Conic {
  double centre_p;
  double centre_q;
  double chord;   // half the width of the line through the centre, in places
  double slope;   // by how much the middle moves a line
  double height;  // from the centre to the last line
  double width;   // from the centre to the last place
  bool is_tame;   // neither large, small nor thin, so that float numbers are good enough
};

Conic conic_of(const EllipsePx& e, double cos_theta, double sin_theta, double centre_p,
               double centre_q) noexcept {
  const double cos_a = cos_theta / e.a;
  const double sin_a = sin_theta / e.a;
  const double cos_b = cos_theta / e.b;
  const double sin_b = sin_theta / e.b;
  const double along = cos_a * cos_a + sin_b * sin_b;
  const double across = sin_a * sin_a + cos_b * cos_b;
  const double root = std::sqrt(along);
  Conic conic{};
  conic.centre_p = centre_p;
  conic.centre_q = centre_q;
  conic.chord = 1.0 / root;
  conic.slope = (cos_a * sin_a - sin_b * cos_b) / along;
  conic.height = e.a * e.b * root;
  conic.width = e.a * e.b * std::sqrt(across);
  const double longer = std::max(e.a, e.b);
  conic.is_tame = std::min(e.a, e.b) >= 1.0 && longer <= 500.0 &&
                  longer <= 10.0 * std::min(e.a, e.b) && std::abs(centre_p) <= 1e4 &&
                  std::abs(centre_q) <= 1e4 &&
                  std::abs(cos_theta * cos_theta + sin_theta * sin_theta - 1.0) <= 1e-12;
  return conic;
}

// Where a line about begins and ends.
struct Ends {
  double left;  // under the root: 1 at the centre, 0 at the first and the last line
  double low;
  double high;

  Ends(const Conic& conic, int line) noexcept {
    const double q = line - conic.centre_q;
    const double share = q / conic.height;
    left = 1.0 - share * share;
    const double half = conic.chord * std::sqrt(std::max(left, 0.0));
    const double middle = conic.centre_p - conic.slope * q;
    low = middle - half;
    high = middle + half;
  }
  // Of a tame ellipse, rounding moves the ends by less than 1e-6 of a place unless next to nothing
  // is left under the root: the numbers are below 1e4 and exact to 1e-12, and what magnifies their
  // errors, here and in contains(), stays below 1e5.
  [[nodiscard]] bool are_sure() const noexcept {
    return left > 1e-4 && std::abs(low - std::round(low)) > 1e-3 &&
           std::abs(high - std::round(high)) > 1e-3;
  }
};

// In float numbers the ends of a tame ellipse are off by less than half of kUnsure, as long as the
// line is not among the first and last, where less than kFlat is left under the root. (The root
// magnifies an error of q by the ellipse's proportions over the root of kFlat, by 80 at most; q and
// all places are below 1600 and so exact to 2^-14.) An end that lies no nearer than kUnsure to a
// place's centre is therefore on the side that it seems.
constexpr float kUnsure = 1.0F / 256.0F;
constexpr float kFlat = 1.0F / 64.0F;

// Lines are worked out so many at a time, in a loop that compilers turn into vectors.
constexpr int kBatch = 64;

struct Batch {
  std::array<std::int32_t, kBatch> first;
  std::array<std::int32_t, kBatch> last;
  std::array<float, kBatch> surety;  // below zero: the places may be wrong

  // Of a tame ellipse: what lies in the view of each line. A few lines more than asked for are
  // worked out, so that no vector is left half full.
  void work_out(const Conic& conic, int first_line, int count, int length) noexcept {
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
    const int whole_vectors = (count + 7) & ~7;
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
      first.data()[i] = below_low + 1 + base;
      last.data()[i] = below_high + base;
      surety.data()[i] = std::min(0.5F - kUnsure - std::max(off_low, off_high), left - kFlat);
    }
  }

  // Whether all of the lines have a place and touch their neighbours, if only at a corner.
  [[nodiscard]] bool touch(int from, int to) const noexcept {
    std::int32_t gap = last.data()[from] - first.data()[from];
    for (int i = from + 1; i < to; ++i) {
      gap |= (last.data()[i] - first.data()[i]) | (last.data()[i - 1] + 1 - first.data()[i]) |
             (last.data()[i] + 1 - first.data()[i - 1]);
    }
    return gap >= 0;
  }
};

// What makes a shape round (BitLines::announce), gathered batch by batch.
class Roundness {
 public:
  void add(const Batch& batch, int line, int count) noexcept {
    int from = 0;
    int to = count;
    while (from < to && batch.first.data()[from] > batch.last.data()[from]) {
      ++from;
    }
    while (from < to && batch.first.data()[to - 1] > batch.last.data()[to - 1]) {
      --to;
    }
    if (from == to) {
      return;
    }
    round_ = round_ && batch.touch(from, to);
    if (lines_.first <= lines_.last) {
      round_ = round_ && lines_.last == line + from - 1 &&
               batch.first.data()[from] <= end_.last + 1 &&
               end_.first <= batch.last.data()[from] + 1;
    } else {
      lines_.first = line + from;
    }
    lines_.last = line + to - 1;
    end_ = {batch.first.data()[to - 1], batch.last.data()[to - 1]};
  }
  [[nodiscard]] bool is_round() const noexcept { return round_; }
  [[nodiscard]] LineSpan lines() const noexcept { return lines_; }

 private:
  bool round_ = true;
  LineSpan lines_{};
  LineSpan end_{};  // the places of the last line
};

template <class Contains>
void draw_wild(const Conic& conic, BitLines& lines, Contains contains) noexcept {
  const LineSpan all =
      lines_between(conic.centre_q - conic.height, conic.centre_q + conic.height, lines.lines());
  lines.announce(all, {0, lines.length() - 1});
  for (int line = all.first; line <= all.last; ++line) {
    const Ends ends{conic, line};
    const LineSpan span = exact_span(lines.outline(line), ends.low, ends.high,
                                     [&](int place) { return contains(place, line); });
    lines.block(line, span);
  }
}

// Of a line of a tame ellipse of which float numbers do not tell enough.
template <class Contains>
LineSpan careful_span(const Conic& conic, int line, LineSpan view, Contains contains) noexcept {
  const Ends ends{conic, line};
  if (!ends.are_sure()) {
    return exact_span(view, ends.low, ends.high, [&](int place) { return contains(place, line); });
  }
  return {first_from(ends.low, view.first, view.last + 1),
          last_from(ends.high, view.first, view.last + 1) - 1};
}

template <class Contains>
void draw(const Conic& conic, BitLines& lines, Contains contains) noexcept {
  if (!conic.is_tame) {
    draw_wild(conic, lines, contains);
    return;
  }
  const double reach = conic.height + 0.01;  // rounding is far less
  const LineSpan all{first_from(conic.centre_q - reach, 0, lines.lines()),
                     last_from(conic.centre_q + reach, 0, lines.lines()) - 1};
  const LineSpan places =
      lines_between(conic.centre_p - conic.width, conic.centre_p + conic.width, lines.length());
  if (all.first > all.last || places.first > places.last) {
    return;
  }
  lines.announce(all, places, true);
  Batch batch;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  Roundness roundness;
  for (int line = all.first; line <= all.last; line += kBatch) {
    const int count = std::min(kBatch, all.last - line + 1);
    batch.work_out(conic, line, count, lines.length());
    for (int i = 0; i < count; ++i) {
      if (batch.surety.data()[i] < 0.0F) {
        const LineSpan span = careful_span(conic, line + i, {0, lines.length() - 1}, contains);
        batch.first.data()[i] = span.first;
        batch.last.data()[i] = span.last;
      }
    }
    lines.block(line, count, batch.first.data(), batch.last.data());
    roundness.add(batch, line, count);
  }
  if (roundness.is_round()) {
    lines.end_round(roundness.lines(), places);
  } else {
    lines.announce(all, places);
  }
}

}  // namespace

void draw_in_rows(const EllipsePx& e, BitLines& rows) noexcept {
  const Conic conic = conic_of(e, e.cos_theta, e.sin_theta, e.centre.column, e.centre.row);
  draw(conic, rows, [&](int column, int row) { return e.contains(column, row); });
}

void draw_in_columns(const EllipsePx& e, BitLines& columns) noexcept {
  // With rows and columns changed over, an ellipse turned by theta is turned by pi/2 - theta.
  const Conic conic = conic_of(e, e.sin_theta, e.cos_theta, e.centre.row, e.centre.column);
  draw(conic, columns, [&](int row, int column) { return e.contains(column, row); });
}

}  // namespace lodesman
