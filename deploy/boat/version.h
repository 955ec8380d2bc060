// SPDX-License-Identifier: Apache-2.0
// The version that programs and results name. Any thread.
#pragma once

namespace lodesman {
inline constexpr const char* kVersion = LODESMAN_VERSION;
}  // namespace lodesman
