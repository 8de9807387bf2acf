// SPDX-License-Identifier: BSD-3-Clause
// Writes lists of pairs as JSON text.
#include "pair_text.hpp"

#include <cstdint>

#include "hinge/core/id.hpp"
#include "hinge/molecular/severity.hpp"

namespace biocd {

PairText::PairText(const Job& job)
    : job_(job),
      has_classes_(has_classes(job.checker.thresholds().rules->name)),
      has_relative_distance_(has_relative_distance(job.checker.thresholds().rules->name)) {
  const hinge::molecular::Structure& structure = job.molecule->structure();
  for (std::uint32_t atom = 0; atom < structure.atoms.size(); ++atom)
    labels_.push_back(hinge::tool::json_string(label(structure, atom)));
}

std::string PairText::list(std::span<const hinge::molecular::Contact> pairs) const {
  constexpr std::size_t usual_length = 160;  // of a pair
  hinge::tool::JsonWriter text(pairs.size() * usual_length);
  text.put("[");
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (k > 0) text.put(",");
    append(text, pairs[k]);
  }
  text.put("]");
  return text.take();
}

void PairText::append(hinge::tool::JsonWriter& text, const hinge::molecular::Contact& pair) const {
  const hinge::Hit& hit = pair.hit;
  const hinge::molecular::Severity severity = severity_of(job_.checker.thresholds(), hit, pair.collides);
  const std::size_t i = hinge::index(hit.first), j = hinge::index(hit.second);
  text.put("{\"i\":");
  text.number(i);
  text.put(",\"j\":");
  text.number(j);
  text.put(",\"label_i\":");
  text.put(labels_[i]);
  text.put(",\"label_j\":");
  text.put(labels_[j]);
  text.put(",\"distance\":");
  text.number(hit.distance);
  text.put(",\"threshold\":");
  text.repeated_number(hit.threshold);
  if (pair.collides)
    text.put(",\"collides\":true,\"overlap\":");
  else
    text.put(",\"collides\":false,\"overlap\":");
  text.number(severity.overlap);
  if (has_classes_) {
    text.put(",\"class\":\"");
    text.put(severity.kind);
    text.put("\"");
  }
  if (has_relative_distance_) {
    text.put(",\"relative_distance\":");
    if (severity.relative_distance)
      text.number(*severity.relative_distance);
    else
      text.put("null");
  }
  text.put("}");
}

}  // namespace biocd
