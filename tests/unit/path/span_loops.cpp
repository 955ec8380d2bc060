// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/span_loops.h"

#include <random>
#include <vector>

#include "low_level/path/plain_span_loops.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

constexpr std::array<int, 12> kCounts{1, 2, 3, 4, 5, 6, 7, 8, 9, 63, 127, 128};

// Spans of all kinds: empty ones, some that end where a word does, and some as long as the view.
SpanBatch random_spans(std::mt19937& random, LineSpan places) {
  std::uniform_int_distribution<int> place{places.first, places.last};
  SpanBatch batch{};
  for (std::size_t i = 0; i < batch.first.size(); ++i) {
    const int first =
        random() % 4 == 0 ? std::max(place(random) & -64, places.first) : place(random);
    const int last = random() % 4 == 0 ? std::min(place(random) | 63, places.last) : place(random);
    batch.first[i] = random() % 8 == 0 ? places.first : first;
    batch.last[i] = random() % 8 == 0 ? places.last : last;
  }
  return batch;
}

TEST_CASE("span loops: they block from the first place to the last, however wide their vectors",
          "[low_level][path]") {
  constexpr int kWords = 5;
  constexpr std::ptrdiff_t kStride = 160;
  std::mt19937 random{866};
  for (int turn = 0; turn < 200; ++turn) {
    const LineSpan places{static_cast<int>(random() % 100), static_cast<int>(150 + random() % 150)};
    const SpanBatch batch = random_spans(random, places);
    for (const int count : kCounts) {
      CAPTURE(turn, count, places.first, places.last);
      std::vector<std::uint64_t> plain(kWords * kStride, ~std::uint64_t{0});
      std::vector<std::uint64_t> widest = plain;
      kPlainSpanLoops.block(plain.data(), kStride, places, count, batch.first.data(),
                            batch.last.data());
      span_loops().block(widest.data(), kStride, places, count, batch.first.data(),
                         batch.last.data());
      REQUIRE(plain == widest);
      const int line = static_cast<int>(random()) % count;
      const auto l = static_cast<std::size_t>(line < 0 ? -line : line);
      for (int place = 0; place < kWords * 64; ++place) {
        const bool is_free =
            (plain[static_cast<std::size_t>(place >> 6) * kStride + l] >> (place & 63) & 1U) != 0;
        REQUIRE(is_free == (place < batch.first[l] || place > batch.last[l]));
      }
    }
  }
}

TEST_CASE("span loops: they work out the same spans, however wide their vectors",
          "[low_level][path]") {
  std::mt19937 random{500};
  std::uniform_real_distribution<double> number{0.0, 1.0};
  for (int turn = 0; turn < 500; ++turn) {
    // Half of them reach out of a view of 866 places and 500 lines.
    const Conic conic{900.0 * number(random),       500.0 * number(random),
                      1.0 + 200.0 * number(random), 4.0 * number(random) - 2.0,
                      1.0 + 200.0 * number(random), 400.0};
    const int first_line = static_cast<int>(conic.centre_q - conic.height);
    for (const int count : kCounts) {
      CAPTURE(turn, count);
      SpanBatch plain{};
      SpanBatch widest{};
      kPlainSpanLoops.work_out(plain, conic, first_line, count, 866);
      span_loops().work_out(widest, conic, first_line, count, 866);
      const auto end = static_cast<std::ptrdiff_t>(count);
      REQUIRE(std::equal(plain.first.begin(), plain.first.begin() + end, widest.first.begin()));
      REQUIRE(std::equal(plain.last.begin(), plain.last.begin() + end, widest.last.begin()));
      REQUIRE(std::equal(plain.surety.begin(), plain.surety.begin() + end, widest.surety.begin()));
      REQUIRE(kPlainSpanLoops.touch(plain, 0, count) == span_loops().touch(widest, 0, count));
    }
  }
}

TEST_CASE("span loops: spans touch if no line is empty and each meets the next, if at a corner",
          "[low_level][path]") {
  for (const SpanLoops* const loops : {&kPlainSpanLoops, &span_loops()}) {
    for (const int gap_at : {1, 5, 20, 39}) {
      SpanBatch batch{};
      for (int i = 0; i < 40; ++i) {
        batch.first[static_cast<std::size_t>(i)] = 100 + 10 * i;
        batch.last[static_cast<std::size_t>(i)] = 109 + 10 * i;  // the next begins a place further
      }
      REQUIRE(loops->touch(batch, 0, 40));
      const auto gap = static_cast<std::size_t>(gap_at);
      batch.last[gap - 1] -= 1;
      REQUIRE_FALSE(loops->touch(batch, 0, 40));
      REQUIRE(loops->touch(batch, gap_at, 40));
      batch.last[gap - 1] = batch.first[gap - 1] - 1;
      REQUIRE_FALSE(loops->touch(batch, 0, 40));
    }
  }
}

}  // namespace
}  // namespace lodesman::testing
