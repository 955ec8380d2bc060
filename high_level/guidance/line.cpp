// SPDX-License-Identifier: Apache-2.0
#include "high_level/guidance/line.h"

#include <algorithm>
#include <cmath>

#include "high_level/guidance/zones.h"

namespace lodesman {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kNear_m = 3.0;      // so near to a line that is clear it is sailed by
constexpr double kAhead_m = 30.0;    // what lies farther along the line does not matter yet
constexpr double kLeave_m = 6.0;     // so far before what lies on the line it is left
constexpr double kRejoin_m = 4.0;    // and so far after it gone back to
constexpr double kLook_m = 0.5;      // from one look at the line to the next
constexpr double kClearOf_m = 0.05;  // off a zone

// What of the line within a stretch lies in zones: the first and the last of it.
struct BlockedStretch {
  double first_m = 0.0;
  double last_m = 0.0;
  bool any = false;
};

[[nodiscard]] BlockedStretch blocked_stretch(const Leg& leg, const PathRequest& zones,
                                             double from_m, double to_m) noexcept {
  BlockedStretch blocked;
  for (double along_m = from_m; along_m <= to_m; along_m += kLook_m) {
    if (zone_clearance_m(zones, leg.at(along_m)) < kClearOf_m) {
      blocked.first_m = blocked.any ? blocked.first_m : along_m;
      blocked.last_m = along_m;
      blocked.any = true;
    }
  }
  return blocked;
}

[[nodiscard]] bool is_clear_between(const PathRequest& zones, const Vec& a, const Vec& b) noexcept {
  const double length_m = (b - a).norm();
  for (double along_m = 0.0; along_m < length_m; along_m += kLook_m) {
    if (zone_clearance_m(zones, a + along_m / length_m * (b - a)) < kClearOf_m) {
      return false;
    }
  }
  return true;
}

// The next place along the line outside every zone, or its end.
[[nodiscard]] double next_clear_m(const Leg& leg, const PathRequest& zones,
                                  double from_m) noexcept {
  const double end_m = std::min(from_m + kAhead_m, leg.length_m());
  double along_m = from_m;
  while (along_m < end_m && zone_clearance_m(zones, leg.at(along_m)) < kClearOf_m) {
    along_m += kLook_m;
  }
  return along_m < end_m ? along_m : leg.length_m();
}

}  // namespace

LineToKeep line_to_keep(const Leg& leg, const PathRequest& zones, const Vec& own_W,
                        const LineToKeep& before) noexcept {
  LineToKeep line;
  line.along_m = leg.along_m(own_W);
  const double off_m = (own_W - leg.at(line.along_m)).norm();
  const double round_to_m = before.goes_round ? before.rejoin_m : 0.0;
  const double seen_m = std::min(std::max(line.along_m + kAhead_m, round_to_m), leg.length_m());
  const BlockedStretch blocked = blocked_stretch(leg, zones, line.along_m, seen_m);
  // What was gone round is passed, or gone, where nothing lies on the line up to its end.
  const bool still_round = before.goes_round && blocked.any && blocked.first_m <= round_to_m;
  const bool near = off_m < kNear_m && is_clear_between(zones, own_W, leg.at(line.along_m + off_m));
  line.is_clear = near && !blocked.any;
  line.leave_m = line.along_m;
  if (near && blocked.any && !still_round) {
    line.leave_m = std::max(line.along_m, blocked.first_m - kLeave_m);
  }
  line.goes_round = blocked.any && line.leave_m <= line.along_m;
  double rejoin_m = near ? seen_m : line.along_m + off_m + kRejoin_m;
  if (blocked.any) {
    const double least_m = std::max(near ? 0.0 : rejoin_m, still_round ? round_to_m : 0.0);
    rejoin_m = std::max(least_m, blocked.last_m + kRejoin_m);
  }
  line.rejoin_m = next_clear_m(leg, zones, std::min(rejoin_m, leg.length_m()));
  return line;
}

}  // namespace lodesman
