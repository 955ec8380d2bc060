// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/bit_lines.h"

#include <algorithm>

#include "low_level/path/span_loops.h"
#include "mid_level/base/check.h"

namespace lodesman {
namespace {

constexpr int kMaxWords = 64;  // a mask of words is itself a word

}  // namespace

BitLines::BitLines(int length, std::span<const LineSpan> outlines)
    : lines_{static_cast<int>(outlines.size())},
      length_{length},
      used_words_{(length + 2) / 64 + 1},  // so that the last two bits of a line are always clear
      stride_{lines_ + 2 * kSpareLines},
      outlines_(outlines.begin(), outlines.end()),
      even_(outlines.size()),
      outline_words_(static_cast<std::size_t>((used_words_ + 2) * stride_)) {
  LODESMAN_CHECK(length > 0 && used_words_ <= kMaxWords && lines_ > 0);
  crowded_.resize(outlines.size() + 2);
  crowd_.resize(static_cast<std::size_t>(used_words_) * (outlines.size() / 64 + 3));
  turns_ = crowd_;
  for (int line = 0; line < lines_; ++line) {
    const LineSpan span = outlines_[static_cast<std::size_t>(line)];
    for (int place = span.first; place <= span.last; ++place) {
      outline_words_[static_cast<std::size_t>(place_of(line, place >> 6))] |= std::uint64_t{1}
                                                                              << (place & 63);
    }
  }
  words_ = outline_words_;
  find_even_parts();
  find_full_lines();
}

// Where a line begins before its neighbour does, a run up it passes the place where the neighbour
// begins: a turn may open there although nothing is crowded. The same at the other end, downwards.
void BitLines::find_even_parts() {
  for (int line = 0; line < lines_; ++line) {
    const LineSpan own = outlines_[static_cast<std::size_t>(line)];
    LineSpan even = own;
    for (const int other : {line - 1, line + 1}) {
      const LineSpan span =
          other >= 0 && other < lines_ ? outlines_[static_cast<std::size_t>(other)] : LineSpan{};
      if (span.first <= span.last) {
        even.first = std::max(even.first, span.first);
        even.last = std::min(even.last, span.last);
      }
    }
    even_[static_cast<std::size_t>(line)] = even;
  }
}

void BitLines::find_full_lines() {
  full_lines_.resize(static_cast<std::size_t>(used_words_));
  for (int word = 0; word < used_words_; ++word) {
    LineSpan run;  // of full lines, up to here
    for (int line = 0; line < lines_; ++line) {
      const bool is_full = outline_words_[static_cast<std::size_t>(place_of(line, word))] == kAll;
      run = is_full && run.first <= run.last ? LineSpan{run.first, line}
            : is_full                        ? LineSpan{line, line}
                                             : LineSpan{};
      LineSpan& longest = full_lines_[static_cast<std::size_t>(word)];
      longest = run.last - run.first > longest.last - longest.first ? run : longest;
    }
  }
}

// Of one word of some lines. Where the outline holds all of it, it is not asked: it lies in other
// memory, which would have to come near.
void BitLines::clear(LineSpan lines, int word) noexcept {
  const LineSpan full = full_lines_.data()[word];
  const auto copy = [&](int first, int end) {
    if (first < end) {
      std::copy_n(outline_words_.data() + place_of(first, word), end - first, cell(first, word));
    }
  };
  const LineSpan inside{std::max(full.first, lines.first), std::min(full.last, lines.last)};
  if (inside.first > inside.last) {
    copy(lines.first, lines.last + 1);
    return;
  }
  copy(lines.first, inside.first);
  std::fill_n(cell(inside.first, word), inside.last + 1 - inside.first, kAll);
  copy(inside.last + 1, lines.last + 1);
}

void BitLines::clear() noexcept {
  for (std::size_t i = 0; i < taken_count_; ++i) {
    const Taken& taken = taken_[i];
    // Word by word, not line by line: a shape has few words a line and many lines.
    for (int word = taken.words.first; word <= taken.words.last; ++word) {
      clear(taken.lines, word);
    }
    std::fill(crowded_.data() + taken.lines.first, crowded_.data() + taken.lines.last + 3, 0);
  }
  taken_count_ = 0;
  std::fill(crowd_.begin(), crowd_.end(), 0);
  std::fill(turns_.begin(), turns_.end(), 0);
}

void BitLines::block_all() noexcept {
  announce({0, lines_ - 1}, {0, length_ - 1});
  for (int line = 0; line < lines_; ++line) {
    if (const LineSpan span = outline(line); span.first <= span.last) {
      block(line, span);
    }
  }
}

void BitLines::block(int line, int count, const std::int32_t* first, const std::int32_t* last,
                     LineSpan places) noexcept {
  span_loops().block(cell(line, 0), stride_, places, count, first, last);
}

void BitLines::announce(LineSpan lines, LineSpan places, bool round) noexcept {
  lines = {std::max(lines.first, 0), std::min(lines.last, lines_ - 1)};
  places = {std::max(places.first, 0), std::min(places.last, length_ - 1)};
  if (lines.first > lines.last || places.first > places.last) {
    return;
  }
  const LineSpan words{places.first >> 6, places.last >> 6};
  if (taken_count_ < kMaxTaken) {
    taken_[taken_count_++] = {lines, words};
  } else {
    Taken& last = taken_.back();
    last = {{std::min(last.lines.first, lines.first), std::max(last.lines.last, lines.last)},
            {std::min(last.words.first, words.first), std::max(last.words.last, words.last)}};
  }
  const std::uint64_t felt_words = words_round(places);
  for (int line = lines.first; line <= lines.last; ++line) {
    crowded_.data()[line + 1] |= felt_words;
  }
  // A corner is felt one line and one place beside it.
  set_lines_in(crowd_, felt_words,
               {std::max(lines.first - 1, 0), std::min(lines.last + 1, lines_ - 1)});
  if (!round) {
    end_jagged(lines, places);
  }
}

void BitLines::end_jagged(LineSpan lines, LineSpan places) noexcept {
  set_lines_in(turns_, words_round(places),
               {std::max(lines.first - 1, 0), std::min(lines.last + 1, lines_ - 1)});
}

void BitLines::end_round(LineSpan lines, LineSpan places) noexcept {
  places = {std::max(places.first, 0), std::min(places.last, length_ - 1)};
  if (lines.first > lines.last || places.first > places.last) {
    return;
  }
  for (const int line : {lines.first - 1, lines.last + 1}) {
    if (line >= 0 && line < lines_) {
      set_lines_in(turns_, words_round(places), {line, line});
    }
  }
}

void BitLines::set_lines_in(std::vector<std::uint64_t>& crowd, std::uint64_t words,
                            LineSpan lines) noexcept {
  const int first_word = std::countr_zero(words);
  const int last_word = std::min(63 - std::countl_zero(words), used_words_ - 1);
  for (int line = lines.first; line <= lines.last;) {
    const int bit = line & 63;
    const int run = std::min(64 - bit, lines.last - line + 1);
    const std::uint64_t bits = (kAll >> (64 - run)) << bit;
    std::uint64_t* const row =
        crowd.data() + ((line >> 6) + 1) * static_cast<std::ptrdiff_t>(used_words_);
    for (int word = first_word; word <= last_word; ++word) {
      row[word] |= bits;
    }
    line += run;
  }
}

}  // namespace lodesman
