// SPDX-License-Identifier: Apache-2.0
// Whether a sonar's pings tell of the water at all, and in which beams: what tells free water from
// a head that is saturated, hangs, or is covered. The DeltaT task shows it each image before it is
// looked into. One thread; it allocates when made and never after.
//
// Levels are judged against the rest of the fan and against what each beam was, slowly learnt; but
// for white, none is of itself too much or too little. So only pings with a background can be
// judged, in which most cells of the beams that hear are not 0. Where there is none, as in
// simulated pings without noise or in pictures drawn from detections, silence is no trouble, and an
// image that comes again is none either: a boat at rest before a wall sees it so.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "low_level/sonar/ping_sample.h"
#include "mid_level/messages/sonar.h"

namespace lodesman {

// The gravest first.
enum class PingTrouble : std::uint8_t {
  kNone,
  kSaturated,     // nearly all is white
  kFrozen,        // speckle comes again bit for bit
  kDeaf,          // from one ping to the next no beam hears anything any more
  kWeed,          // some beams hear a bright haze at the head and nothing behind it
  kBlindSector,   // some beams hear nothing
  kInterference,  // bright rays in many bearings
};

class PingWatch {
 public:
  // Once a ping. A profile, and an image too small to be judged, has no trouble.
  void look(const SonarPing& ping) noexcept;

  // Whether what was looked at last tells of the water: it is not saturated, frozen or deaf.
  [[nodiscard]] bool tells_of_water() const noexcept { return tells_of_water_; }
  // What has ailed several pings of late.
  [[nodiscard]] PingTrouble trouble() const noexcept;
  // [-] 1 for each beam of the last ping that heard nothing of the water, even if it is the first
  // one in which it did not: what is free must have been heard. Empty: all of them hear.
  [[nodiscard]] std::span<const std::uint8_t> blind() const noexcept {
    return std::span{blind_}.first(any_blind_ ? sample_.beams() : 0);
  }

 private:
  // What has to be so in several pings before it is told, and not so in several before it is over.
  class Lasting {
   public:
    void add(bool is_so) noexcept {
      count_ = is_so ? std::min(count_ + 1, kMost) : std::max(count_ - 1, 0);
      lasts_ = count_ >= kSeveral || (lasts_ && count_ > 0);
    }
    [[nodiscard]] bool lasts() const noexcept { return lasts_; }

   private:
    static constexpr int kSeveral = 4;
    static constexpr int kMost = 10;
    int count_ = 0;
    bool lasts_ = false;
  };
  struct Beam {
    Lasting blind;
    bool is_suspect = false;     // blind in the last ping that could be judged
    bool is_hazy = false;        // that, and bright at the head
    float usual_level = 0.0F;    // [-] of what most beams have, learnt
    float usual_at_head = 0.0F;  // [-] the same at the head
  };

  void begin_anew() noexcept;
  // What most beams that hear have in each block; whether that is a background.
  [[nodiscard]] bool find_background() noexcept;
  [[nodiscard]] bool is_dark() const noexcept;
  [[nodiscard]] float level_of(std::uint32_t beam) const noexcept;
  void judge_beams() noexcept;
  void judge(std::uint32_t index, float level, float at_head) noexcept;
  [[nodiscard]] bool has_many_rays() const noexcept;
  void mark_blind() noexcept;

  PingSample sample_;
  std::array<Beam, kMaxBeams> all_beams_{};
  std::array<std::uint8_t, kMaxBeams> blind_{};
  std::array<std::uint32_t, kMaxBeams> hearing_{};  // the beams that do
  std::uint32_t hearing_count_ = 0;
  PingSample::Levels background_{};
  std::array<float, kMaxBeams> sorted_{};
  std::uint32_t learnt_ = 0;  // [-] pings, as far as they are counted
  bool had_background_ = false;
  bool is_deaf_ = false;  // in the last ping: all at once, which no other water does
  bool any_blind_ = false;
  bool tells_of_water_ = true;
  Lasting saturated_;
  Lasting frozen_;
  Lasting deaf_;
  Lasting sector_;
  Lasting weed_;
  Lasting rays_;
};

}  // namespace lodesman
