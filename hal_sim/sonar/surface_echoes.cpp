// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/surface_echoes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodesman {
namespace {

// A beam is as wide as its neighbours are apart: so many rays across it make its echo.
constexpr int kRaysOfBeam = 3;
constexpr double kRayShare = 1.0 / kRaysOfBeam;
// What the beams beside one hear of it; then comes the ring of side lobes.
constexpr std::array<float, 4> kHeardAside{1.0F, 0.30F, 0.10F, 0.03F};
constexpr double kPulseBins = 3.0;

// Walls, in times the water at their range, above it.
constexpr double kWallAtGrazing = 4.2;
constexpr double kWallAtSquare = 8.0;
constexpr double kMirror = 10.0;             // what a wall does as a mirror, straight on
constexpr double kMirror_rad = to_rad(5.0);  // falls to 1/e
constexpr double kFaintestWater = 2.0;       // [-] of 255: where water is darker, walls are not
constexpr double kPiece_m = 0.5;             // a wall's pieces differ by their glints
constexpr double kGapPiece_m = 4.0;          // and of some that are larger ...
constexpr double kGapShare = 0.2;            // ... this share ...
constexpr double kGapLeft = 0.25;            // ... sends back so much
constexpr double kMostLength_m = 3.0;        // of what one ray of a beam at grazing incidence meets
constexpr double kCorner = 4.0;              // where two sides meet, or a wall ends

// Small bodies, of 255.
constexpr double kBodyLevel = 9.0;
// Smaller ones are brighter all over, up to so many times: they are solid, and end in the echo.
constexpr double kUsualBody_m = 1.5;  // the mean of its semi-axes
constexpr double kMostBrighter = 3.0;
constexpr double kBodyFront = 65.0;  // where a ray stands square on it
constexpr double kBodyFront_rad = to_rad(25.0);
constexpr double kBodyPiece_m = 0.25;
constexpr double kBodyDepth_m = 2.0;    // of what is heard of it, to 1/e
constexpr double kLargestBody_m = 3.0;  // a larger semi-axis makes it a wall
constexpr double kPingGain = 0.2;       // one sigma, from ping to ping

constexpr std::size_t kGlints = 4096;
constexpr double kGlintSigma = 0.75;  // of its logarithm

[[nodiscard]] std::uint32_t mixed(std::uint32_t id, std::int64_t i, std::int64_t j) noexcept {
  std::uint32_t hash = id * 0x9e3779b9U ^ static_cast<std::uint32_t>(i) * 0x85ebca6bU ^
                       static_cast<std::uint32_t>(j) * 0xc2b2ae35U;
  hash ^= hash >> 15U;
  hash *= 0x2c1b3c6dU;
  return hash ^ hash >> 13U;
}

// Plain, and of two that are told apart, so that it is done many at once.
void add_share(float* __restrict to, const float* __restrict from, std::uint32_t count,
               float share) noexcept {
  for (std::uint32_t i = 0; i < count; ++i) {
    to[i] += share * from[i];
  }
}

[[nodiscard]] double bell(double x) noexcept { return std::exp(-x * x); }

}  // namespace

bool is_small_body(const Obstacle& obstacle) noexcept {
  return obstacle.shape == ObstacleShape::kEllipse &&
         std::max(obstacle.semi_axis_first_m, obstacle.semi_axis_second_m) <= kLargestBody_m;
}

SurfaceEchoes::SurfaceEchoes(const WaterKind& kind, const EchoGrid& grid, RandomStream& chance)
    : kind_{kind},
      grid_{grid},
      glints_(kGlints),
      column_(grid.bins),
      brightest_(grid.bins),
      sights_m_(grid.beams),
      touched_(grid.beams) {
  for (float& glint : glints_) {
    glint = static_cast<float>(std::exp(kGlintSigma * chance.gaussian()));
  }
}

double SurfaceEchoes::glint(std::uint32_t id, double x, double y) const noexcept {
  const auto i = static_cast<std::int64_t>(std::floor(x));
  const auto j = static_cast<std::int64_t>(std::floor(y));
  return static_cast<double>(glints_[mixed(id, i, j) % kGlints]);
}

float SurfaceEchoes::brightest(double bin) const noexcept {
  return bin >= 0.0 && bin < grid_.bins ? brightest_[static_cast<std::size_t>(bin)] : 0.0F;
}

void SurfaceEchoes::add(double first, double bins, double level) noexcept {
  const double from = std::clamp(first, 0.0, static_cast<double>(grid_.bins));
  const double to = std::clamp(first + bins, 0.0, static_cast<double>(grid_.bins));
  if (!(to > from)) {
    return;
  }
  const auto begin = static_cast<std::uint32_t>(from);
  const auto end = static_cast<std::uint32_t>(std::ceil(to));
  for (std::uint32_t bin = begin; bin < end; ++bin) {
    const double covered = std::min(bin + 1.0, to) - std::max(static_cast<double>(bin), from);
    column_[bin] += static_cast<float>(covered * level);
  }
  begin_ = std::min(begin_, begin);
  end_ = std::max(end_, end);
}

