// SPDX-License-Identifier: BSD-3-Clause
// Texts of `robocd --help`: topics and examples.
#pragma once

#include "hinge_tools/help_texts.hpp"

namespace robocd {

/// Returns the texts of the tool and its commands.
hinge::tool::HelpTexts help_texts();

}  // namespace robocd
