// SPDX-License-Identifier: BSD-3-Clause
// The library version. The build reads it from this file, so change it only here.
#pragma once

namespace hinge {

/// Increases with incompatible changes.
inline constexpr int version_major = 0;
/// Increases with new features.
inline constexpr int version_minor = 2;
/// Increases with corrections.
inline constexpr int version_patch = 0;
/// The three numbers as "major.minor.patch".
inline constexpr const char* version_string = "0.2.0";

}  // namespace hinge
