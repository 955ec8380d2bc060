// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/message_code.h"

#include <sodium.h>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

static_assert(sizeof(Digest) == crypto_auth_hmacsha256_BYTES);

// The library takes text as unsigned bytes.
[[nodiscard]] const unsigned char* bytes_of(std::string_view text) noexcept {
  return reinterpret_cast<const unsigned char*>(text.data());
}

[[nodiscard]] int value_of(char digit) noexcept {
  if (digit >= '0' && digit <= '9') {
    return digit - '0';
  }
  return digit >= 'a' && digit <= 'f' ? digit - 'a' + 10 : -1;
}

}  // namespace

void require_cryptography() {
  if (sodium_init() < 0) {
    throw StartupError("command_socket: libsodium cannot be used on this machine");
  }
}

Digest random_digest() noexcept {
  Digest digest;
  randombytes_buf(digest.data(), digest.size());
  return digest;
}

Digest message_code(std::string_view key, std::string_view text) noexcept {
  crypto_auth_hmacsha256_state state;
  Digest code{};
  crypto_auth_hmacsha256_init(&state, bytes_of(key), key.size());
  crypto_auth_hmacsha256_update(&state, bytes_of(text), text.size());
  crypto_auth_hmacsha256_final(&state, code.data());
  sodium_memzero(&state, sizeof state);
  return code;
}

Digest message_code(const Digest& key, std::string_view text) noexcept {
  return message_code({reinterpret_cast<const char*>(key.data()), key.size()}, text);
}

bool same_digest(const Digest& a, const Digest& b) noexcept {
  return sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::string to_hex(const Digest& digest) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  hex.reserve(kHexDigits);
  for (const std::uint8_t byte : digest) {
    hex += kDigits[byte >> 4U];
    hex += kDigits[byte & 15U];
  }
  return hex;
}

std::optional<Digest> digest_of(std::string_view hex) noexcept {
  Digest digest{};
  if (hex.size() != kHexDigits) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const int high = value_of(hex[2 * i]);
    const int low = value_of(hex[2 * i + 1]);
    if (high < 0 || low < 0) {
      return std::nullopt;
    }
    digest[i] = static_cast<std::uint8_t>(high * 16 + low);
  }
  return digest;
}

}  // namespace lodesman
