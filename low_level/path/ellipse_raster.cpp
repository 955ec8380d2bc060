// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/ellipse_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "low_level/path/line_ends.h"
#include "low_level/path/span_loops.h"

namespace lodesman {
namespace {

// An ellipse about rows; about columns it is the same with p and q changed over.
struct BothConics {
  Conic rows{};
  Conic columns{};
  bool are_tame = false;  // neither large, small nor thin, so that float numbers are good enough

  explicit BothConics(const EllipsePx& e) noexcept {
    const double cos_a = e.cos_theta / e.a;
    const double sin_a = e.sin_theta / e.a;
    const double cos_b = e.cos_theta / e.b;
    const double sin_b = e.sin_theta / e.b;
    const double along = cos_a * cos_a + sin_b * sin_b;
    const double across = sin_a * sin_a + cos_b * cos_b;
    const double mixed = cos_a * sin_a - sin_b * cos_b;
    const double half_rows = e.a * e.b * std::sqrt(along);
    const double half_columns = e.a * e.b * std::sqrt(across);
    rows = {e.centre.column, e.centre.row, 1.0 / std::sqrt(along),
            mixed / along,   half_rows,    half_columns};
    columns = {e.centre.row,   e.centre.column, 1.0 / std::sqrt(across),
               mixed / across, half_columns,    half_rows};
    const double longer = std::max(e.a, e.b);
    are_tame = std::min(e.a, e.b) >= 1.0 && longer <= 500.0 &&
               longer <= 10.0 * std::min(e.a, e.b) && std::abs(e.centre.column) <= 1e4 &&
               std::abs(e.centre.row) <= 1e4 &&
               std::abs(e.cos_theta * e.cos_theta + e.sin_theta * e.sin_theta - 1.0) <= 1e-12;
  }
};

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
    const auto from_centre = [](double end) {  // of the nearest place
      const double past = end - static_cast<double>(static_cast<std::int64_t>(end));
      return std::min(std::abs(past), 1.0 - std::abs(past));
    };
    return left > 1e-4 && from_centre(low) > 1e-3 && from_centre(high) > 1e-3;
  }
};

// What makes a shape round (BitLines::announce), gathered batch by batch.
class Roundness {
 public:
  void add(const SpanBatch& batch, int line, int count) noexcept {
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
    round_ = round_ && span_loops().touch(batch, from, to);
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
void draw_tame(const Conic& conic, BitLines& lines, Contains contains) noexcept {
  const double reach = conic.height + 0.01;  // rounding is far less
  const LineSpan all{first_from(conic.centre_q - reach, 0, lines.lines()),
                     last_from(conic.centre_q + reach, 0, lines.lines()) - 1};
  const LineSpan places =
      lines_between(conic.centre_p - conic.width, conic.centre_p + conic.width, lines.length());
  if (all.first > all.last || places.first > places.last) {
    return;
  }
  lines.announce(all, places, true);
  SpanBatch batch;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  Roundness roundness;
  for (int line = all.first; line <= all.last; line += SpanBatch::kLines) {
    const int count = std::min(SpanBatch::kLines, all.last - line + 1);
    span_loops().work_out(batch, conic, line, count, lines.length());
    batch.take_care(count, [&](int i) {
      return careful_span(conic, line + i, {0, lines.length() - 1}, contains);
    });
    lines.block(line, count, batch.first.data(), batch.last.data(), places);
    roundness.add(batch, line, count);
  }
  if (roundness.is_round()) {
    lines.end_round(roundness.lines(), places);
  } else {
    lines.end_jagged(all, places);
  }
}

}  // namespace

void draw(const EllipsePx& e, BitLines& rows, BitLines& columns) noexcept {
  const BothConics conics{e};
  const auto in_rows = [&e](int column, int row) { return e.contains(column, row); };
  const auto in_columns = [&e](int row, int column) { return e.contains(column, row); };
  if (conics.are_tame) {
    draw_tame(conics.rows, rows, in_rows);
    draw_tame(conics.columns, columns, in_columns);
  } else {
    draw_wild(conics.rows, rows, in_rows);
    draw_wild(conics.columns, columns, in_columns);
  }
}

}  // namespace lodesman
