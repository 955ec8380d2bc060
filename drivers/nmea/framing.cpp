// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/framing.h"

#include <algorithm>

namespace lodesman {
namespace {

constexpr std::size_t kSum = 3;  // with its '*'

// [0, 15]; more where it is no digit.
[[nodiscard]] unsigned digit_of(char letter) noexcept {
  return letter >= '0' && letter <= '9'   ? static_cast<unsigned>(letter - '0')
         : letter >= 'A' && letter <= 'F' ? static_cast<unsigned>(letter - 'A') + 10U
         : letter >= 'a' && letter <= 'f' ? static_cast<unsigned>(letter - 'a') + 10U
                                          : 16U;
}

[[nodiscard]] bool begins(std::uint8_t byte) noexcept { return byte == '$' || byte == '!'; }
[[nodiscard]] bool ends(std::uint8_t byte) noexcept { return byte == '\r' || byte == '\n'; }

}  // namespace

std::uint8_t nmea_checksum(std::string_view text) noexcept {
  unsigned sum = 0;
  for (const char letter : text) {
    sum ^= static_cast<unsigned char>(letter);
  }
  return static_cast<std::uint8_t>(sum);
}

void NmeaFraming::restart() noexcept {
  counts_.skipped_bytes += size_;
  size_ = 0;
}

void NmeaFraming::drop(std::uint64_t& count) noexcept {
  ++count;
  counts_.skipped_bytes += size_;
  size_ = 0;
}

std::optional<std::string_view> NmeaFraming::push(std::uint8_t byte) noexcept {
  if (size_ == 0) {
    begin(byte);
  } else if (ends(byte)) {
    return end();
  } else if (begins(byte) || byte < ' ' || byte > '~') {
    drop(counts_.broken);
    begin(byte);
  } else if (size_ == kLongest) {
    drop(counts_.too_long);
    begin(byte);
  } else {
    bytes_[size_++] = static_cast<char>(byte);
  }
  return std::nullopt;
}

void NmeaFraming::begin(std::uint8_t byte) noexcept {
  if (begins(byte)) {
    bytes_[size_++] = static_cast<char>(byte);
  } else {
    // The end of a line has two bytes.
    counts_.skipped_bytes += ends(byte) ? 0U : 1U;
  }
}

std::optional<std::string_view> NmeaFraming::end() noexcept {
  const std::string_view line{bytes_.data(), size_};
  const std::string_view sentence = line.substr(0, line.size() - std::min(line.size(), kSum));
  const std::string_view sum = line.substr(sentence.size());
  if (sentence.empty() || sum[0] != '*' || digit_of(sum[1]) > 15 || digit_of(sum[2]) > 15) {
    drop(counts_.without_checksum);
    return std::nullopt;
  }
  if (nmea_checksum(sentence.substr(1)) != (digit_of(sum[1]) << 4U | digit_of(sum[2]))) {
    drop(counts_.wrong_checksums);
    return std::nullopt;
  }
  ++counts_.sentences;
  size_ = 0;
  return sentence;
}

}  // namespace lodesman
