// SPDX-License-Identifier: BSD-3-Clause
// TreeJudge: what walks through trees have to ask about pairs.
#pragma once

namespace hinge {

/// For i of the one model and j of the other: decide(i, j, p, q) for a pair that floats could not rule out, placed;
/// threshold(i, j); admits(i, j); admits_links(a, b), which may refuse all pairs of two links.
template <class Decide, class Threshold, class Admits, class AdmitsPairs>
struct TreeJudge {
  Decide decide;
  Threshold threshold;
  Admits admits;
  AdmitsPairs admits_links;
};
template <class Decide, class Threshold, class Admits, class AdmitsPairs>
TreeJudge(Decide, Threshold, Admits, AdmitsPairs) -> TreeJudge<Decide, Threshold, Admits, AdmitsPairs>;

}  // namespace hinge
