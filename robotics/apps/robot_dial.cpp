// SPDX-License-Identifier: BSD-3-Clause
// Implements RobotDial.
#include "robot_dial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "configurations.hpp"
#include "dial_extremes.hpp"
#include "hinge/core/error.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/measure.hpp"
#include "hinge_tools/settings_file.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::counted;
using hinge::tool::DialEffort;
using hinge::tool::DialReport;
using hinge::tool::DialResult;
using hinge::tool::DialRow;
using hinge::tool::DialSection;
using hinge::tool::options_text;
using hinge::tool::shell_quoted;
using hinge::tool::Sound;

namespace {

constexpr double smallest_gain = 1.03;  // a choice must win this much to be recommended
// Shares of --time. The rest is for find_mixture() and for fitting tiers.
constexpr double configurations_share = 0.5, motions_share = 0.15, check_share = 0.25;
constexpr double most_brute_pairs = 1e7;     // of triangles; more take longer than a tenth of a second
constexpr std::size_t most_candidates = 3;   // for the recommendation, tried in turn
constexpr std::size_t mixture_count = 2000;  // configurations that find_mixture() looks at
constexpr const char* reference_name = "shapes of the URDF";

double pairs_of_triangles(const Job& job) {
  double pairs = 0.0;
  for (const auto& [a, b] : job.tested.list())
    pairs += static_cast<double>(job.robot->triangle_count(a)) * static_cast<double>(job.robot->triangle_count(b));
  return pairs;
}

std::string mixture_name(const LinkShapes& shapes, const std::vector<Tier>& tiers, Tier cheap) {
  constexpr std::size_t longest = 20;  // of the names of links in the first column
  std::string meshes;
  std::size_t others = 0;
  for (std::size_t l = 0; l < tiers.size(); ++l) {
    if (tiers[l] != Tier::mesh) continue;
    if (meshes.size() > longest)
      ++others;
    else
      meshes += (meshes.empty() ? "" : ", ") + shapes.name(l);
  }
  return fmt::format("{}, but meshes for {}{}", name(cheap), meshes,
                     others > 0 ? fmt::format(" and {} more", others) : "");
}

}  // namespace

RobotDial::RobotDial(const Options& options, Job& job)
    : options_(options), job_(job), worker_(make_worker(options, job)), shapes_(*job.robot) {
  report_.seed = options.seed;
  report_.seconds = options.dial.seconds;
  report_.limits = options.dial.limits();
}

DialReport RobotDial::run() {
  scene_ = study_scene(options_, job_);
  report_.requirements = scene_.requirements;
  section_notes_ = shapes_.notes();
  questions_ = questions(options_.seed);
  if (!options_.csv_in.empty() && questions_->count() < 2)
    throw hinge::ModelError("--csv-in " + options_.csv_in + ": holds one configuration, expected two or more");
  leave_out_proofs_outside_limits();
  section_.title = "Configurations";
  section_.unit = {"configuration", "configurations"};
  section_.length_unit = "m";
  section_.population = options_.csv_in.empty() ? fmt::format("uniform within the joint limits, seed {}", options_.seed)
                                                : "the first half of " + options_.csv_in;
  add("shapes", reference_name, {shapes_.all(Tier::mesh), false, 1});
  add_engines();
  add_tiers();
  add_fewer_pairs_and_threads();
  report_.sections.push_back(measure(std::move(section_), effort(configurations_share)));
  for (std::string& note : section_notes_) report_.sections.back().notes.push_back(std::move(note));
  note_sufficient_tiers();
  if (!job_.robot->independent_joints().empty()) {
    const DialEffort motions{options_.dial.seconds * motions_share, options_.dial.count};
    report_.sections.push_back(measure(path_section(options_, worker_), motions));
  }
  recommend();
  if (options_.dial.extremes) report_.extremes = find_extremes(options_, job_);
  return std::move(report_);
}

void RobotDial::leave_out_proofs_outside_limits() {
  if (options_.csv_in.empty()) return;
  const std::vector<std::string> outside = notes_on_limits(questions_->all(), options_, *job_.robot);
  if (outside.empty() || scene_.apart.empty()) return;
  section_notes_.push_back("pairs proved apart: left out, because the proofs hold within the limits only: " +
                           outside[0]);
  scene_.apart.clear();
}

