// SPDX-License-Identifier: BSD-3-Clause
// The product needs no other library.
#include "extremes_peer.hpp"

namespace robocd {

const ExtremesPeer* extremes_peer() { return nullptr; }

}  // namespace robocd
