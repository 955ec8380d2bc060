// SPDX-License-Identifier: Apache-2.0
// A bitmap as parallel lines of bits, with what a search needs to run along a line 64 pixels at a
// time: where it is blocked, where it may turn, and which words hold anything at all. PassableGrid
// has one of its rows and one of its columns. Owned by one thread; it allocates when made and
// never after. Bounds are the caller's: lines and places must lie in the view unless said.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lodesman {

// A line's places from `first` to `last`; none where last < first.
struct LineSpan {
  std::int32_t first = 0;
  std::int32_t last = -1;
};

// A set bit is a free place. On each line the places that can be free at all, its outline, are one
// span; block() takes places away and clear() gives them back.
//
// "Crowded" is a word of a line near which something was blocked since clear(): a word that is not
// crowded is as the outline left it. Runs along a line look at crowded words only.
class BitLines {
 public:
  static constexpr int kNone = -1;

  // Of lines with `length` places, 1 to 4093, and one outline a line.
  BitLines(int length, std::span<const LineSpan> outlines);

  void clear() noexcept;
  void block_all() noexcept;

  // Blocks places of one line. They must lie in the view, and announce() must have been told.
  void block(int line, LineSpan span) noexcept { block(line, 1, &span.first, &span.last, span); }
  // The same for `count` lines from `line` on, each from first[i] to last[i], which all lie in some
  // places.
  void block(int line, int count, const std::int32_t* first, const std::int32_t* last,
             LineSpan places) noexcept;
  // Of one word of a line, keeps free only what is free in `free`. As for block().
  void keep(int line, int word, std::uint64_t free) noexcept { *cell(line, word) &= free; }
  // To be called before block() or keep(): all that they take away lies in these lines and places.
  // Of a shape that is `round`, also say where it ends, afterwards.
  void announce(LineSpan lines, LineSpan places, bool round = false) noexcept;
  // A shape is round if the spans of neighbouring lines touch, if only at a corner: then no line
  // leads past the end of its neighbour's span without having been beside that span all the way,
  // but for the lines just before its first and past its last.
  void end_round(LineSpan lines, LineSpan places) noexcept;
  // Of a shape announced as round that proves not to be.
  void end_jagged(LineSpan lines, LineSpan places) noexcept;

  [[nodiscard]] int lines() const noexcept { return lines_; }
  [[nodiscard]] int length() const noexcept { return length_; }
  [[nodiscard]] int words_per_line() const noexcept { return used_words_; }
  [[nodiscard]] LineSpan outline(int line) const noexcept { return outlines_.data()[line]; }
  // A word of a line; the lowest bit of the first is place 0. Bits past the end are clear.
  [[nodiscard]] std::uint64_t word(int line, int word) const noexcept { return *cell(line, word); }

  [[nodiscard]] bool is_free(int line, int place) const noexcept {
    return (*cell(line, place >> 6) >> (place & 63) & 1U) != 0;
  }
  // 64 places from `place` on, which may be up to two before the first; the line may be up to two
  // off the view. Nothing is free there.
  [[nodiscard]] std::uint64_t window(int line, int place) const noexcept {
    const std::uint64_t* const words = cell(line, place >> 6);
    const int shift = place & 63;
    return words[0] >> shift | words[stride_] << 1 << (63 - shift);
  }
  // Of the places from one to another, both of the outline, the blocked one nearest to the other;
  // kNone where all are free.
  [[nodiscard]] int blocked_between(int line, int one, int other) const noexcept;

  // Going from a free place up (kWay 1) or down (-1) the line: the first place that is blocked, or
  // where a neighbouring line is free and was blocked one place before, so that a way round a
  // corner opens; kNone where the outline ends first.
  template <int kWay>
  [[nodiscard]] int next_stop(int line, int place) const noexcept;

  // Bitmaps of 64 lines: the next ones up (kSide 1: the lowest bit is line + 1) or down (-1: the
  // highest bit is line - 1). Those where word `word` or what touches it is crowded:
  template <int kSide>
  [[nodiscard]] std::uint64_t crowd(int line, int word) const noexcept {
    return lines_beside<kSide>(crowd_.data() + word, line);
  }
  // Those where a way round a corner may open to a run up (kWay 1) or down (-1) the line that
  // begins in word `word` or further along, between two places that are free on the lines beside.
  // Such a run either ends at a round shape that it meets or passes just before its first or past
  // its last line. At the edge of the outline it cannot turn: where the line beside is free at both
  // ends of the run, its outline lies between.
  template <int kSide, int kWay>
  [[nodiscard]] std::uint64_t turning(int line, int word) const noexcept;

