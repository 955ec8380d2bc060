// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/ghosts.h"

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

constexpr double kLeastBehind_m = 2.0;  // nominal
constexpr double kMostBehind_m = 8.0;
constexpr double kLeastShare = 0.06;
constexpr double kMostShare = 0.22;
constexpr std::uint32_t kLeastPings = 2;
constexpr std::uint32_t kMostGhostPings = 9;
constexpr double kFlicker = 0.6;         // of the pings in which it is heard
constexpr double kHalfDepth_m = 0.35;    // nominal, of its echo
constexpr double kLeastHalfBeams = 1.2;  // a patch that is no single cell
constexpr double kSightMargin_m = 1.0;   // in which the nearest surface counts as the body

[[nodiscard]] const Obstacle* find(const HeardScene& scene, std::uint32_t id) noexcept {
  const auto all = scene.obstacles();
  const auto it = std::find_if(all.begin(), all.end(),
                               [id](const Obstacle& obstacle) { return obstacle.id == id; });
  return it != all.end() ? &*it : nullptr;
}

[[nodiscard]] std::uint32_t sides_of(const Obstacle& o) noexcept {
  return o.shape == ObstacleShape::kEllipse || o.vertex_count < 2 ? 0
         : o.shape == ObstacleShape::kPolygon                     ? o.vertex_count
                                                                  : o.vertex_count - 1;
}

// The point on the other side of the line through a wall's side.
[[nodiscard]] WorldPoint mirror_image(const Obstacle& wall, std::uint32_t side,
                                      const Eigen::Vector2d& at_W) noexcept {
  const Vertex& from = wall.vertices[side];
  const Vertex& to = wall.vertices[(side + 1) % wall.vertex_count];
  const Eigen::Vector2d along{to.x_m - from.x_m, to.y_m - from.y_m};
  const Eigen::Vector2d offset = at_W - Eigen::Vector2d{from.x_m, from.y_m};
  const double share = offset.dot(along) / std::max(along.squaredNorm(), 1e-12);
  return {at_W + 2.0 * (share * along - offset)};
}

}  // namespace

Ghosts::Heard Ghosts::where(const Obstacle& body, const HeardScene& scene,
                            const SurfaceEchoes& surfaces) const noexcept {
  const Eigen::Vector2d at = scene.pose().to_vehicle({{body.centre_x_m, body.centre_y_m}}).xy_m;
  const double radius_m = std::max(body.semi_axis_first_m, body.semi_axis_second_m);
  Heard heard;
  heard.beam = grid_.beam_at(std::atan2(at.x(), at.y()));
  if (heard.beam < 0.0 || heard.beam >= grid_.beams) {
    return heard;
  }
  heard.range_m = surfaces.sight_m(static_cast<std::uint32_t>(heard.beam));
  heard.any = heard.range_m < grid_.range_m &&
              std::abs(at.norm() - heard.range_m) < radius_m + kSightMargin_m;
  heard.beams = std::max(radius_m / std::max(at.norm(), radius_m) / grid_.sector_rad * grid_.beams,
                         kLeastHalfBeams);
  return heard;
}

// Seen through the wall; nowhere where the wall is not between.
Ghosts::Heard Ghosts::mirrored(const Obstacle& body, const Ghost& ghost,
                               const HeardScene& scene) const noexcept {
  Heard heard;
  const Obstacle* const wall = find(scene, ghost.wall);
  if (wall == nullptr || ghost.side >= sides_of(*wall)) {
    return heard;
  }
  const WorldPoint image_W = mirror_image(*wall, ghost.side, {body.centre_x_m, body.centre_y_m});
  const Eigen::Vector2d at = scene.pose().to_vehicle(image_W).xy_m;
  const double bearing_rad = std::atan2(at.x(), at.y());
  heard.beam = grid_.beam_at(bearing_rad);
  heard.range_m = at.norm();
  heard.beams = kLeastHalfBeams;
  const HeardSurface through = scene.surface(bearing_rad);
  heard.any = heard.beam >= 0.0 && heard.beam < grid_.beams && heard.range_m < grid_.range_m &&
              through.obstacle == wall && through.hit.range_m < heard.range_m;
  return heard;
}

void Ghosts::begin_some(const HeardScene& scene, const SurfaceEchoes& surfaces,
                        RandomStream& chance) noexcept {
  for (const Obstacle& body : scene.obstacles()) {
    if (!is_small_body(body) || !where(body, scene, surfaces).any) {
      continue;
    }
    Ghost ghost;
    ghost.body = body.id;
    ghost.share = uniform_between(chance, kLeastShare, kMostShare);
    ghost.behind_nominal_m = uniform_between(chance, kLeastBehind_m, kMostBehind_m);
    ghost.pings_left = pings_between(chance, kLeastPings, kMostGhostPings);
    if (chance.uniform() < kind_.second_echoes) {
      ghosts_.begin(ghost);
    }
    if (chance.uniform() < kind_.mirror_images) {
      const auto all = scene.obstacles();
      const auto chosen =
          static_cast<std::size_t>(chance.uniform() * static_cast<double>(all.size()));
      const Obstacle& wall = all[chosen];
      ghost.mirrored = sides_of(wall) > 0;
      ghost.wall = wall.id;
      ghost.side = static_cast<std::uint32_t>(chance.uniform() * sides_of(wall));
      if (ghost.mirrored) {
        ghosts_.begin(ghost);
      }
    }
  }
}

void Ghosts::draw_one(const Ghost& ghost, const HeardScene& scene, const SurfaceEchoes& surfaces,
                      EchoLevels& levels) const noexcept {
  const Obstacle* const body = find(scene, ghost.body);
  if (body == nullptr) {
    return;
  }
  const Heard heard = where(*body, scene, surfaces);
  if (!heard.any) {
    return;
  }
  const float level =
      static_cast<float>(ghost.share) * surfaces.brightest(grid_.bin_at(heard.range_m) + 1.0);
  Heard again = ghost.mirrored ? mirrored(*body, ghost, scene) : heard;
  if (!ghost.mirrored) {
    again.range_m += grid_.metres_of_nominal(ghost.behind_nominal_m);
  }
  if (again.any) {
    add_patch(levels, again.beam, grid_.bin_at(again.range_m), again.beams,
              std::max(grid_.bins_of_nominal(kHalfDepth_m), 1.0),
              [level](std::uint32_t) noexcept { return level; });
  }
}

void Ghosts::draw(const HeardScene& scene, const SurfaceEchoes& surfaces, EchoLevels& levels,
                  RandomStream& chance) noexcept {
  begin_some(scene, surfaces, chance);
  for (const Ghost& ghost : ghosts_.now()) {
    if (chance.uniform() < kFlicker) {
      draw_one(ghost, scene, surfaces, levels);
    }
  }
  ghosts_.age();
}

}  // namespace lodesman
