// SPDX-License-Identifier: Apache-2.0
// HMAC-SHA256 (RFC 2104, FIPS 198-1) by libsodium, and what goes with it: 256 bits as a value, as
// hexadecimal digits, by chance. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lodesman {

// A code, a key or a nonce.
using Digest = std::array<std::uint8_t, 32>;

// Throws StartupError where the library finds no source of chance.
void require_cryptography();

[[nodiscard]] Digest random_digest() noexcept;

[[nodiscard]] Digest message_code(std::string_view key, std::string_view text) noexcept;
[[nodiscard]] Digest message_code(const Digest& key, std::string_view text) noexcept;

// In the same time for any two.
[[nodiscard]] bool same_digest(const Digest& a, const Digest& b) noexcept;

// 64 digits, 0-9 and a-f.
inline constexpr std::size_t kHexDigits = 64;
[[nodiscard]] std::string to_hex(const Digest& digest);
// Nothing where it is not exactly that.
[[nodiscard]] std::optional<Digest> digest_of(std::string_view hex) noexcept;

}  // namespace lodesman
