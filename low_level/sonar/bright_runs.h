// SPDX-License-Identifier: Apache-2.0
// Cells brighter than their range's background, as runs along the beams, and the runs that belong
// together, as echoes. One thread; allocates when made and never after.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "low_level/sonar/echo_plane.h"
#include "low_level/sonar/range_levels.h"

namespace lodesman {

struct BrightRun {
  std::uint32_t beam = 0;   // [-] of the plane
  std::uint32_t begin = 0;  // [-] first cell
  std::uint32_t end = 0;    // [-] one past the last
  std::uint32_t echo = 0;   // of which echo, once they are joined
};

// What its runs hold together.
struct EchoSum {
  std::uint32_t first_run = 0;  // in echo_runs()
  std::uint32_t run_count = 0;
  double energy = 0.0;  // [-] excesses of all its cells, in those that one needs
  bool has_seed = false;
};

class BrightRuns {
 public:
  BrightRuns();

  // `nearest` is the first cell of range that is looked at.
  void find(const EchoPlane& plane, const RangeLevels& levels, std::uint32_t nearest) noexcept;
  // Echoes that are large or strong enough, at most so many: where there are more, neighbours are
  // joined until there are not.
  void join(const EchoPlane& plane, const RangeLevels& levels, const ContrastOptions& options,
            std::uint32_t most) noexcept;

  [[nodiscard]] std::span<const EchoSum> echoes() const noexcept { return echoes_; }
  // Of one echo, beam by beam and nearest first.
  [[nodiscard]] std::span<const BrightRun> runs_of(const EchoSum& echo) const noexcept {
    return std::span{sorted_}.subspan(echo.first_run, echo.run_count);
  }

 private:
  void find_in_beam(std::span<const std::int16_t> cells, const RangeLevels& levels,
                    std::uint32_t beam, std::uint32_t nearest) noexcept;
  void part_all() noexcept;
  void link(std::uint32_t beams, std::uint32_t bins, std::uint32_t enough) noexcept;
  void link_beams(std::uint32_t one, std::uint32_t other, std::uint32_t bins,
                  std::uint32_t enough) noexcept;
  void join_neighbours(const ContrastOptions& options, std::uint32_t most) noexcept;
  [[nodiscard]] std::uint32_t root_of(std::uint32_t run) noexcept;
  void unite(std::uint32_t a, std::uint32_t b) noexcept;
  void sum_up(const EchoPlane& plane, const RangeLevels& levels) noexcept;
  void keep(const ContrastOptions& options) noexcept;
  void sort_runs() noexcept;

  std::uint32_t beams_ = 0;
  std::uint32_t parts_ = 0;  // [-] that the runs are in
  std::vector<BrightRun> runs_;
  std::vector<std::uint32_t> first_of_beam_;  // one more than beams
  std::vector<std::uint32_t> parent_;
  std::vector<EchoSum> echoes_;
  std::vector<BrightRun> sorted_;
};

}  // namespace lodesman