// What one ray meets lies the deeper along the beam the more the wall slants, and is the fainter.
void SurfaceEchoes::hear_wall(const HeardSurface& surface, EchoLevels& levels) noexcept {
  const SurfaceHit& hit = surface.hit;
  const Obstacle& wall = *surface.obstacle;
  const double bin = grid_.bin_at(hit.range_m);
  const double cosine = std::clamp(hit.cos_incidence, 1e-3, 1.0);
  const double across_m = hit.range_m * grid_.sector_rad / grid_.beams * kRayShare;
  const double slant_m =
      std::min(across_m * std::sqrt(1.0 - cosine * cosine) / cosine, kMostLength_m);
  const double bins = std::max(kPulseBins, grid_.bin_at(slant_m));
  const double water =
      std::max(static_cast<double>(levels.water()[static_cast<std::size_t>(bin)]), kFaintestWater);
  const double gap_piece = static_cast<double>(
      mixed(wall.id + 1U, static_cast<std::int64_t>(std::floor(hit.along_m / kGapPiece_m)), -1));
  const double left = gap_piece < kGapShare * 0x1p32 ? kGapLeft : 1.0;
  const double strength = kWallAtGrazing + (kWallAtSquare - kWallAtGrazing) * cosine +
                          kMirror * bell(std::acos(cosine) / kMirror_rad);
  add(bin - 0.5 * bins, bins,
      water * strength * left * glint(wall.id, hit.along_m / kPiece_m, 0.0) * kRayShare *
          kPulseBins / bins);
}

// Its glints stay where they are on it.
void SurfaceEchoes::hear_body(const HeardSurface& surface, const WorldPoint& from_W,
                              const Eigen::Vector2d& direction_W) noexcept {
  const SurfaceHit& hit = surface.hit;
  const Obstacle& body = *surface.obstacle;
  const Eigen::Vector2d centre_W{body.centre_x_m, body.centre_y_m};
  const auto glint_at = [&](double range_m) noexcept {
    const Eigen::Vector2d on_it = (from_W.xy_m + range_m * direction_W - centre_W) / kBodyPiece_m;
    return glint(body.id, on_it.x(), on_it.y());
  };
  const double gain = kRayShare * static_cast<double>(ping_gain_);
  const double size_m = 0.5 * (body.semi_axis_first_m + body.semi_axis_second_m);
  const double brighter = std::clamp(kUsualBody_m / size_m, 1.0, kMostBrighter);
  const double front = bell(std::acos(std::min(hit.cos_incidence, 1.0)) / kBodyFront_rad);
  const double first = grid_.bin_at(hit.range_m);
  add(first, kPulseBins, gain * kBodyFront * front * glint_at(hit.range_m));
  const double bin_m = grid_.range_m / grid_.bins;
  const double depth_m = std::min(hit.leaves_m - hit.range_m, 3.0 * kBodyDepth_m);
  for (double in_m = 0.0; in_m < depth_m && hit.range_m + in_m < grid_.range_m; in_m += bin_m) {
    const double heard = kBodyLevel * brighter * std::exp(-in_m / kBodyDepth_m);
    add(first + in_m / bin_m, 1.0, gain * heard * glint_at(hit.range_m + in_m));
  }
}

void SurfaceEchoes::hear_beam(const HeardScene& scene, EchoLevels& levels,
                              std::uint32_t beam) noexcept {
  double sight_m = std::numeric_limits<double>::infinity();
  double leaves_m = 0.0;
  int met = 0;
  for (int ray = 0; ray < kRaysOfBeam; ++ray) {
    const double across = beam + (ray + 0.5) * kRayShare;
    const double bearing_rad = (across / grid_.beams - 0.5) * grid_.sector_rad;
    const HeardSurface surface = scene.surface(bearing_rad);
    if (!(surface.hit.range_m < grid_.range_m)) {
      continue;
    }
    ++met;
    sight_m = std::min(sight_m, surface.hit.range_m);
    leaves_m = std::max(leaves_m, surface.hit.leaves_m);
    if (is_small_body(*surface.obstacle)) {
      const double in_world_rad = scene.pose().angle_to_world_rad(bearing_rad);
      hear_body(surface, scene.pose().p_WV, {std::sin(in_world_rad), std::cos(in_world_rad)});
    } else {
      hear_wall(surface, levels);
    }
  }
  sights_m_[beam] = sight_m;
  if (met > 0) {
    const double from = std::min(grid_.bin_at(leaves_m), static_cast<double>(grid_.bins));
    levels.shadow(beam) = {static_cast<std::uint32_t>(from),
                           static_cast<float>(1.0 - (1.0 - kind_.shadow) * met * kRayShare)};
  }
}

