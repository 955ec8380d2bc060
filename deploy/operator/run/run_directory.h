// SPDX-License-Identifier: Apache-2.0
// The directory that a run is written to, made for this run alone. One thread, at start-up;
// StartupError says why there is none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lodesman::cli {

// Whether a run lies there: any file or folder that a run would write.
[[nodiscard]] bool holds_a_run(const std::filesystem::path& directory);

// A new directory of that name, or the next free one: name-2, name-3, ...
[[nodiscard]] std::filesystem::path make_new_directory(const std::filesystem::path& name);

// How the directory of a run of that time is named: 20261127T183000Z-NAME; no-clock-NAME where the
// time cannot be, as that of a machine without a battery for its clock: all its runs would be of
// one day in the past.
[[nodiscard]] std::string run_name(std::int64_t utc_ns, const std::string& scenario);

[[nodiscard]] bool has_no_clock(const std::filesystem::path& directory);

// Gives a run that was named without a clock the name of the time that was learnt meanwhile, or the
// next free one. The old name where that cannot be.
[[nodiscard]] std::filesystem::path rename_by_clock(const std::filesystem::path& directory,
                                                    std::int64_t utc_ns,
                                                    const std::string& scenario);

// The directory that a user names, made where there is none. One that holds a run is refused, or
// with `force` cleared of what runs write, and of nothing else.
[[nodiscard]] std::filesystem::path make_named_directory(const std::filesystem::path& name,
                                                         bool force);

}  // namespace lodesman::cli
