// SPDX-License-Identifier: BSD-3-Clause
// Counts verdicts, clashes and closure residuals.
#include "summary.hpp"

#include <utility>

#include "hinge/core/id.hpp"

namespace biocd {

namespace {

constexpr std::size_t most_offenders = 10;

}  // namespace

Summary::Summary(std::vector<std::string> closures, bool closed, bool with_offenders)
    : closures_(std::move(closures)), with_offenders_(with_offenders) {
  if (closed) starts_.emplace();
}

void Summary::add(const hinge::molecular::Structure& structure, const hinge::molecular::Verdict& verdict) {
  ++checked_;
  colliding_ += verdict.collides ? 1 : 0;
  worst_residual_ = std::max(worst_residual_, verdict.closure_residual);
  worst_residuals_.resize(verdict.closure_residuals.size());
  for (std::size_t k = 0; k < worst_residuals_.size(); ++k)
    worst_residuals_[k] = std::max(worst_residuals_[k], verdict.closure_residuals[k]);
  if (!with_offenders_) return;
  offenders_.set_labels([&structure](std::uint32_t atom) { return label(structure, atom); });
  for (const hinge::molecular::Contact& pair : verdict.pairs)
    if (pair.collides)
      offenders_.add(static_cast<std::uint32_t>(hinge::index(pair.hit.first)),
                     static_cast<std::uint32_t>(hinge::index(pair.hit.second)));
}

void Summary::add_clashscore(double clashscore) {
  ++scored_;
  clashscores_ += clashscore;
  worst_clashscore_ = std::max(worst_clashscore_, clashscore);
}

void Summary::add(const Json& row) {
  ++checked_;
  colliding_ += row.at("collides").get<bool>() ? 1 : 0;
  if (row.contains("clashscore")) add_clashscore(row.at("clashscore").get<double>());
  const auto pairs = row.find("pairs");
  if (pairs == row.end() || row.contains("other_atoms")) return;
  for (const Json& pair : *pairs)
    if (pair.at("collides").get<bool>()) offenders_.add(pair);
}

void Summary::add(const Starts& starts) {
  if (!starts_) starts_.emplace();
  starts_->missing += starts.missing;
  starts_->unclosed += starts.unclosed;
  starts_->refused += starts.refused;
}

void Summary::add_closures(const Json& summary) {
  worst_residual_ = std::max(worst_residual_, summary.value("worst_closure_residual", 0.0));
  const Json closures = summary.value("closures", Json::array());
  for (std::size_t k = 0; k < closures.size(); ++k) {
    if (k == worst_residuals_.size()) {
      closures_.push_back(closures[k].at("bond").get<std::string>());
      worst_residuals_.push_back(0.0);
    }
    worst_residuals_[k] = std::max(worst_residuals_[k], closures[k].at("residual").get<double>());
  }
  if (summary.contains("missing"))
    add(Starts{summary.at("missing").get<std::uint64_t>(), summary.at("starts_unclosed").get<std::uint64_t>(),
               summary.at("closed_refused").get<std::uint64_t>()});
}

std::vector<PairCount> Summary::top() const { return offenders_.top(most_offenders); }

Json Summary::json(bool with_closures) const {
  Json summary{{"checked", checked_}, {"colliding", colliding_}};
  if (scored_ > 0) {
    summary["clashscore"] = clashscores_ / static_cast<double>(scored_);
    summary["worst_clashscore"] = worst_clashscore_;
  }
  if (with_closures) {
    summary["worst_closure_residual"] = worst_residual_;
    Json& closures = summary["closures"] = Json::array();
    for (std::size_t k = 0; k < worst_residuals_.size(); ++k)
      closures.push_back({{"bond", closures_[k]}, {"residual", worst_residuals_[k]}});
  }
  summary["offenders"] = offenders_.json(most_offenders);
  if (count_error() > 0) summary["offenders_count_error"] = count_error();
  if (starts_) {
    summary["missing"] = starts_->missing;
    summary["starts_unclosed"] = starts_->unclosed;
    summary["closed_refused"] = starts_->refused;
  }
  return summary;
}

Exit exit_of(const Summary& summary) {
  if (summary.colliding() > 0) return Exit::collision;
  return summary.starts() && summary.starts()->missing > 0 ? Exit::shortfall : Exit::free;
}

}  // namespace biocd
