// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/tangent_path.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "low_level/path/plane.h"

namespace lodesman {
namespace {

// A body is an ellipse or the disc at a wall's vertex.
constexpr std::size_t kMaxBodies = kMaxObstacles * kMaxVertices;
static_assert(kMaxVertices <= 32, "a bit a vertex");

// Lengths are compared in steps of about a millionth of a pixel, so that mirrored ways tie.
constexpr double kKeySteps = 1 << 20;
constexpr double kTautSlack = 1e-9;  // [rad] lets through what rounding puts on the wrong side

bool is_finite(const BoxPx& box) noexcept {
  return std::isfinite(box.low.column) && std::isfinite(box.low.row) &&
         std::isfinite(box.high.column) && std::isfinite(box.high.row);
}

bool touched_at(std::span<const ZonePx> zones, PointPx point) noexcept {
  return std::any_of(zones.begin(), zones.end(),
                     [point](const ZonePx& zone) { return touches(zone, point); });
}

}  // namespace

TangentPath::TangentPath(TangentLimits limits) : limits_{limits} {
  bodies_.reserve(kMaxBodies);
  corners_.reserve(limits_.max_corners);
  nodes_.reserve(std::size_t{2} * limits_.max_corners);
  reached_.reserve(std::size_t{2} * limits_.max_corners);
  open_.reserve(limits_.max_open);
  path_.reserve(limits_.max_waypoints);
}

TangentResult TangentPath::find(std::span<const ZonePx> zones, const RegionPx& region,
                                PointPx start, PointPx goal,
                                std::span<const BendSides> sides) noexcept {
  TangentResult result;
  sides_ = sides;
  result.reason = begin(zones, region, start, goal);
  if (result.reason == PathReason::kFound) {
    result.reason = search(result);
  }
  return result;
}

PathReason TangentPath::begin(std::span<const ZonePx> zones, const RegionPx& region, PointPx start,
                              PointPx goal) noexcept {
  shapes_ = zones;
  region_ = region;
  start_ = start;
  goal_ = goal;
  out_of_room_ = false;
  bodies_.clear();
  corners_.clear();
  nodes_.clear();
  reached_.clear();
  open_.clear();
  path_.clear();
  bool drawable = true;
  for (std::size_t i = 0; i < std::min(zones.size(), kMaxObstacles); ++i) {
    zones_[i] = {box_of(zones[i]), 0, 0};
    drawable = drawable && is_finite(zones_[i].box);
  }
  if (!drawable || !region.contains(start) || touched_at(zones, start)) {
    return PathReason::kStartBlocked;
  }
  if (!region.contains(goal)) {
    return PathReason::kGoalOutOfView;
  }
  if (touched_at(zones, goal)) {
    return PathReason::kGoalBlocked;
  }
  return zones.size() > kMaxObstacles ? PathReason::kLimit : PathReason::kFound;
}

PathReason TangentPath::search(TangentResult& result) noexcept {
  push(kStart, start_, kGoal);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>{});
    const Segment segment = open_.back();
    open_.pop_back();
    if (segment.to != kGoal && nodes_[segment.to].reached) {
      continue;
    }
    if (result.tried == limits_.max_tried) {
      return PathReason::kLimit;
    }
    ++result.tried;
    const Obstruction obstruction = obstruction_of(place_of(segment.from), place_of(segment.to));
    if (obstruction.any) {
      if (!obstruction.taking_part) {
        take_part(obstruction);
      }
    } else if (segment.to == kGoal) {
      result.length_px = segment.length_px;
      return trace(segment.from, goal_, result) ? PathReason::kFound : PathReason::kLimit;
    } else {
      reach(segment);
    }
    if (out_of_room_) {
      return PathReason::kLimit;
    }
  }
  return trace_nearest(result) ? PathReason::kNoPath : PathReason::kLimit;
}

void TangentPath::reach(const Segment& segment) noexcept {
  const NodeId node = segment.to;
  nodes_[node] = {segment.length_px, segment.from, true};
  reached_.push_back(node);
  const Departure departure = departure_from(node);
  push(node, departure.at, node_after(node));
  push_goal(node, departure);
  const std::uint32_t own = corner_of(node).body;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    if (i != own) {
      push_tangents(node, departure, bodies_[i]);
    }
  }
}

