// SPDX-License-Identifier: BSD-3-Clause
// Texts of `biocd --help`: topics and examples.
#pragma once

#include "hinge_tools/help_texts.hpp"

namespace biocd {

/// Returns the texts of the tool and its commands.
hinge::tool::HelpTexts help_texts();

}  // namespace biocd
