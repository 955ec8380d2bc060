// SPDX-License-Identifier: Apache-2.0
// What the sonar has seen of the water around the vehicle: an occupancy grid in the odometry frame
// that rolls with it, each cell free, occupied or unknown. One thread; allocates when made and
// never after.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "mid_level/base/frames.h"
#include "mid_level/messages/coverage.h"
#include "mid_level/messages/obstacle.h"

namespace lodesman {

// One ping, as far as the grid cares.
struct Look {
  VehiclePose pose;   // [odometry] of the sonar's head; its heading is where the fan's middle looks
  double at_s = 0.0;  // [s] of the ping, any epoch, never falling
  double first_bearing_rad = 0.0;  // [rad] of the first beam's centre, clockwise from the heading
  double beam_step_rad = 0.0;      // [rad] (0, kWidestBeam_rad]
  double nearest_m = 0.0;          // [m] nothing is heard nearer
  double farthest_m = 0.0;         // [m] nor farther
  // [m] of each beam: up to there nothing was seen (the near edge of the first echo, or
  // farthest_m); 0: a blind beam.
  std::span<const float> clear_m;

  static constexpr double kWidestBeam_rad = 0.2;  // a fan has beams, not lobes
  // Beams that go round once at most, and a range.
  [[nodiscard]] bool is_fan() const noexcept {
    const double across_rad = beam_step_rad * static_cast<double>(clear_m.size());
    return beam_step_rad > 0.0 && beam_step_rad <= kWidestBeam_rad &&
           across_rad <= 2.0 * std::numbers::pi + kWidestBeam_rad &&
           std::isfinite(first_bearing_rad) && nearest_m >= 0.0 && farthest_m > nearest_m;
  }
};

class EvidenceGrid {
 public:
  static constexpr double kCell_m = 0.25;
  static constexpr int kSide = 320;           // [-] cells: 80 m, 40 m each way
  static constexpr int kTile = 12;            // [-] cells of a tile's side: 3 m
  static constexpr double kFarthest_m = 1e7;  // farther is no place, and no cell's number

  // Evidence is the log-odds of an obstacle in tenths. A hit is 67 % sure and a look that saw
  // nothing 60 %, so that one hit makes unknown water occupied and two looks make it free.
  static constexpr int kHit = 7;
  static constexpr int kMiss = 4;
  static constexpr int kOccupiedAt = kHit;      // and above
  static constexpr int kFreeAt = -2 * kMiss;    // and below
  static constexpr int kMostOccupied = 16;      // six looks from free, and still occupied after two
  static constexpr int kMostFree = -3 * kMiss;  // three hits from occupied

  // [-] one bit a cell: a tile's rows from south to north, the lowest bit its western column.
  using TileRows = std::array<std::uint16_t, kTile>;

  // Cells of the window, by column u and row v from its first, as bits.
  class WindowCells {
   public:
    void add_run(int v, int first, int last) noexcept {
      if (v < 0 || v >= kSide) {
        return;
      }
      first = std::max(first, 0);
      last = std::min(last, kSide - 1);
      if (first <= last) {
        low_ = std::min(low_, v);
        high_ = std::max(high_, v);
      }
      for (int u = first; u <= last; ++u) {
        rows_[static_cast<std::size_t>(v)][static_cast<std::size_t>(u / 64)] |= std::uint64_t{1}
                                                                                << (u % 64);
      }
    }
    template <class Visit>
    void for_each(Visit visit) const noexcept {
      for (int v = low_; v <= high_; ++v) {
        for (int word = 0; word < kWords; ++word) {
          std::uint64_t bits = rows_[static_cast<std::size_t>(v)][static_cast<std::size_t>(word)];
          for (; bits != 0; bits &= bits - 1) {
            visit(word * 64 + std::countr_zero(bits), v);
          }
        }
      }
    }

