// SPDX-License-Identifier: BSD-3-Clause
// Many conformations at once: one checker per worker, results by index.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "hinge/molecular/checker.hpp"

namespace biocd {

/// Calls work(checker, k) once for every k below count, each worker with a checker of its own. Whatever a worker throws
/// is thrown again here. Results that go to places of their own do not depend on the number of workers.
void check_parallel(std::vector<hinge::molecular::Checker>& workers, std::size_t count,
                    const std::function<void(hinge::molecular::Checker&, std::size_t)>& work);

}  // namespace biocd
