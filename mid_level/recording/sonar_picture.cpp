// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/sonar_picture.h"

#include <turbojpeg.h>

#include <algorithm>
#include <cmath>

namespace lodesman {
namespace {

constexpr int kQuality = 80;
constexpr unsigned char kOutside = 24;              // what no beam looks at, told from dark water
constexpr double kDot = 1.0 / SonarPicture::kRows;  // [-] half the height of a profile's point

}  // namespace

struct SonarPicture::Encoder {
  Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() {
    tjFree(bytes);
    if (handle != nullptr) {
      tjDestroy(handle);
    }
  }
  tjhandle handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
};

SonarPicture::SonarPicture()
    : grey_(std::size_t{kColumns} * kRows), encoder_{std::make_unique<Encoder>()} {
  places_.reserve(grey_.size());
  constexpr int kApex = kColumns / 2;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const float x = static_cast<float>(column - kApex) / kRows;
      const float y = static_cast<float>(kRows - 1 - row) / kRows;
      places_.push_back({std::hypot(x, y), std::atan2(x, y)});
    }
  }
}

SonarPicture::~SonarPicture() = default;

unsigned char SonarPicture::grey_of(const SonarPing& ping, const Polar& place) noexcept {
  const double beam = std::floor(ping.beam_at(static_cast<double>(place.bearing_rad)));
  const double range = static_cast<double>(place.range);
  if (beam < 0.0 || beam >= ping.beams || range >= 1.0) {
    return kOutside;
  }
  const auto index = static_cast<std::size_t>(beam);
  if (ping.kind == PingKind::kProfile) {
    const double point = ping.points[index].range_m / ping.range_m;
    return point > 0.0 && std::abs(point - range) <= kDot ? 255 : 0;
  }
  const auto bin = static_cast<std::size_t>(range * ping.bins);
  return ping.echo[index * ping.bins + std::min<std::size_t>(bin, ping.bins - 1)];
}

std::vector<unsigned char> SonarPicture::jpeg_of(const SonarPing& ping) {
  std::transform(places_.begin(), places_.end(), grey_.begin(),
                 [&](const Polar& place) { return grey_of(ping, place); });
  if (encoder_->handle == nullptr ||
      tjCompress2(encoder_->handle, grey_.data(), kColumns, 0, kRows, TJPF_GRAY, &encoder_->bytes,
                  &encoder_->size, TJSAMP_GRAY, kQuality, 0) != 0) {
    return {};
  }
  return {encoder_->bytes, encoder_->bytes + encoder_->size};
}

}  // namespace lodesman