DialEffort RobotDial::effort(double share) const {
  DialEffort effort{options_.dial.seconds * share, options_.dial.count};
  if (!options_.csv_in.empty()) effort.most = (questions_->count() + 1) / 2;  // the other half is for the check
  return effort;
}

Sound RobotDial::sound_of(const Selected& selected) const {
  return is_exact(selected) ? Sound::exact : Sound::no_false_accept;
}

std::shared_ptr<Questions> RobotDial::questions(std::uint64_t drawn_from) const {
  Options drawn = options_;
  drawn.seed = drawn_from;
  drawn.count = drawn.csv_in.empty() ? UINT64_MAX : 0;
  return std::make_shared<Questions>(find_configurations(drawn, job_));
}

Worker RobotDial::worker_of(const Selected& selected) const {
  Job job = job_;
  if (selected.leaves_out) job.tested = scene_.tested;
  return make_worker(options_, job, shapes_.robot(selected.tiers));
}

bool RobotDial::is_exact(const Selected& selected) const {
  return std::ranges::all_of(selected.tiers, [](Tier tier) { return tier == Tier::mesh; });
}

std::vector<std::string> RobotDial::lines_of(const Selected& selected) const {
  std::vector<std::string> lines;
  for (const std::string& word : shapes_.words(selected.tiers)) lines.push_back("--tier " + shell_quoted(word));
  if (selected.leaves_out)
    for (const auto& [a, b] : scene_.apart)
      lines.push_back("--proved-apart " + shell_quoted(a) + " " + shell_quoted(b));
  if (selected.threads > 1) lines.push_back(fmt::format("--threads {}", selected.threads));
  return lines;
}

std::string RobotDial::sentence(const Selected& selected, const DialRow& row) const {
  std::string what;
  const auto append = [&](const std::string& part) { what += (what.empty() ? "" : "; ") + part; };
  if (!is_exact(selected)) {
    std::string words;
    for (const std::string& word : shapes_.words(selected.tiers)) words += (words.empty() ? "" : ", ") + word;
    append("tiers " + words);
  }
  if (selected.leaves_out) append("without " + counted(scene_.apart.size(), "pair") + " proved apart");
  if (selected.threads > 1) append(fmt::format("{} threads", selected.threads));
  what += fmt::format(": {:.2f} times faster, ", row.speed.value);
  what += is_exact(selected) ? "exact"
                             : fmt::format("no contact of surfaces is missed, {} false rejects",
                                           hinge::tool::rate_text(row.reject_rate()));
  return what + "; no other measured choice is faster with " + hinge::tool::limits_text(report_.limits);
}

void RobotDial::add(const char* kind, std::string name, const Selected& selected) {
  selected_.emplace(name, selected);
  section_.choices.push_back(make_choice(kind, std::move(name), options_text(lines_of(selected)), sound_of(selected),
                                         worker_of(selected), questions_, selected.threads));
}

void RobotDial::add_engines() {
  for (const char* engine : {"lazy", "brute"}) {
    const double pairs = pairs_of_triangles(job_);
    if (engine == std::string("brute") && pairs > most_brute_pairs) {
      section_notes_.push_back(
          fmt::format("engine brute: left out, it tests {:.2g} pairs of triangles for each answer", pairs));
      continue;
    }
    section_.choices.push_back(make_choice("engine", fmt::format("engine {}", engine),
                                           fmt::format("--engine {}", engine), Sound::exact,
                                           make_worker(options_, job_, job_.robot, engine), questions_));
    section_.choices.back().distance = {};
  }
}

