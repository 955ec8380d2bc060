// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "low_level/path/plane.h"
#include "low_level/path/round_body.h"

namespace lodesman {
namespace {

// Corners are taken together up to this turn: beyond it their legs meet too far away.
constexpr double kMaxTogether_rad = 0.9 * std::numbers::pi;
// What rounding may add to arcs that just fit between two corners.
constexpr double kFitSlackPx = 1e-6;

PointPx direction(PointPx from, PointPx to) noexcept {
  const double length = length_of(to - from);
  return length > 0.0 ? (1.0 / length) * (to - from) : PointPx{};
}

PointPx rotated(PointPx v, double angle) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.column - s * v.row, s * v.column + c * v.row};
}

// Where the legs before and after the corners meet.
PointPx meeting_point(std::span<const PointPx> path, const Turn& turn) noexcept {
  const PointPx in = direction(path[turn.first - 1], path[turn.first]);
  const PointPx out = direction(path[turn.last], path[turn.last + 1]);
  const double across = cross(in, out);
  if (turn.first == turn.last || std::abs(across) < 1e-12) {
    return path[turn.first];
  }
  const double ahead = cross(path[turn.last] - path[turn.first], out) / across;
  return path[turn.first] + ahead * in;
}

bool clear(PointPx from, PointPx to, std::span<const ZonePx> zones,
           const RegionPx& region) noexcept {
  return region.contains(from) && region.contains(to) &&
         std::none_of(zones.begin(), zones.end(),
                      [from, to](const ZonePx& zone) { return touches(zone, from, to); });
}

bool arc_is_clear(const Turn& turn, PointPx in, double radius_px, std::span<const ZonePx> zones,
                  const RegionPx& region) noexcept {
  const double all = turn.fillet.turn_rad;
  const double side = all < 0.0 ? -1.0 : 1.0;
  const PointPx to_begin = -radius_px * rotated(in, side * std::numbers::pi / 2.0);
  const PointPx centre = turn.begin - to_begin;
  const double widest = std::sqrt(2.0 * kClearancePx / std::max(radius_px, kClearancePx));
  const int steps = 1 + static_cast<int>(std::abs(all) / widest);
  const double step = all / steps;
  const double outer = 1.0 / std::cos(step / 2.0);
  for (int i = 0; i < steps; ++i) {
    const PointPx from = centre + rotated(to_begin, i * step);
    const PointPx corner = centre + outer * rotated(to_begin, (i + 0.5) * step);
    const PointPx to = centre + rotated(to_begin, (i + 1) * step);
    if (!clear(from, to, zones, region) || !clear(from, corner, zones, region) ||
        !clear(corner, to, zones, region)) {
      return false;
    }
  }
  return true;
}

// The corners from `first` on that have no room for arcs of their own.
Turn gather(std::span<const PointPx> path, std::uint32_t first, double radius_px) noexcept {
  Turn turn{first, first, path[first], path[first], {}, false};
  turn.fillet = fillet_of(path[first - 1], path[first], path[first + 1], radius_px);
  double reach_px = turn.fillet.begin_px;
  while (turn.last + 2 < path.size()) {
    const Fillet next =
        fillet_of(path[turn.last], path[turn.last + 1], path[turn.last + 2], radius_px);
    const double leg_px = length_of(path[turn.last + 1] - path[turn.last]);
    const double together_rad = turn.fillet.turn_rad + next.turn_rad;
    if (reach_px + next.begin_px <= leg_px + kFitSlackPx ||
        turn.fillet.turn_rad * next.turn_rad <= 0.0 || std::abs(together_rad) > kMaxTogether_rad) {
      break;
    }
    ++turn.last;
    turn.fillet.turn_rad = together_rad;
    turn.fillet.begin_px = radius_px * std::tan(std::abs(together_rad) / 2.0);
    turn.fillet.swing_px = radius_px * (1.0 - std::cos(together_rad));
    // How far the arc goes beyond the last corner.
    reach_px = turn.fillet.begin_px - length_of(path[turn.last] - meeting_point(path, turn));
  }
  return turn;
}

}  // namespace

Fillet fillet_of(PointPx before, PointPx corner, PointPx after, double radius_px) noexcept {
  const PointPx in = corner - before;
  const PointPx out = after - corner;
  const double turn_rad = std::atan2(cross(in, out), dot(in, out));
  return {turn_rad, radius_px * std::tan(std::abs(turn_rad) / 2.0),
          radius_px * (1.0 - std::cos(turn_rad))};
}

std::size_t find_turns(std::span<const PointPx> path, double radius_px,
                       std::span<const ZonePx> zones, const RegionPx& region,
                       std::span<Turn> turns) noexcept {
  std::size_t count = 0;
  PointPx sailed_to = path.empty() ? PointPx{} : path.front();
  for (std::uint32_t first = 1; first + 1 < path.size() && count < turns.size(); ++count) {
    Turn turn = gather(path, first, radius_px);
    const PointPx meeting = meeting_point(path, turn);
    const PointPx in = direction(path[first - 1], path[first]);
    const PointPx out = direction(path[turn.last], path[turn.last + 1]);
    turn.begin = meeting - turn.fillet.begin_px * in;
    turn.end = meeting + turn.fillet.begin_px * out;
    const PointPx next = path[turn.last + 1];
    turn.possible =
        dot(turn.begin - sailed_to, in) >= -kFitSlackPx &&
        dot(next - turn.end, out) >= -kFitSlackPx && clear(sailed_to, turn.begin, zones, region) &&
        arc_is_clear(turn, in, radius_px, zones, region) && clear(turn.end, next, zones, region);
    if (!turn.possible) {
      turn.begin = path[turn.first];
      turn.end = path[turn.last];
    }
    sailed_to = turn.end;
    first = turn.last + 1;
    turns[count] = turn;
  }
  return count;
}

}  // namespace lodesman
