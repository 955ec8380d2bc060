// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/ellipse_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "low_level/path/line_ends.h"

namespace lodesman {
namespace {

// An ellipse about a bitmap's lines: p runs along a line and q counts the lines, both from the
// centre; inside where along * p^2 + 2 * mixed * p * q + ... <= 1. In p that is a quadratic whose
// discriminant is along - (q / (a b))^2.
struct Conic {
  double centre_p;
  double centre_q;
  double along;
  double mixed;
  double area;    // a * b
  double height;  // of the ellipse, in lines, from its centre
  double width;   // in places
  bool is_tame;
};

Conic conic_of(const EllipsePx& e, double cos_theta, double sin_theta, double centre_p,
               double centre_q) noexcept {
  const double cos_a = cos_theta / e.a;
  const double sin_a = sin_theta / e.a;
  const double cos_b = cos_theta / e.b;
  const double sin_b = sin_theta / e.b;
  Conic conic{};
  conic.centre_p = centre_p;
  conic.centre_q = centre_q;
  conic.along = cos_a * cos_a + sin_b * sin_b;
  conic.mixed = cos_a * sin_a - sin_b * cos_b;
  conic.area = e.a * e.b;
  conic.height = conic.area * std::sqrt(conic.along);
  conic.width = conic.area * std::sqrt(sin_a * sin_a + cos_b * cos_b);
  conic.is_tame = std::min(e.a, e.b) >= 0.5 && std::max(e.a, e.b) <= 5000.0 &&
                  std::max(e.a, e.b) <= 100.0 * std::min(e.a, e.b) && std::abs(centre_p) <= 1e5 &&
                  std::abs(centre_q) <= 1e5 &&
                  std::abs(cos_theta * cos_theta + sin_theta * sin_theta - 1.0) <= 1e-12;
  return conic;
}

// The two ends of a tame ellipse in a line are off by less than 1e-4 of a place by rounding, here
// and in contains(), as long as the discriminant is not below kFlat of its largest value. An end
// that lies no nearer than kUnsure to a place's centre is therefore on the side that it seems.
constexpr double kUnsure = 1e-3;
constexpr double kFlat = 1e-4;

// Lines are worked out so many at a time, in loops that compilers turn into vectors.
constexpr int kBatch = 64;

// Where the ellipse begins and ends in each line of a batch, as numbers and as places.
struct Batch {
  std::array<double, kBatch> low;
  std::array<double, kBatch> high;
  std::array<double, kBatch> doubt;  // below zero: the places may be wrong
  std::array<int, kBatch> first;
  std::array<int, kBatch> last;

  void work_out(const Conic& conic, int first_line, int count, int length) noexcept {
    const double per_area = 1.0 / conic.area;
    const double per_along = 1.0 / conic.along;
    const double slope = conic.mixed * per_along;
    const double flat = kFlat * conic.along;
    const double begin = first_line - conic.centre_q;
    for (int i = 0; i < count; ++i) {
      const double q = begin + i;
      const double scaled = q * per_area;
      const double discriminant = conic.along - scaled * scaled;
      const double half = std::sqrt(std::max(discriminant, 0.0)) * per_along;
      const double middle = conic.centre_p - slope * q;
      const auto at = static_cast<std::size_t>(i);
      low.data()[at] = middle - half;
      high.data()[at] = middle + half;
      doubt.data()[at] = discriminant - flat;
    }
    // Brought to within the line and its surroundings, and then above zero, where a conversion
    // to int rounds down. What is not a number becomes the lower bound.
    const double most = length + 8.5;
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double from = std::min(std::max(1.5, low.data()[at] + 4.0), most);
      const double to = std::min(std::max(1.5, high.data()[at] + 4.0), most);
      const int below_from = static_cast<int>(from);
      const int below_to = static_cast<int>(to);
      // The distance of both from the nearest whole number, less kUnsure.
      const double sure_from = 0.5 - kUnsure - std::abs(from - below_from - 0.5);
      const double sure_to = 0.5 - kUnsure - std::abs(to - below_to - 0.5);
      first.data()[at] = below_from - 3;
      last.data()[at] = below_to - 4;
      doubt.data()[at] = std::min(doubt.data()[at], std::min(sure_from, sure_to));
    }
  }
};

// Whether the spans of neighbouring lines touch, if only at a corner, and none between is empty.
class Touching {
 public:
  void look(int line, int count, const int* first, const int* last) noexcept {
    for (int i = 0; i < count; ++i) {
      if (first[i] > last[i]) {
        continue;
      }
      if (lines_.last >= lines_.first) {
        all_ =
            all_ && lines_.last == line + i - 1 && first[i] <= last_ + 1 && first_ <= last[i] + 1;
        lines_.last = line + i;
      } else {
        lines_ = {line + i, line + i};
      }
      first_ = first[i];
      last_ = last[i];
    }
  }
  [[nodiscard]] bool all() const noexcept { return all_; }
  [[nodiscard]] LineSpan lines() const noexcept { return lines_; }

 private:
  bool all_ = true;
  LineSpan lines_{};
  int first_ = 0;
  int last_ = 0;
};

template <class Contains>
void draw(const Conic& conic, BitLines& lines, Contains contains) noexcept {
  const double slack = conic.is_tame ? kUnsure : 2.0;
  const LineSpan all{first_from(conic.centre_q - conic.height - slack, 0, lines.lines()),
                     last_from(conic.centre_q + conic.height + slack, 0, lines.lines()) - 1};
  LineSpan places{0, lines.length() - 1};
  if (conic.is_tame) {
    places =
        lines_between(conic.centre_p - conic.width, conic.centre_p + conic.width, lines.length());
  }
  if (all.first > all.last || places.first > places.last) {
    return;
  }
  lines.announce(all, places, conic.is_tame);
  Batch batch;
  Touching touching;
  for (int line = all.first; line <= all.last; line += kBatch) {
    const int count = std::min(kBatch, all.last - line + 1);
    batch.work_out(conic, line, count, lines.length());
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!conic.is_tame || batch.doubt.data()[at] < 0.0) {
        const LineSpan span =
            exact_span(lines.outline(line + i), batch.low.data()[at], batch.high.data()[at],
                       [&](int place) { return contains(place, line + i); });
        batch.first.data()[at] = span.first;
        batch.last.data()[at] = span.last;
      }
    }
    lines.block(line, count, batch.first.data(), batch.last.data());
    touching.look(line, count, batch.first.data(), batch.last.data());
  }
  if (!conic.is_tame) {
    return;
  }
  if (touching.all()) {
    lines.end_round(touching.lines(), places);
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
