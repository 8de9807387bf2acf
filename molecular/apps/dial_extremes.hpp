// SPDX-License-Identifier: BSD-3-Clause
// Extremes: how verdicts change when coordinates are written to files, displaced, or compared in single precision.
#pragma once

#include "dial_choices.hpp"
#include "hinge_tools/dial_report.hpp"
#include "options.hpp"

namespace biocd {

/// Tries conformations of the job, for about 20 s at most.
hinge::tool::DialExtremes find_extremes(const Job& job, const hinge::molecular::Sampling& sampling);

}  // namespace biocd
