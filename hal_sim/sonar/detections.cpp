// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/detections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace lodesman {
namespace {

constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
// Ours, as small things in real frames come and go: an obstacle that is missed, and returns of
// nothing, last from one ping to so many, two on average.
constexpr std::uint32_t kMostPings = 3;
constexpr double kMeanPings = 2.0;
constexpr std::uint32_t kLeastHole = 2;  // beams
constexpr std::uint32_t kMostHole = 4;
constexpr std::uint32_t kLeastCluster = 3;  // beams
constexpr std::uint32_t kMostCluster = 6;
// Far more than the highest rate ever has at once.
constexpr std::size_t kMostClusters = 64;
// 0 would be no return.
constexpr double kNearest_m = 0.01;

// From the least to the most, each as often.
[[nodiscard]] std::uint32_t draw_between(RandomStream& random, std::uint32_t least,
                                         std::uint32_t most) noexcept {
  return least + static_cast<std::uint32_t>(random.uniform() * (most - least + 1));
}

// With which something has to begin, wherever it does not go on, to be there in such a share of the
// pings.
[[nodiscard]] double beginning_chance(double share) noexcept {
  return share / (share + kMeanPings * (1.0 - share));
}

// How many of things that do not wait for one another happen.
[[nodiscard]] std::uint32_t draw_count(RandomStream& random, double mean) noexcept {
  std::uint32_t count = 0;
  for (double left = std::exp(-mean), product = random.uniform(); product > left;
       product *= random.uniform()) {
    ++count;
  }
  return count;
}

// Nearest first, as a profile has one return a beam.
void put_return(double range_m, SonarPing& ping, std::uint32_t beam) noexcept {
  ProfilePoint& point = ping.points[beam];
  if (range_m < ping.range_m && (!(point.range_m > 0.0) || range_m < point.range_m)) {
    point = {std::max(range_m, kNearest_m), kBrightestEcho};
  }
}

}  // namespace

Detections::Detections(std::size_t obstacles, const DetectionErrors& errors, std::uint64_t seed)
    : errors_{errors},
      lots_(obstacles),
      turned_rad_(obstacles),
      noise_{"detections: noise", seed},
      false_{"detections: false ones", seed} {
  random_.reserve(obstacles);
  for (std::size_t i = 0; i < obstacles; ++i) {
    random_.emplace_back("detections: obstacle " + std::to_string(i + 1), seed);
  }
  clusters_.reserve(kMostClusters);
}

void Detections::detect(const HeardScene& scene, SonarPing& ping) noexcept {
  draw_lots(ping.beam_step_rad);
  hear(scene, ping);
  cut_holes(ping);
  renew_clusters(ping);
  add_clusters(ping);
}

void Detections::draw_lots(double beam_step_rad) noexcept {
  const double begins = beginning_chance(errors_.missed);
  for (std::size_t i = 0; i < lots_.size(); ++i) {
    RandomStream& random = random_[i];
    const std::uint32_t missed_before = lots_[i].missed_pings;
    Lot& lot = lots_[i] = {};
    const bool begins_now = random.uniform() < begins;
    const std::uint32_t lasts = draw_between(random, 1, kMostPings);
    lot.missed_pings = missed_before > 1 ? missed_before - 1 : begins_now ? lasts : 0;
    lot.is_split = random.uniform() < errors_.split;
    lot.hole = draw_between(random, kLeastHole, kMostHole);
    lot.hole_place = random.uniform();
    lot.off_m = errors_.displaced_m * random.gaussian();
    const double turned_beams = 2.0 * random.uniform() - 1.0;
    turned_rad_[i] = errors_.displaced_m > 0.0 ? turned_beams * beam_step_rad : 0.0;
  }
}

// An obstacle that is missed keeps its beams: what is behind it stays hidden, and they are silent.
void Detections::hear(const HeardScene& scene, SonarPing& ping) noexcept {
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    noise_m_[beam] = errors_.noise_m * noise_.gaussian();
    heard_[beam] = kNobody;
    ping.points[beam] = {};
    const HeardScene::Surface met = scene.nearest(ping.bearing_rad(beam), turned_rad_);
    if (met.range_m < ping.range_m && lots_[met.obstacle].missed_pings == 0) {
      Lot& lot = lots_[met.obstacle];
      put_return(met.range_m + lot.off_m + noise_m_[beam], ping, beam);
      heard_[beam] = met.obstacle;
      ++lot.beams;
    }
  }
}

// At least one beam of it is left on either side; what has too few for that stays whole.
void Detections::cut_holes(SonarPing& ping) noexcept {
  for (std::uint32_t beam = 0; beam < ping.beams; ++beam) {
    if (heard_[beam] == kNobody) {
      continue;
    }
    Lot& lot = lots_[heard_[beam]];
    const std::uint32_t place = lot.passed++;
    if (!lot.is_split || lot.beams < 3) {
      continue;
    }
    const std::uint32_t hole = std::min(lot.hole, lot.beams - 2);
    const std::uint32_t places = lot.beams - 1 - hole;
    const std::uint32_t first = 1 + static_cast<std::uint32_t>(lot.hole_place * places);
    if (place >= first && place < first + hole) {
      ping.points[beam] = {};
    }
  }
}

void Detections::renew_clusters(const SonarPing& ping) noexcept {
  std::erase_if(clusters_, [](Cluster& cluster) { return --cluster.pings_left == 0; });
  for (std::uint32_t i = draw_count(false_, errors_.false_per_ping / kMeanPings); i > 0; --i) {
    const Cluster cluster = draw_cluster(ping);
    if (clusters_.size() < kMostClusters) {
      clusters_.push_back(cluster);
    }
  }
}

// Anywhere in the fan's water, each square metre as often.
Detections::Cluster Detections::draw_cluster(const SonarPing& ping) noexcept {
  Cluster cluster;
  cluster.range_m = ping.range_m * std::sqrt(false_.uniform());
  cluster.beams = std::min(draw_between(false_, kLeastCluster, kMostCluster), ping.beams);
  cluster.first_beam = draw_between(false_, 0, ping.beams - cluster.beams);
  cluster.pings_left = draw_between(false_, 1, kMostPings);
  return cluster;
}

void Detections::add_clusters(SonarPing& ping) noexcept {
  for (const Cluster& cluster : clusters_) {
    for (std::uint32_t beam = cluster.first_beam; beam < cluster.first_beam + cluster.beams;
         ++beam) {
      put_return(cluster.range_m + noise_m_[beam], ping, beam);
    }
  }
}

}  // namespace lodesman