void TangentPath::push(NodeId from, PointPx from_at, NodeId to) noexcept {
  if (to != kGoal && (nodes_[to].reached || !corner_of(to).usable)) {
    return;
  }
  if (open_.size() == limits_.max_open) {
    out_of_room_ = true;
    return;
  }
  const PointPx to_at = place_of(to);
  const double length_px = length_to(from) + length_of(to_at - from_at);
  const double whole_px = length_px + length_of(goal_ - to_at);
  const bool to_port = goes_up(to == kGoal ? from : to);
  const auto steps = static_cast<std::uint64_t>(whole_px * kKeySteps);
  open_.push_back({steps << 1U | (to_port ? 1U : 0U), length_px, from, to});
  std::push_heap(open_.begin(), open_.end(), std::greater<>{});
}

void TangentPath::push_tangents(NodeId from, const Departure& departure,
                                const Body& body) noexcept {
  if (!departure.may_meet(body.shape)) {
    return;
  }
  const Tangents tangents = body.shape.tangents_from(departure.at);
  const NodeId up = 2 * (body.first_corner + tangents.up) + 1;
  const NodeId down = 2 * (body.first_corner + tangents.down);
  for (const NodeId to : {up, down}) {
    // To higher corners it goes clockwise, as seen in the view: with the body to starboard.
    const bool may = goes_up(to) ? body.sides.starboard : body.sides.port;
    if (may && departure.is_taut(corner_of(to).at)) {
      push(from, departure.at, to);
    }
  }
}

void TangentPath::push_goal(NodeId from, const Departure& departure) noexcept {
  if (departure.is_taut(goal_) || bodies_[corner_of(from).body].goal_corner == from / 2) {
    push(from, departure.at, kGoal);
  }
}

TangentPath::Obstruction TangentPath::obstruction_of(PointPx from, PointPx to) const noexcept {
  const BoxPx box = box_of(from, to);
  Obstruction found;
  for (std::uint32_t i = 0; i < shapes_.size() && !found.taking_part; ++i) {
    if (!zones_[i].box.meets(box)) {
      continue;
    }
    if (const auto* wall = std::get_if<WallPx>(&shapes_[i])) {
      look_at(*wall, i, box, from, to, found);
    } else if (touches(shapes_[i], from, to)) {
      found = {true, zones_[i].edges != 0, i, 0};
    }
  }
  return found;
}

// Only the wall itself: a path that starts outside cannot get to what it encloses.
void TangentPath::look_at(const WallPx& wall, std::uint32_t zone, const BoxPx& box, PointPx from,
                          PointPx to, Obstruction& found) const noexcept {
  for (std::uint32_t i = 0; i < wall.edge_count() && !found.taking_part; ++i) {
    const CapsulePx edge = wall.edge(i);
    if (box_of(edge).meets(box) && touches(edge, from, to)) {
      found = {true, (zones_[zone].edges >> i & 1U) != 0, zone, i};
    }
  }
}

void TangentPath::take_part(const Obstruction& obstruction) noexcept {
  const ZonePx& shape = shapes_[obstruction.zone];
  zones_[obstruction.zone].edges |= 1U << obstruction.edge;
  if (const auto* wall = std::get_if<WallPx>(&shape)) {
    add_wall_vertex(obstruction.zone, obstruction.edge);
    add_wall_vertex(obstruction.zone,
                    obstruction.edge + 1 < wall->vertex_count ? obstruction.edge + 1 : 0);
  } else if (const auto* ellipse = std::get_if<EllipsePx>(&shape)) {
    add_body(obstruction.zone, *ellipse);
  }
}

void TangentPath::add_wall_vertex(std::uint32_t zone, std::uint32_t vertex) noexcept {
  const auto* wall = std::get_if<WallPx>(&shapes_[zone]);
  if (wall == nullptr || (zones_[zone].vertices >> vertex & 1U) != 0) {
    return;
  }
  zones_[zone].vertices |= 1U << vertex;
  add_body(zone, {wall->vertices[vertex], wall->radius, wall->radius, 1.0, 0.0});
}

