// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/ping_watch.h"

#include <cstddef>

namespace lodesman {
namespace {

constexpr double kSaturatedShare = 0.9;   // of the cells
constexpr double kBackgroundShare = 0.5;  // of the cells are not 0, where beams hear
constexpr double kDarkShare = 0.02;       // of the cells are not 0, where none does
// The loudest beams, but for a few that may be rays, say what hearing is; a beam that has so much
// of it is one of those that say what most have.
constexpr double kLoudest = 0.98;
constexpr float kHears = 0.05F;
constexpr std::uint32_t kEnoughBeams = 64;
// An echo counts as no more than this: one that comes or goes is no change of a beam's level.
constexpr float kMostOfBackground = 1.5F;
// Of what most beams have, and of what it had itself. In the shared real frames no beam has less
// than 0.15, nor falls below 0.41.
constexpr float kSilentShare = 0.06F;
constexpr float kFallenShare = 0.15F;
constexpr float kHazeBrightness = 2.0F;  // times what most beams have at the head, and it had
constexpr std::uint32_t kKnows = 20;     // [ping] after which what is learnt counts
constexpr std::uint32_t kMemory = 256;   // [ping] that it is learnt over
constexpr double kToldShare = 0.02;      // of the beams: a few that are dead are no sector
// A ray is brighter than what is beside it, some degrees off, in most of its blocks. In the shared
// real frames there are 3 at most.
constexpr float kRayBrightness = 1.7F;
constexpr std::uint32_t kRayBlocks = PingSample::kBlocks / 2;
constexpr std::uint32_t kLeastBeside = 3;   // [beam]
constexpr std::uint32_t kBesideShare = 40;  // one in so many beams
constexpr std::uint32_t kManyRays = 7;      // that are apart
constexpr float kLeastLevel = 1e-6F;        // that is divided by

// The value that so large a share of some is not above. Moves them about.
[[nodiscard]] float quantile(std::span<float> values, double share) noexcept {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

void PingWatch::look(const SonarPing& ping) noexcept {
  tells_of_water_ = true;
  const bool can_be_judged = sample_.take(ping);
  if (!can_be_judged || sample_.is_another_fan()) {
    begin_anew();
  }
  if (!can_be_judged) {
    return;
  }
  const bool is_white = sample_.white_share() >= kSaturatedShare;
  saturated_.add(is_white);
  if (is_white) {
    tells_of_water_ = false;
    return;
  }
  const bool has_background = find_background();
  const bool repeats = has_background && sample_.repeats() && sample_.is_speckled();
  frozen_.add(repeats);
  if (repeats) {
    tells_of_water_ = !frozen_.lasts();
    return;
  }
  is_deaf_ = !has_background && (is_deaf_ || (had_background_ && learnt_ >= kKnows)) && is_dark();
  deaf_.add(is_deaf_);
  had_background_ = has_background;
  if (is_deaf_) {
    tells_of_water_ = false;
    return;
  }
  if (has_background) {
    rays_.add(has_many_rays());
    judge_beams();
  }
  mark_blind();
}

PingTrouble PingWatch::trouble() const noexcept {
  return saturated_.lasts() ? PingTrouble::kSaturated
         : frozen_.lasts()  ? PingTrouble::kFrozen
         : deaf_.lasts()    ? PingTrouble::kDeaf
         : weed_.lasts()    ? PingTrouble::kWeed
         : sector_.lasts()  ? PingTrouble::kBlindSector
         : rays_.lasts()    ? PingTrouble::kInterference
                            : PingTrouble::kNone;
}

void PingWatch::begin_anew() noexcept {
  all_beams_.fill({});
  blind_.fill(0);
  learnt_ = 0;
  had_background_ = is_deaf_ = any_blind_ = false;
  saturated_ = frozen_ = deaf_ = sector_ = weed_ = rays_ = {};
}

bool PingWatch::find_background() noexcept {
  const std::span<const float> far = sample_.far();
  const std::span<float> sorted = std::span{sorted_}.first(far.size());
  std::copy(far.begin(), far.end(), sorted.begin());
  const float loudest = quantile(sorted, kLoudest);
  hearing_count_ = 0;
  double lit = 0.0;
  for (std::uint32_t beam = 0; beam < far.size(); ++beam) {
    if (far[beam] > kHears * loudest) {
      hearing_[hearing_count_++] = beam;
      lit += static_cast<double>(sample_.lit_share(beam));
    }
  }
  if (hearing_count_ == 0 || lit < kBackgroundShare * hearing_count_) {
    return false;
  }
  const std::uint32_t step = (hearing_count_ + kEnoughBeams - 1) / kEnoughBeams;
  for (std::uint32_t block = 0; block < PingSample::kBlocks; ++block) {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < hearing_count_; i += step) {
      sorted_[count++] = sample_.levels(hearing_[i])[block];
    }
    background_[block] = quantile(std::span{sorted_}.first(count), 0.5);
  }
  return true;
}

bool PingWatch::is_dark() const noexcept {
  double lit = 0.0;
  for (std::uint32_t beam = 0; beam < sample_.beams(); ++beam) {
    lit += static_cast<double>(sample_.lit_share(beam));
  }
  return lit < kDarkShare * sample_.beams();
}

// Against what most beams have in each block.
float PingWatch::level_of(std::uint32_t beam) const noexcept {
  float sum = 0.0F;
  std::uint32_t blocks = 0;
  for (std::uint32_t block = 0; block < PingSample::kBlocks; ++block) {
    if (background_[block] > 0.0F) {
      sum += std::min(sample_.levels(beam)[block] / background_[block], kMostOfBackground);
      ++blocks;
    }
  }
  return sum / static_cast<float>(std::max(blocks, 1U));
}

void PingWatch::judge_beams() noexcept {
  const std::span<const float> near = sample_.near();
  for (std::uint32_t i = 0; i < hearing_count_; ++i) {
    sorted_[i] = near[hearing_[i]];
  }
  const float usual_near = quantile(std::span{sorted_}.first(hearing_count_), 0.5);
  // Rays come with noise, which is no background of the water's.
  learnt_ = rays_.lasts() ? learnt_ : std::min(learnt_ + 1, kMemory);
  for (std::uint32_t beam = 0; beam < sample_.beams(); ++beam) {
    judge(beam, level_of(beam), near[beam] / std::max(usual_near, kLeastLevel));
  }
}

void PingWatch::judge(std::uint32_t index, float level, float at_head) noexcept {
  Beam& beam = all_beams_[index];
  const bool has_fallen = learnt_ > kKnows && level < kFallenShare * beam.usual_level;
  beam.is_suspect = level < kSilentShare || has_fallen;
  beam.blind.add(beam.is_suspect);
  beam.is_hazy = beam.is_suspect && at_head > kHazeBrightness * std::max(1.0F, beam.usual_at_head);
  if (!beam.is_suspect && !rays_.lasts()) {
    const float weight = 1.0F / static_cast<float>(learnt_);
    beam.usual_level += weight * (level - beam.usual_level);
    beam.usual_at_head += weight * (at_head - beam.usual_at_head);
  }
}

bool PingWatch::has_many_rays() const noexcept {
  const std::uint32_t beams = sample_.beams();
  const std::uint32_t beside = std::max(kLeastBeside, beams / kBesideShare);
  std::uint32_t rays = 0;
  bool is_in_one = false;
  for (std::uint32_t beam = beside; beam + beside < beams; ++beam) {
    const PingSample::Levels& here = sample_.levels(beam);
    const PingSample::Levels& left = sample_.levels(beam - beside);
    const PingSample::Levels& right = sample_.levels(beam + beside);
    std::uint32_t bright = 0;
    for (std::uint32_t block = 0; block < PingSample::kBlocks; ++block) {
      bright += here[block] > kRayBrightness * std::max(left[block], right[block]) ? 1U : 0U;
    }
    const bool is_ray = bright > kRayBlocks;
    rays += is_ray && !is_in_one ? 1U : 0U;
    is_in_one = is_ray;
  }
  return rays >= kManyRays;
}

void PingWatch::mark_blind() noexcept {
  std::uint32_t blind = 0;
  std::uint32_t lasting = 0;
  std::uint32_t hazy = 0;
  for (std::uint32_t i = 0; i < sample_.beams(); ++i) {
    const Beam& beam = all_beams_[i];
    const bool is_blind = beam.blind.lasts() || (had_background_ && beam.is_suspect);
    blind_[i] = is_blind ? 1 : 0;
    blind += is_blind ? 1U : 0U;
    lasting += beam.blind.lasts() ? 1U : 0U;
    hazy += beam.is_hazy ? 1U : 0U;
  }
  any_blind_ = blind > 0;
  const bool is_sector = lasting > kToldShare * sample_.beams();
  sector_.add(is_sector);
  weed_.add(is_sector && 2 * hazy > lasting);
}

}  // namespace lodesman