void RobotDial::add_tiers() {
  for (const Tier tier : shapes_.fitted())
    add("shapes", fmt::format("{} for all links", name(tier)), {shapes_.all(tier), false, 1});
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(mixture_count, effort(1.0).most));
  const std::vector<std::uint64_t> free = free_questions(worker_, *questions_, count);
  for (const Tier tier : shapes_.fitted()) {
    const std::vector<Tier> mixed =
        find_mixture(options_, job_, shapes_, tier, *questions_, free, report_.limits.false_rejects / 2.0);
    if (!mixed.empty() && std::ranges::count(mixed, Tier::mesh) > 0)
      add("mixed shapes", mixture_name(shapes_, mixed, tier), {mixed, false, 1});
  }
  for (const Tier tier : shapes_.fitted())
    if (tier != Tier::spheres)
      section_.choices.push_back(
          make_cascade(fmt::format("{}, and where it collides the {}", name(tier), reference_name),
                       worker_of({shapes_.all(tier), false, 1}), make_worker(options_, job_), questions_));
}

void RobotDial::add_fewer_pairs_and_threads() {
  if (!scene_.apart.empty())
    add("pairs", fmt::format("without {} proved apart", counted(scene_.apart.size(), "pair")),
        {shapes_.all(Tier::mesh), true, 1});
  for (unsigned threads = 2; threads <= std::thread::hardware_concurrency(); threads *= 2)
    add("threads", fmt::format("{} threads", threads), {shapes_.all(Tier::mesh), false, threads});
}

void RobotDial::note_sufficient_tiers() {
  const DialResult& result = report_.sections.front();
  for (const DialRow& row : result.rows)
    if (row.kind == "shapes" && row.sound == Sound::no_false_accept && row.false_rejects == 0 && row.free > 0)
      report_.requirements.push_back({fmt::format("{}: the same answers as the shapes of the URDF in all {} measured",
                                                  row.name, counted(row.count, "configuration")),
                                      row.options,
                                      {}});
}

void RobotDial::recommend() {
  // The choices that win, the best of each kind.
  Selected best{shapes_.all(Tier::mesh), false, 1};
  std::vector<std::pair<const DialRow*, Selected>> shapes;
  double fastest_threads = 0.0;
  for (const DialRow& row : report_.sections.front().rows) {
    const auto found = selected_.find(row.name);
    if (found == selected_.end() || row.speed.low < smallest_gain || !keeps(row, report_.limits)) continue;
    if (row.kind.ends_with("shapes")) shapes.emplace_back(&row, found->second);
    if (row.kind == "pairs") best.leaves_out = true;
    if (row.kind == "threads" && row.speed.value > fastest_threads) {
      fastest_threads = row.speed.value;
      best.threads = found->second.threads;
    }
  }
  std::ranges::sort(shapes, [](const auto& a, const auto& b) { return a.first->speed.value > b.first->speed.value; });
  std::vector<Selected> candidates;
  for (const auto& [row, selected] : shapes) candidates.push_back({selected.tiers, best.leaves_out, best.threads});
  if (best.leaves_out || best.threads > 1) candidates.push_back(best);
  if (best.leaves_out && best.threads > 1) candidates.push_back({best.tiers, false, best.threads});
  if (candidates.size() > most_candidates) candidates.resize(most_candidates);
  for (const Selected& candidate : candidates)
    if (try_advice(candidate, check_share / static_cast<double>(candidates.size()))) return;
  report_.advice.text =
      fmt::format("keep the shapes of the URDF, engine simd and one thread: no other measured choice is faster with {}",
                  hinge::tool::limits_text(report_.limits));
}

bool RobotDial::try_advice(const Selected& selected, double share) {
  const bool from_file = !options_.csv_in.empty();
  const auto fresh = from_file ? questions_ : questions(options_.seed + 1);
  DialEffort checked = effort(share);
  if (from_file) {
    checked.first = checked.most;
    checked.most = fresh->count() - checked.first;
  }
  const std::vector<std::string> lines = lines_of(selected);
  const auto row = confirm(make_choice("shapes", reference_name, "", Sound::exact, make_worker(options_, job_), fresh),
                           make_choice("recommended", "recommended", options_text(lines), sound_of(selected),
                                       worker_of(selected), fresh, selected.threads),
                           checked, report_.limits);
  if (!row) return false;
  report_.advice = {sentence(selected, *row), options_text(lines), row,
                    from_file ? "the second half of " + options_.csv_in : fmt::format("seed {}", options_.seed + 1)};
  settings_ = lines;
  if (selected.leaves_out) settings_.insert(settings_.begin(), scene_.made_for);
  return true;
}

}  // namespace robocd
