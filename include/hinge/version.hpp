// SPDX-License-Identifier: BSD-3-Clause
// The library version. The build reads it from this file, so change it only here.
#pragma once

namespace hinge {

inline constexpr int version_major = 0;
inline constexpr int version_minor = 1;
inline constexpr int version_patch = 0;
inline constexpr const char* version_string = "0.1.0";

}  // namespace hinge
