// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/delta_t_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "hal_sim/emulators/chance.h"
#include "hal_sim/sonar/heard_scene.h"
#include "mid_level/base/heading.h"

namespace lodesman {

using emulated::DeltaTHeader;
using emulated::DeltaTRecord;

namespace {

constexpr double kNominalSoundSpeed_m_s = 1500.0;  // that ranges in the records are counted with
constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr double kNoGain_db = 10.0;  // ours: at this gain an echo is as bright as it is
constexpr double kBrightest = 255.0;
constexpr double kFineBins = 5000.0;
constexpr double kPulse_us_per_m = 6.0;
constexpr std::size_t kLargestRecord = 65507;
// The world's steps come with the jitter of its thread: a ping so early is due.
constexpr Duration kEarly_max = std::chrono::milliseconds{5};
constexpr Duration kLatencyCount = std::chrono::microseconds{100};

[[nodiscard]] Duration up_to_multiple(Duration time, Duration of) noexcept {
  return of <= Duration::zero() ? time : (time + of - Duration{1}) / of * of;
}

[[nodiscard]] std::uint16_t latency_counts(Duration latency) noexcept {
  return static_cast<std::uint16_t>(std::clamp<Duration::rep>(latency / kLatencyCount, 0, 65535));
}

}  // namespace

DeltaTProgram::DeltaTProgram(const DeltaTProgramOptions& options, Time now)
    : options_{options},
      settings_{options.settings},
      repeats_{"delta_t repeat", options.seed},
      spoils_{"delta_t corrupt", options.seed},
      foreign_{"delta_t foreign", options.seed},
      ping_fault_{options.seed},
      foreign_until_{now} {}

void DeltaTProgram::power_cycle(Time now) {
  settings_ = options_.settings;
  number_ = 0;
  any_ping_ = false;
  foreign_until_ = now;
  heard_.clear();
  waiting_.clear();
}

bool DeltaTProgram::has_fault(FaultKind kind) const noexcept {
  switch (kind) {
    case FaultKind::kCorrupt:
    case FaultKind::kPower:
    case FaultKind::kForeign:
    case FaultKind::kRepeat:
    case FaultKind::kJump:
    case FaultKind::kRange:
    case FaultKind::kOutput:
    case FaultKind::kAverage:
    case FaultKind::kCentimetres: return true;
    default: return settings_.sends_image && alters_pings(FaultDevice::kSonar, kind);
  }
}

void DeltaTProgram::begun(const Fault& fault, Time /*now*/) {
  if (fault.kind == FaultKind::kJump) {
    number_ += static_cast<std::uint32_t>(static_cast<std::int64_t>(fault.value));
  } else if (fault.kind == FaultKind::kRange) {
    settings_.range_m = static_cast<std::uint16_t>(fault.value);
  } else if (fault.kind == FaultKind::kOutput) {
    settings_.sends_image = !settings_.sends_image;
  }
}

bool DeltaTProgram::makes_images() const noexcept {
  return settings_.sends_image && options_.images_are_120_by_120;
}

std::size_t DeltaTProgram::beams() const noexcept { return makes_images() ? 120 : settings_.beams; }

// As the header has it, in hundredths: what a byte of them does not hold is cut off.
double DeltaTProgram::increment_deg() const noexcept {
  const double sector_deg = makes_images() ? 120.0 : settings_.sector_deg;
  return std::floor(sector_deg * 100.0 / static_cast<double>(beams()) + 1e-9) / 100.0;
}

double DeltaTProgram::bearing_rad(std::size_t beam) const noexcept {
  const double count = static_cast<double>(beams());
  return to_rad(increment_deg() * count) * ((static_cast<double>(beam) + 0.5) / count - 0.5);
}

std::uint16_t DeltaTProgram::resolution_mm(bool fine) const noexcept {
  const double bins = fine ? kFineBins : options_.samples;
  return static_cast<std::uint16_t>(std::lround(settings_.range_m * 1000.0 / bins));
}

double DeltaTProgram::brightness() const noexcept {
  return settings_.transmits ? std::pow(10.0, (settings_.gain_db - kNoGain_db) / 20.0) : 0.0;
}

std::size_t DeltaTProgram::averaged() const noexcept {
  const Running* forced = running(FaultKind::kAverage);
  const int pings = forced != nullptr ? static_cast<int>(forced->fault.value) : settings_.averaged;
  return static_cast<std::size_t>(std::max(pings, 1));
}

Duration DeltaTProgram::latency() const noexcept {
  if (options_.instant) {
    return Duration::zero();
  }
  const Duration way = from_seconds(2.0 * settings_.range_m / options_.water_sound_speed_m_s);
  return up_to_multiple(up_to_multiple(way + options_.processing, kLatencyCount),
                        options_.leaves_at_multiples_of);
}

// No ping before the sound of the one before has come back.
Duration DeltaTProgram::period() const noexcept {
  return std::max(options_.period,
                  from_seconds(2.0 * settings_.range_m / options_.water_sound_speed_m_s));
}

bool DeltaTProgram::is_due(Time now) const noexcept {
  return !is_off() && (!any_ping_ || now + kEarly_max >= next_ping_);
}

void DeltaTProgram::count(Time now) {
  const bool is_behind = !any_ping_ || now >= next_ping_ + period();
  next_ping_ = (is_behind ? now : next_ping_) + period();
  any_ping_ = true;
  const Running* repeat = running(FaultKind::kRepeat);
  if (repeat != nullptr && emulated::happens(repeats_, repeat->fault.rate) && number_ != 0) {
    note(FaultKind::kRepeat, now);
  } else {
    ++number_;
  }
}

Fault DeltaTProgram::ping_fault() const noexcept {
  for (const FaultKind kind : {FaultKind::kSaturated, FaultKind::kFrozen, FaultKind::kBlinded,
                               FaultKind::kWeed, FaultKind::kInterference}) {
    if (const Running* one = running(kind); one != nullptr) {
      return one->fault;
    }
  }
  return {};
}

DeltaTProgram::Heard DeltaTProgram::hear(std::span<const double> surfaces_m, double thrust_load) {
  Heard heard;
  // Counted by the nominal speed of sound, whatever the water's is.
  const double scale = kNominalSoundSpeed_m_s / options_.water_sound_speed_m_s;
  for (const double surface_m : surfaces_m) {
    heard.surfaces_m.push_back(surface_m * scale);
  }
  if (settings_.sends_image) {
    draw(thrust_load, heard);
  }
  return heard;
}

void DeltaTProgram::draw(double thrust_load, Heard& heard) {
  const std::size_t samples = options_.samples;
  const std::size_t count = heard.surfaces_m.size();
  heard.image.resize(samples * count);
  for (std::size_t beam = 0; beam < count; ++beam) {
    draw_echo(heard.surfaces_m[beam], settings_.range_m,
              std::span{heard.image}.subspan(beam * samples, samples));
  }
  const double bright = brightness();
  for (std::uint8_t& echo : heard.image) {
    echo = static_cast<std::uint8_t>(std::min(std::round(echo * bright), kBrightest));
  }
  ping_fault_.alter(
      ping_fault(), thrust_load,
      {heard.image, static_cast<std::uint32_t>(count), options_.samples,
       static_cast<double>(settings_.range_m), bearing_rad(0), to_rad(increment_deg())});
}

// Of one geometry alone: after a change the mean begins anew.
void DeltaTProgram::remember(Heard heard) {
  if (!heard_.empty() && (heard_.back().image.size() != heard.image.size() ||
                          heard_.back().surfaces_m.size() != heard.surfaces_m.size())) {
    heard_.clear();
  }
  heard_.push_back(std::move(heard));
  while (heard_.size() > averaged()) {
    heard_.pop_front();
  }
}

std::vector<std::uint8_t> DeltaTProgram::mean_image() const {
  std::vector<std::uint8_t> mean = heard_.back().image;
  if (heard_.size() == 1) {
    return mean;
  }
  for (std::size_t i = 0; i < mean.size(); ++i) {
    std::size_t sum = 0;
    for (const Heard& heard : heard_) {
      sum += heard.image[i];
    }
    mean[i] = static_cast<std::uint8_t>(sum / heard_.size());
  }
  return mean;
}

// Of the pings that had a return, where at least half of them had.
double DeltaTProgram::mean_surface_m(std::size_t beam) const noexcept {
  double sum_m = 0.0;
  std::size_t returns = 0;
  for (const Heard& heard : heard_) {
    if (heard.surfaces_m[beam] < settings_.range_m) {
      sum_m += heard.surfaces_m[beam];
      ++returns;
    }
  }
  return returns * 2 >= heard_.size() && returns > 0 ? sum_m / static_cast<double>(returns)
                                                     : std::numeric_limits<double>::infinity();
}

DeltaTHeader DeltaTProgram::header(const PingSituation& situation, Time now) const {
  DeltaTHeader header;
  header.record = settings_.sends_image ? DeltaTRecord::k83B : DeltaTRecord::k83P;
  header.time = emulated::civil_time(options_.epoch + now.time_since_epoch());
  header.has_position = true;
  header.latitude_deg = situation.latitude_deg;
  header.longitude_deg = situation.longitude_deg;
  header.speed_kn = situation.speed_m_s / kKnot_m_s;
  const double course_deg = to_deg(situation.course_rad);
  header.course_deg = course_deg < 0.0 ? course_deg + 360.0 : course_deg;
  header.pitch = header.roll = {0.0, true};
  header.heading = {to_deg(situation.heading_true_rad), true};
  header.beams = static_cast<std::uint16_t>(beams());
  header.samples = options_.samples;
  header.sector_deg = makes_images() ? std::uint16_t{120} : settings_.sector_deg;
  header.increment_deg = increment_deg();
  header.start_deg = (1.0 - static_cast<double>(beams())) * header.increment_deg / 2.0;
  header.range_m = settings_.range_m;
  header.frequency_khz = options_.frequency_khz;
  header.sound_speed_m_s = settings_.sound_speed_m_s;
  const bool is_fine = options_.fine_ranges && !settings_.sends_image;
  header.resolution_mm = resolution_mm(is_fine);
  if (running(FaultKind::kCentimetres) != nullptr) {
    header.resolution_mm = static_cast<std::uint16_t>((header.resolution_mm + 5) / 10);
  }
  header.pulse_us = static_cast<std::uint16_t>(settings_.range_m * kPulse_us_per_m);
  header.tilt_deg = settings_.tilt_deg;
  header.repetition_ms =
      static_cast<std::uint16_t>(std::chrono::round<std::chrono::milliseconds>(period()).count());
  header.ping = number_;
  header.has_intensity = options_.has_intensity && !settings_.sends_image;
  const Duration before = options_.instant ? Duration::zero() : options_.ping_latency;
  header.ping_latency_100us = latency_counts(before);
  header.data_latency_100us = latency_counts(before + latency());
  header.fine_ranges = is_fine;
  if (averaged() > 1) {
    header.averaged = static_cast<std::uint8_t>(averaged());
    header.centre_ping_100us =
        latency_counts(period() * static_cast<std::int64_t>(averaged() - 1) / 2);
  }
  header.external = options_.external;
  header.whole_image_header = options_.whole_image_header;
  return header;
}

std::vector<std::uint8_t> DeltaTProgram::record(const DeltaTHeader& header) const {
  if (settings_.sends_image) {
    return emulated::image_record(header, mean_image());
  }
  const double peak = std::min(std::round(kBrightestEcho * brightness()), kBrightest);
  const bool is_heard = peak >= kBrightest * settings_.profile_least_level_percent / 100.0;
  const double resolution_m = resolution_mm(header.fine_ranges) * 1e-3;
  std::vector<std::uint16_t> ranges;
  std::vector<std::uint16_t> intensities;
  for (std::size_t beam = 0; beam < beams(); ++beam) {
    const double surface_m = mean_surface_m(beam);
    const bool returns =
        is_heard && surface_m < settings_.range_m && surface_m >= settings_.profile_least_range_m;
    const double counts = returns ? std::max(std::round(surface_m / resolution_m), 1.0) : 0.0;
    ranges.push_back(static_cast<std::uint16_t>(counts));
    if (header.has_intensity) {
      intensities.push_back(static_cast<std::uint16_t>(returns ? peak : 0.0));
    }
  }
  return emulated::profile_record(header, ranges, intensities);
}

// Its length is not what it says it is.
void DeltaTProgram::spoil(std::vector<std::uint8_t>& record, Time now) {
  if (running(FaultKind::kCorrupt) != nullptr) {
    record[5] = static_cast<std::uint8_t>(record[5] ^ (1U + emulated::one_of(spoils_, 255)));
    note(FaultKind::kCorrupt, now);
  }
}

void DeltaTProgram::ping(std::span<const double> surfaces_m, const PingSituation& situation,
                         Time now) {
  if (is_off() || surfaces_m.size() != beams()) {
    return;
  }
  count(now);
  remember(hear(surfaces_m, situation.thrust_load));
  // A profile without its points is none, and an image too large for a datagram is not sent.
  if (!settings_.sends_image && !settings_.profile_points) {
    return;
  }
  std::vector<std::uint8_t> sent = record(header(situation, now));
  if (sent.size() > kLargestRecord) {
    return;
  }
  spoil(sent, now);
  waiting_.push_back({now + latency(), std::move(sent)});
}

void DeltaTProgram::say_foreign(Time now, std::vector<Utterance>& said) {
  const Duration passed = now - foreign_until_;
  foreign_until_ = now;
  const Running* fault = running(FaultKind::kForeign);
  if (fault == nullptr) {
    foreign_left_ = -1.0;
    return;
  }
  if (foreign_left_ < 0.0) {
    foreign_left_ = emulated::exponential(foreign_);
  }
  foreign_left_ -= fault->fault.rate * to_seconds(passed);
  while (foreign_left_ < 0.0) {
    foreign_left_ += emulated::exponential(foreign_);
    static constexpr std::array<std::string_view, 4> kTags{"83Z", "83F", "837", ""};
    const std::string_view tag = kTags[emulated::one_of(foreign_, kTags.size())];
    Utterance utterance{now, {tag.begin(), tag.end()}};
    const std::uint32_t size = emulated::one_of(foreign_, 2048);
    for (std::uint32_t i = 0; i < size; ++i) {
      utterance.bytes.push_back(static_cast<std::uint8_t>(emulated::one_of(foreign_, 256)));
    }
    said.push_back(std::move(utterance));
    note(FaultKind::kForeign, now);
  }
}

void DeltaTProgram::step(Time now, std::vector<Utterance>& said) {
  if (is_off()) {
    waiting_.clear();
    foreign_until_ = now;
    return;
  }
  std::move(waiting_.begin(), waiting_.end(), std::back_inserter(said));
  waiting_.clear();
  say_foreign(now, said);
}

void DeltaTProgram::receive(std::span<const std::uint8_t> bytes, Time /*at*/,
                            std::vector<Utterance>& /*said*/) {
  if (!is_off()) {
    static_cast<void>(emulated::obey(bytes, settings_));
  }
}

}  // namespace lodesman