// Each corner of a wall, and each end, is heard from everywhere: a wall seen end on, too.
void SurfaceEchoes::hear_corners(const HeardScene& scene, EchoLevels& levels) noexcept {
  for (const Obstacle& wall : scene.obstacles()) {
    for (std::uint32_t i = 0; wall.shape != ObstacleShape::kEllipse && i < wall.vertex_count; ++i) {
      const Eigen::Vector2d at =
          scene.pose().to_vehicle({{wall.vertices[i].x_m, wall.vertices[i].y_m}}).xy_m;
      const double range_m = at.norm();
      const double beam = grid_.beam_at(std::atan2(at.x(), at.y()));
      if (!(range_m < grid_.range_m) || beam < 0.0 || beam >= grid_.beams) {
        continue;
      }
      const auto nearest = static_cast<std::uint32_t>(beam);
      const double bin = grid_.bin_at(range_m);
      if (grid_.bin_at(sights_m_[nearest]) < bin - 2.0 * kPulseBins) {
        continue;  // it lies behind something
      }
      const double water = std::max(
          static_cast<double>(levels.water()[static_cast<std::size_t>(bin)]), kFaintestWater);
      add(bin - 0.5 * kPulseBins, kPulseBins, water * kCorner * glint(wall.id, i, -1.0));
      spread(nearest, levels);
    }
  }
}

// Rounds the pulse, smears what is behind it, and adds all to the beam and those beside it; the
// column is silent again.
void SurfaceEchoes::spread(std::uint32_t beam, EchoLevels& levels) noexcept {
  if (begin_ >= end_) {
    return;
  }
  const double length = std::max(grid_.bins_of_nominal(kind_.smear_nominal_m), 1.0);
  const auto stays = static_cast<float>(std::exp(-1.0 / length));
  const auto left = static_cast<float>(kind_.smear);
  constexpr float kSilent = 0.05F;
  float before = 0.0F;
  float smear = 0.0F;
  std::uint32_t bin = begin_;
  for (; bin < grid_.bins && (bin < end_ || smear > kSilent); ++bin) {
    const float here = column_[bin];
    const float after = bin + 1 < grid_.bins ? column_[bin + 1] : 0.0F;
    column_[bin] = 0.25F * before + 0.5F * here + 0.25F * after + smear;
    before = here;
    smear = std::max(stays * smear, left * here);
  }
  const auto far = static_cast<int>(kHeardAside.size()) - 1;
  for (int off = -far; off <= far; ++off) {
    const int to = static_cast<int>(beam) + off;
    if (to < 0 || to >= static_cast<int>(grid_.beams)) {
      continue;
    }
    const auto heard = static_cast<std::uint32_t>(to);
    add_share(levels.beam(heard).data() + begin_, column_.data() + begin_, bin - begin_,
              kHeardAside[static_cast<std::size_t>(std::abs(off))]);
    touched_[heard].begin = std::min(touched_[heard].begin, begin_);
    touched_[heard].end = std::max(touched_[heard].end, bin);
  }
  std::fill(column_.begin() + begin_, column_.begin() + bin, 0.0F);
  begin_ = grid_.bins;
  end_ = 0;
}

// Of the brightest echo of each range, and of what a closed room makes of it.
void SurfaceEchoes::ring(EchoLevels& levels) noexcept {
  std::fill(brightest_.begin(), brightest_.end(), 0.0F);
  for (std::uint32_t beam = 0; beam < grid_.beams; ++beam) {
    const float* const cells = levels.beam(beam).data();
    for (std::uint32_t bin = touched_[beam].begin; bin < touched_[beam].end; ++bin) {
      brightest_[bin] = std::max(brightest_[bin], cells[bin]);
    }
  }
  const double length = std::max(grid_.bins_of_nominal(kind_.room_echo_nominal_m), 1.0);
  const auto stays = static_cast<float>(std::exp(-1.0 / length));
  const auto side_lobe = static_cast<float>(kind_.side_lobe);
  const auto left = static_cast<float>(kind_.room_echo);
  float room = 0.0F;
  for (std::uint32_t bin = 0; bin < grid_.bins; ++bin) {
    levels.ring()[bin] += side_lobe * brightest_[bin] + room;
    room = std::max(stays * room, left * brightest_[bin]);
  }
}

void SurfaceEchoes::draw(const HeardScene& scene, EchoLevels& levels,
                         RandomStream& chance) noexcept {
  ping_gain_ = static_cast<float>(std::exp(kPingGain * chance.gaussian()));
  begin_ = grid_.bins;
  end_ = 0;
  std::fill(touched_.begin(), touched_.end(), Part{grid_.bins, 0});
  for (std::uint32_t beam = 0; beam < grid_.beams; ++beam) {
    hear_beam(scene, levels, beam);
    spread(beam, levels);
  }
  hear_corners(scene, levels);
  ring(levels);
}

}  // namespace lodesman