   private:
    static constexpr int kWords = kSide / 64;
    static_assert(kSide % 64 == 0);
    std::array<std::array<std::uint64_t, kWords>, kSide> rows_{};
    int low_ = kSide;
    int high_ = -1;
  };

  EvidenceGrid();

  // Rolls to the head. Every cell in the fan between nearest_m and clear_m, less half a cell,
  // becomes a little freer, once. A look that breaks its own ranges is none.
  void look(const Look& look) noexcept;
  // What was seen in this ping, in the odometry frame, after look(): its cells become a little more
  // occupied, once a ping, whether or not a beam looked through them.
  void add(const Obstacle& shape, double at_s) noexcept;
  // Its cells, grown by one, become free: what moved away left nothing.
  void clear(const Obstacle& shape) noexcept;
  // All is unknown again.
  void forget() noexcept;

  [[nodiscard]] WaterState state(const Eigen::Vector2d& p) const noexcept {
    return state_of(is_place(p.x(), p.y()) ? evidence(cell(p.x()), cell(p.y())) : 0);
  }
  // Of cells beside each other, from a column of a row on. What was free and not looked at since
  // `since_s` is unknown, and so is all where not every cell is in the window.
  void read_row(int column, int row, double since_s, std::span<WaterState> out) const noexcept {
    const int last = column + static_cast<int>(out.size()) - 1;
    if (!holds(column, row) || !holds(last, row)) {
      std::fill(out.begin(), out.end(), WaterState::kUnknown);
      return;
    }
    // Not a number before the first ping, when nothing was seen.
    const double ticks = std::max(0.0, 1e3 * (since_s - epoch_s_));
    const std::uint32_t since = 2 * static_cast<std::uint32_t>(std::min(ticks, 2e9));
    std::size_t at = slot(column, row);
    const std::size_t row_end = slot(0, row) + static_cast<std::size_t>(kSide);
    for (WaterState& state : out) {
      state = state_of(evidence_[at]);
      if (state == WaterState::kFree && seen_[at] < since) {
        state = WaterState::kUnknown;
      }
      at = at + 1 == row_end ? row_end - static_cast<std::size_t>(kSide) : at + 1;
    }
  }
  // [s] When a beam or an obstacle last touched the cell; minus infinity: never.
  [[nodiscard]] double last_seen_s(const Eigen::Vector2d& p) const noexcept {
    const bool inside = is_place(p.x(), p.y()) && holds(cell(p.x()), cell(p.y()));
    const std::uint32_t seen = inside ? seen_[slot(cell(p.x()), cell(p.y()))] : 0;
    return seen == 0 ? -std::numeric_limits<double>::infinity()
                     : epoch_s_ + 1e-3 * (static_cast<double>(seen >> 1) - 1.0);
  }

  struct Shares {
    double occupied = 0.0;  // [-] [0, 1]; the three together are 1
    double free = 0.0;
    double unknown = 1.0;
  };
  // Of the shape's cells in the grid; all unknown where there are none.
  [[nodiscard]] Shares shares_under(const Obstacle& shape) const noexcept;

  // Columns (east) and rows (north) count cells from the odometry frame's origin, tiles likewise.
  [[nodiscard]] static bool is_place(double x_m, double y_m) noexcept {  // false for NaN
    return std::abs(x_m) <= kFarthest_m && std::abs(y_m) <= kFarthest_m;
  }
  [[nodiscard]] static int cell(double metres) noexcept {
    return static_cast<int>(std::floor(metres / kCell_m));
  }
  [[nodiscard]] static int tile(int cell) noexcept {
    return (cell - remainder_of(cell, kTile)) / kTile;
  }
  [[nodiscard]] int first_column() const noexcept { return column0_; }
  [[nodiscard]] int first_row() const noexcept { return row0_; }
  [[nodiscard]] int occupied_in_tile(int tile_x, int tile_y) const noexcept {
    return tile_counts_[tile_slot(tile_x, tile_y)];
  }
  [[nodiscard]] TileRows occupied_cells(int tile_x, int tile_y) const noexcept;
  // Occupied by a single hit, and nothing beside it is.
  [[nodiscard]] bool is_lone_hit(int column, int row) const noexcept {
    int occupied = 0;
    for (int j = row - 1; j <= row + 1; ++j) {
      for (int i = column - 1; i <= column + 1; ++i) {
        occupied += evidence(i, j) >= kOccupiedAt ? 1 : 0;
      }
    }
    return evidence(column, row) == kHit && occupied == 1;
  }

