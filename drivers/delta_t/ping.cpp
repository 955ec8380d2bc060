// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/ping.h"

#include <algorithm>

namespace lodesman::delta_t {
namespace {

void fill_image(const Record& record, bool reversed, SonarPing& out) noexcept {
  const Header& header = record.header;
  out.kind = PingKind::kImage;
  out.bins = header.samples;
  out.echo_count = header.beams * header.samples;
  out.point_count = 0;
  for (std::uint32_t beam = 0; beam < header.beams; ++beam) {
    const std::uint32_t from = reversed ? header.beams - 1 - beam : beam;
    const Bytes samples = record.body.subspan(std::size_t{from} * header.samples, header.samples);
    std::copy(samples.begin(), samples.end(),
              out.echo.begin() + static_cast<std::ptrdiff_t>(std::size_t{beam} * header.samples));
  }
}

void fill_profile(const Record& record, bool reversed, SonarPing& out) noexcept {
  const Header& header = record.header;
  out.kind = PingKind::kProfile;
  out.bins = 0;
  out.echo_count = 0;
  out.point_count = header.beams;
  for (std::uint32_t beam = 0; beam < header.beams; ++beam) {
    const std::uint32_t from = reversed ? header.beams - 1 - beam : beam;
    out.points[beam] = {record.range_m(from), record.intensity(from)};
  }
}

}  // namespace

void fill_ping(const Record& record, BeamSign sign, SonarPing& out) noexcept {
  const Header& header = record.header;
  const bool reversed = sign == BeamSign::kPort;
  const double last_rad = header.first_bearing_rad + (header.beams - 1.0) * header.beam_step_rad;
  out.range_m = header.range_m * header.stretch();
  out.beams = header.beams;
  out.set_bearings(reversed ? -last_rad : header.first_bearing_rad, header.beam_step_rad);
  if (header.kind == RecordKind::kImage) {
    fill_image(record, reversed, out);
  } else {
    fill_profile(record, reversed, out);
  }
}

std::optional<std::uint64_t> PingOrder::take(std::uint32_t number) noexcept {
  if (!newest_) {
    newest_ = number;
    return given_ = 1;
  }
  if (number == *newest_) {
    ++counts_.repeated;
    return std::nullopt;
  }
  std::uint32_t ahead = number - *newest_;  // by arithmetic of 32 bits: the numbering may wrap
  if (ahead > UINT32_MAX / 2) {
    const bool is_little = *newest_ - number <= kMostLate;
    const bool follows = behind_ && number - *behind_ - 1 < kMostLate;
    behind_ = number;
    if (is_little && !follows) {
      ++counts_.late;
      return std::nullopt;
    }
    ++counts_.restarts;
    ahead = 1;
  }
  behind_.reset();
  newest_ = number;
  counts_.lost += ahead - 1;
  return given_ += ahead;
}

}  // namespace lodesman::delta_t
