// SPDX-License-Identifier: BSD-3-Clause
// The version, read by the build too: change it here only.
#pragma once

namespace hinge {

inline constexpr int version_major = 0;
inline constexpr int version_minor = 1;
inline constexpr int version_patch = 0;
inline constexpr const char* version_string = "0.1.0";

}  // namespace hinge