 private:
  // A tile's slot: more of them than the window ever touches, and a power of two.
  static constexpr int kTileSlots = 32;
  static constexpr std::size_t kCells = static_cast<std::size_t>(kSide) * kSide;

  [[nodiscard]] static WaterState state_of(int evidence) noexcept {
    return evidence >= kOccupiedAt ? WaterState::kOccupied
           : evidence <= kFreeAt   ? WaterState::kFree
                                   : WaterState::kUnknown;
  }
  [[nodiscard]] static std::size_t tile_slot(int tile_x, int tile_y) noexcept {
    return static_cast<std::size_t>((tile_y & (kTileSlots - 1)) * kTileSlots +
                                    (tile_x & (kTileSlots - 1)));
  }
  [[nodiscard]] static int remainder_of(int a, int b) noexcept {
    return a % b + (a % b < 0 ? b : 0);
  }
  [[nodiscard]] static std::size_t slot(int column, int row) noexcept {
    return static_cast<std::size_t>(remainder_of(row, kSide) * kSide + remainder_of(column, kSide));
  }
  [[nodiscard]] bool holds(int column, int row) const noexcept {
    return column >= column0_ && column < column0_ + kSide && row >= row0_ && row < row0_ + kSide;
  }
  // Of the tile that a cell is in.
  [[nodiscard]] std::int16_t& count_around(int column, int row) noexcept {
    return tile_counts_[tile_slot(tile(column), tile(row))];
  }
  [[nodiscard]] int evidence(int column, int row) const noexcept {
    return holds(column, row) ? evidence_[slot(column, row)] : 0;
  }
  // Of a cell in the window.
  void set_evidence(int column, int row, int value) noexcept {
    std::int8_t& evidence = evidence_[slot(column, row)];
    const int change = (value >= kOccupiedAt ? 1 : 0) - (evidence >= kOccupiedAt ? 1 : 0);
    evidence = static_cast<std::int8_t>(value);
    if (change != 0) {
      std::int16_t& count = count_around(column, row);
      count = static_cast<std::int16_t>(count + change);
    }
  }
  void roll_to(const Eigen::Vector2d& p) noexcept;
  void forget_box(int column, int row, int columns, int rows) noexcept;
  void advance_clock(double at_s) noexcept;
  void mark_fan(const Look& look) noexcept;
  void mark_line(const Eigen::Vector2d& head, const Eigen::Vector2d& along, double from,
                 double to) noexcept;
  void take_marks() noexcept;
  void lower_run(std::size_t mark, std::size_t count, int column, int row) noexcept;

  // The window's first cell, and of every slot (cell modulo the side) its evidence and when it was
  // last seen: twice the tick, odd for a hit; 0: never.
  int column0_ = -kSide / 2;
  int row0_ = -kSide / 2;
  std::vector<std::int8_t> evidence_;
  std::vector<std::uint32_t> seen_;
  std::array<std::int16_t, static_cast<std::size_t>(kTileSlots) * kTileSlots> tile_counts_{};

  // Milliseconds since the first ping, and at least one more with every look.
  double epoch_s_ = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t tick_ = 0;

  // Cells of the window, from its first, that this ping looks through, and the box around them.
  std::vector<std::uint8_t> marks_;
  struct Box {
    int u0 = 0;
    int v0 = 0;
    int u1 = -1;  // the last
    int v1 = -1;
  };
  Box marked_;
};

}  // namespace lodesman
