// SPDX-License-Identifier: Apache-2.0
// The shortest path of any direction among protection zones, from the zones' shapes and without a
// grid. Owned by one thread; it allocates when made and never after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "low_level/path/clearance.h"
#include "low_level/path/round_body.h"
#include "low_level/path/zone.h"
#include "mid_level/messages/obstacle.h"
#include "mid_level/messages/path.h"

namespace lodesman {

// A search that meets one of them ends with PathReason::kLimit.
struct TangentLimits {
  std::uint32_t max_corners = 32768;   // [-] of all polygons: enough for 64 ellipses of any size
  std::uint32_t max_open = 131072;     // [-] segments waiting to be tried
  std::uint32_t max_tried = 131072;    // [-] segments tested against the zones
  std::uint32_t max_waypoints = 4096;  // [-] of the path; at least 2
};

// On which sides a path may have a zone when it bends round it.
struct BendSides {
  bool port = true;       // the zone to port: the path bends to port
  bool starboard = true;  // the zone to starboard
};

struct TangentResult {
  PathReason reason = PathReason::kNoPath;
  double length_px = 0.0;   // of the path below
  std::uint32_t tried = 0;  // [-] segments tested against the zones
  // Start to goal. Where there is no path: to the point nearest to the goal of all that a path
  // bends at, perhaps the start alone. Otherwise empty.
  std::span<const PointPx> path;
};

// A shortest path is made of straight lines that are tangents, and of parts of the zones' edges. It
// turns only round what is round: ellipses, and discs at the vertices of walls. These get polygons
// of tangents (round_body.h), and an A* with the straight distance to the goal runs over their
// corners. Two things are put off until they are needed:
//   - a segment is tested against the zones when it is the most promising one, not when it is made;
//   - a shape takes part only once such a segment was found to touch it. Until then the search
//     answers an easier question, whose shortest path is no longer than the right one; a path that
//     is clear of all zones and shortest there is shortest.
// Every segment of the path was tested against the zones by clearance.h. The path is the shortest
// but for the polygons: see there how much they add. Passages that are wider than nothing but
// narrower than about 2 (kOvershootPx + kClearancePx) may be taken for closed; zones that touch
// leave no passage. Of paths whose lengths differ by less than a millionth of a pixel, the one that
// leaves its last shape to port is taken.
class TangentPath {
 public:
  explicit TangentPath(TangentLimits limits = {});

  // Checked in this order: kStartBlocked (also where the start is not in the region, or a zone's
  // numbers cannot be drawn), kGoalOutOfView (not in the region), kGoalBlocked, kLimit (also more
  // than kMaxObstacles zones), kNoPath. The result's path is valid until the next search.
  // `sides`, one a zone or empty: how a path may bend round it. A path may still have a zone on the
  // other side without touching it.
  [[nodiscard]] TangentResult find(std::span<const ZonePx> zones, const RegionPx& region,
                                   PointPx start, PointPx goal,
                                   std::span<const BendSides> sides = {}) noexcept;

 private:
  // A corner passed in one of the two senses is a node: twice its number, and one more where the
  // path goes on to higher corners. Start and goal are nodes too.
  using NodeId = std::uint32_t;
  static constexpr NodeId kGoal = std::numeric_limits<NodeId>::max();
  static constexpr NodeId kStart = kGoal - 1;

  struct Corner {
    PointPx at;
    PointPx ahead;  // direction of the side to the next corner, of length 1
    std::uint32_t body = 0;
    bool usable = false;  // lies in the region
  };
  struct Node {
    double length_px = 0.0;  // of the shortest path from the start
    NodeId before = kStart;
    bool reached = false;
  };
  struct Body {
    RoundBody shape;
    std::uint32_t first_corner = 0;
    BendSides sides;
    NodeId goal_corner = kGoal;  // the corner next to a goal that lies in the polygon
  };
  // Which parts of a zone take part in the search; an ellipse is one part.
  struct Zone {
    BoxPx box;
    std::uint32_t edges = 0;     // a bit an edge that was touched
    std::uint32_t vertices = 0;  // a bit a vertex that has a body
  };
  struct Segment {
    std::uint64_t key = 0;   // what to try first: the smallest
    double length_px = 0.0;  // of the path to its end
    NodeId from = kStart;
    NodeId to = kGoal;

    [[nodiscard]] bool operator>(const Segment& other) const noexcept {
      return key != other.key ? key > other.key : to > other.to;
    }
  };
  // Where a path may go on from a node: between two directions, with its body on one side.
  struct Departure {
    PointPx at;
    PointPx before;
    PointPx ahead;
    double side = 0.0;  // 1 or -1; 0: wherever it likes

    [[nodiscard]] bool may_meet(const RoundBody& body) const noexcept;
    [[nodiscard]] bool is_taut(PointPx to) const noexcept;
  };
  // What a segment touches, if anything.
  struct Obstruction {
    bool any = false;
    bool taking_part = false;
    std::uint32_t zone = 0;
    std::uint32_t edge = 0;
  };

  [[nodiscard]] PathReason begin(std::span<const ZonePx> zones, const RegionPx& region,
                                 PointPx start, PointPx goal) noexcept;
  [[nodiscard]] PathReason search(TangentResult& result) noexcept;
  void reach(const Segment& segment) noexcept;
  void push(NodeId from, PointPx from_at, NodeId to) noexcept;
  void push_tangents(NodeId from, const Departure& departure, const Body& body) noexcept;
  void push_goal(NodeId from, const Departure& departure) noexcept;
  [[nodiscard]] Obstruction obstruction_of(PointPx from, PointPx to) const noexcept;
  void look_at(const WallPx& wall, std::uint32_t zone, const BoxPx& box, PointPx from, PointPx to,
               Obstruction& found) const noexcept;
  void take_part(const Obstruction& obstruction) noexcept;
  void add_body(std::uint32_t zone, const EllipsePx& shape) noexcept;
  void add_wall_vertex(std::uint32_t zone, std::uint32_t vertex) noexcept;
  // The path whose last point is `last` and whose last bend is at `node`.
  [[nodiscard]] bool trace(NodeId node, PointPx last, TangentResult& result) noexcept;
  [[nodiscard]] bool trace_nearest(TangentResult& result) noexcept;

  [[nodiscard]] static bool goes_up(NodeId node) noexcept { return (node & 1U) != 0; }
  [[nodiscard]] const Corner& corner_of(NodeId node) const noexcept { return corners_[node / 2]; }
  [[nodiscard]] PointPx place_of(NodeId node) const noexcept;
  [[nodiscard]] double length_to(NodeId node) const noexcept;
  [[nodiscard]] NodeId node_after(NodeId node) const noexcept;  // along its polygon
  [[nodiscard]] Departure departure_from(NodeId node) const noexcept;

  TangentLimits limits_;
  std::span<const ZonePx> shapes_;    // of this search only
  std::span<const BendSides> sides_;  // likewise
  RegionPx region_ = RegionPx::fan();
  PointPx start_;
  PointPx goal_;
  bool out_of_room_ = false;
  std::array<Zone, kMaxObstacles> zones_{};
  std::vector<Body> bodies_;
  std::vector<Corner> corners_;
  std::vector<Node> nodes_;      // two a corner
  std::vector<NodeId> reached_;  // in that order
  std::vector<Segment> open_;    // a heap
  std::vector<PointPx> path_;
};

}  // namespace lodesman