 private:
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};
  static constexpr int kSpareLines = 2;  // blocked ones before the first and after the last

  // Words lie in memory one below the other, line after line: what shapes and diagonals touch in a
  // word of many lines is one piece.
  [[nodiscard]] std::ptrdiff_t place_of(int line, int word) const noexcept {
    return (word + 1) * stride_ + line + kSpareLines;
  }
  [[nodiscard]] std::uint64_t* cell(int line, int word) noexcept {
    return words_.data() + place_of(line, word);
  }
  [[nodiscard]] const std::uint64_t* cell(int line, int word) const noexcept {
    return words_.data() + place_of(line, word);
  }
  // From a column of words, one for each 64 lines and the first for those before line 0.
  template <int kSide>
  [[nodiscard]] std::uint64_t lines_beside(const std::uint64_t* column, int line) const noexcept {
    const int from = kSide > 0 ? line + 1 + 64 : line;
    const int shift = from & 63;
    const std::uint64_t* const words = column + (from >> 6) * used_words_;
    return words[0] >> shift | words[used_words_] << 1 << (63 - shift);
  }
  // The words of a span and of the places that touch it, as a mask.
  [[nodiscard]] static std::uint64_t words_round(LineSpan span) noexcept {
    const int first = span.first > 0 ? (span.first - 1) >> 6 : 0;
    const int last = (span.last + 1) >> 6;
    return (std::uint64_t{2} << last) - (std::uint64_t{1} << first);
  }
  template <int kWay>
  [[nodiscard]] std::uint64_t stops(const std::uint64_t* word) const noexcept;
  void find_even_parts();
  void find_full_lines();
  void clear(LineSpan lines, int word) noexcept;
  // `words` is a mask of neighbouring words, not none.
  void set_lines_in(std::vector<std::uint64_t>& crowd, std::uint64_t words,
                    LineSpan lines) noexcept;

  int lines_;
  int length_;
  int used_words_;
  std::ptrdiff_t stride_;  // from a word of a line to its next
  std::vector<LineSpan> outlines_;
  // Of each line with its two neighbours: from here on upwards (downwards) only crowded words can
  // hold a stop.
  std::vector<LineSpan> even_;
  std::vector<std::uint64_t> outline_words_;
  std::vector<LineSpan> full_lines_;    // for each word, lines where the outline holds all of it
  std::vector<std::uint64_t> words_;    // with one more before the first and after the last
  std::vector<std::uint64_t> crowded_;  // a mask of words a line, with one line more on each side
  // The same the other way round: for each 64 lines, and for those before line 0, the lines as bits
  // of a word for each word of a line.
  std::vector<std::uint64_t> crowd_;
  std::vector<std::uint64_t> turns_;  // likewise, where a run from further off may turn
  // What clear() must give back: the lines and, as a span of words, the places announced.
  struct Taken {
    LineSpan lines;
    LineSpan words;
  };
  static constexpr std::size_t kMaxTaken = 64;
  std::array<Taken, kMaxTaken> taken_{};
  std::size_t taken_count_ = 0;
};

inline int BitLines::blocked_between(int line, int one, int other) const noexcept {
  const int first = one < other ? one : other;
  const int last = one < other ? other : one;
  const int first_word = first >> 6;
  const int last_word = last >> 6;
  const std::uint64_t* const words = cell(line, 0);
  std::uint64_t todo = crowded_.data()[line + 1] &
                       ((std::uint64_t{2} << last_word) - (std::uint64_t{1} << first_word));
  while (todo != 0) {
    const int i = one < other ? 63 - std::countl_zero(todo) : std::countr_zero(todo);
    const std::uint64_t from = i == first_word ? kAll << (first & 63) : kAll;
    const std::uint64_t to = i == last_word ? kAll >> (63 - (last & 63)) : kAll;
    if (const std::uint64_t blocked = ~words[i * stride_] & from & to; blocked != 0) {
      return (i << 6) + (one < other ? 63 - std::countl_zero(blocked) : std::countr_zero(blocked));
    }
    todo &= ~(std::uint64_t{1} << i);
  }
  return kNone;
}

// The places of a word where a run stops: blocked ones, and free ones of a neighbouring line that
// follow on a blocked one.
template <int kWay>
std::uint64_t BitLines::stops(const std::uint64_t* word) const noexcept {
  // Those that begin a free piece of a line, coming from below (above).
  const auto begins = [this](const std::uint64_t* line) {
    return kWay > 0 ? *line & ~(*line << 1 | line[-stride_] >> 63)
                    : *line & ~(*line >> 1 | line[stride_] << 63);
  };
  return ~*word | begins(word - 1) | begins(word + 1);
}

template <int kSide, int kWay>
std::uint64_t BitLines::turning(int line, int word) const noexcept {
  std::uint64_t lines = 0;
  for (int far = word; far >= 0 && far < used_words_; far += kWay) {
    lines |= lines_beside<kSide>(turns_.data() + far, line);
  }
  return lines;
}

template <int kWay>
int BitLines::next_stop(int line, int place) const noexcept {
  const int word = place >> 6;
  const std::uint64_t* const words = cell(line, 0);
  const std::uint64_t* const crowded = crowded_.data() + line;
  std::uint64_t todo = crowded[0] | crowded[1] | crowded[2];
  if constexpr (kWay > 0) {
    const std::uint64_t here =
        stops<kWay>(words + word * stride_) & (~std::uint64_t{1} << (place & 63));
    if (here != 0) {
      return (word << 6) + std::countr_zero(here);
    }
    if (place < even_.data()[line].first) {
      todo = kAll >> (63 - (used_words_ - 1));
    }
    for (todo &= ~std::uint64_t{1} << word; todo != 0; todo &= todo - 1) {
      const int i = std::countr_zero(todo);
      if (const std::uint64_t found = stops<kWay>(words + i * stride_)) {
        return (i << 6) + std::countr_zero(found);
      }
    }
  } else {
    const std::uint64_t here = stops<kWay>(words + word * stride_) & ~(kAll << (place & 63));
    if (here != 0) {
      return (word << 6) + 63 - std::countl_zero(here);
    }
    if (place > even_.data()[line].last) {
      todo = kAll;
    }
    todo &= ~(kAll << word);
    while (todo != 0) {
      const int i = 63 - std::countl_zero(todo);
      if (const std::uint64_t found = stops<kWay>(words + i * stride_)) {
        return (i << 6) + 63 - std::countl_zero(found);
      }
      todo &= ~(std::uint64_t{1} << i);
    }
  }
  return kNone;
}

}  // namespace lodesman