void TangentPath::add_body(std::uint32_t zone, const EllipsePx& shape) noexcept {
  Body body{RoundBody{shape}, static_cast<std::uint32_t>(corners_.size()),
            zone < sides_.size() ? sides_[zone] : BendSides{}, kGoal};
  const std::uint32_t count = body.shape.corner_count();
  if (corners_.size() + count > limits_.max_corners) {
    out_of_room_ = true;
    return;
  }
  const auto number = static_cast<std::uint32_t>(bodies_.size());
  PointPx at = body.shape.corner(0);
  for (std::uint32_t k = 0; k < count; ++k) {
    const PointPx next = body.shape.corner(k + 1 < count ? k + 1 : 0);
    const PointPx side = next - at;
    corners_.push_back({at, (1.0 / length_of(side)) * side, number, region_.contains(at)});
    at = next;
  }
  nodes_.resize(2 * corners_.size());
  if (body.shape.holds(goal_)) {
    body.goal_corner = body.first_corner + body.shape.tangents_from(goal_).up;
  }
  bodies_.push_back(body);
  push_tangents(kStart, departure_from(kStart), body);
  for (const NodeId node : reached_) {
    push_tangents(node, departure_from(node), body);
  }
}

bool TangentPath::trace(NodeId node, PointPx last, TangentResult& result) noexcept {
  path_.push_back(last);
  while (node != kStart && path_.size() < limits_.max_waypoints) {
    path_.push_back(corner_of(node).at);
    node = nodes_[node].before;
  }
  if (path_.size() == limits_.max_waypoints) {
    result.length_px = 0.0;
    return false;
  }
  path_.push_back(start_);
  std::reverse(path_.begin(), path_.end());
  result.path = path_;
  return true;
}

bool TangentPath::trace_nearest(TangentResult& result) noexcept {
  NodeId nearest = kStart;
  double least_px = length_of(goal_ - start_);
  for (const NodeId node : reached_) {
    const double distance_px = length_of(goal_ - corner_of(node).at);
    if (distance_px < least_px) {
      least_px = distance_px;
      nearest = node;
    }
  }
  result.length_px = length_to(nearest);
  if (nearest == kStart) {
    path_.push_back(start_);
    result.path = path_;
    return true;
  }
  return trace(nodes_[nearest].before, corner_of(nearest).at, result);
}

PointPx TangentPath::place_of(NodeId node) const noexcept {
  return node == kGoal ? goal_ : node == kStart ? start_ : corner_of(node).at;
}

double TangentPath::length_to(NodeId node) const noexcept {
  return node == kStart ? 0.0 : nodes_[node].length_px;
}

TangentPath::NodeId TangentPath::node_after(NodeId node) const noexcept {
  const Body& body = bodies_[corner_of(node).body];
  const std::uint32_t mask = body.shape.corner_count() - 1;
  const std::uint32_t k = node / 2 - body.first_corner;
  const std::uint32_t next = goes_up(node) ? k + 1 : k - 1;
  return 2 * (body.first_corner + (next & mask)) + (node & 1U);
}

TangentPath::Departure TangentPath::departure_from(NodeId node) const noexcept {
  if (node == kStart) {
    return {start_, {}, {}, 0.0};
  }
  const Corner& corner = corner_of(node);
  const Body& body = bodies_[corner.body];
  const std::uint32_t mask = body.shape.corner_count() - 1;
  const std::uint32_t below = body.first_corner + ((node / 2 - body.first_corner - 1) & mask);
  const PointPx side_below = corners_[below].ahead;
  return goes_up(node) ? Departure{corner.at, side_below, corner.ahead, 1.0}
                       : Departure{corner.at, -1.0 * corner.ahead, -1.0 * side_below, -1.0};
}

bool TangentPath::Departure::may_meet(const RoundBody& body) const noexcept {
  const PointPx to = body.centre() - at;
  const double reach = -body.reach_px();
  // At the tip of something thin the two directions are nearly opposite.
  return side * cross(before, to) >= reach && side * cross(to, ahead) >= reach &&
         (dot(to, ahead) >= reach || dot(to, before) >= reach);
}

bool TangentPath::Departure::is_taut(PointPx to) const noexcept {
  const PointPx along = to - at;
  const double slack = -kTautSlack * length_of(along);
  return side * cross(before, along) >= slack && side * cross(along, ahead) >= slack;
}

}  // namespace lodesman
