// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/recorder/direct_recording.h"

namespace lodesman::cli {

void DirectRecording::update(Time now) noexcept {
  now_ = now;
  tap_.poll(*this);
  series_.tick(now);
}

std::span<std::byte> DirectRecording::room_for(const Publication& publication) noexcept {
  room_.resize(publication.bytes);
  return room_;
}

void DirectRecording::take(const Publication& publication) noexcept {
  series_.add(publication, room_, now_);
}

void DirectRecording::note(const Gap& gap) noexcept { series_.add(gap, now_); }

}  // namespace lodesman::cli
