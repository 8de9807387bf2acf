// SPDX-License-Identifier: BSD-3-Clause
// Random conformations and Monte Carlo walks of a checker.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/free_sampler.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/torsion_prior.hpp"
#include "hinge/molecular/walker.hpp"
#include "run_aside.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

/// What a call of sample() asks for.
struct SampleArguments {
  std::uint64_t count = 0, first = 0;
  Sampling sampling;
  bool collision_free = false;
  std::uint64_t most_tries = 100;
  Prior prior = Prior::independent;  // of collision-free samples
};

Sampling as_sampling(std::uint64_t seed, std::optional<double> sigma) {
  if (sigma && !(*sigma > 0.0 && *sigma <= 1e9))
    throw py::value_error("sigma: " + py::repr(py::float_(*sigma)).cast<std::string>() +
                          ", expected a number above 0, at most 1e9 rad, or None");
  return {seed, sigma};
}

/// The rows of the samples that were found, in order of their indices, and counts of the starts.
struct Samples {
  double* q = nullptr;
  std::vector<std::uint8_t> found;
  std::atomic<std::uint64_t> unclosed{0}, refused{0};
};

/// Stores sample k, a ClosedSample or a FreeSample. refused: starts that ended at a collision.
template <class Drawn>
void keep(const Drawn& sample, std::uint64_t refused, std::size_t k, std::size_t dof, Samples& samples) {
  samples.unclosed += sample.unclosed;
  samples.refused += refused;
  samples.found[k] = sample.found() ? 1 : 0;
  if (sample.found()) std::copy(sample.q.begin(), sample.q.end(), samples.q + k * dof);
}

void draw_closed(CheckerHandle& self, const SampleArguments& given, unsigned threads, const py::object& progress,
                 Samples& samples) {
  const std::size_t dof = self.dof();
  const ClosedSampler first_sampler(*self.molecule, self.checker().selection(), given.sampling, given.most_tries,
                                    self.kept.closures, self.molecule.ranges);
  run_slices(static_cast<std::size_t>(given.count), threads, progress, [&]() -> Slice {
    const auto sampler = std::make_shared<ClosedSampler>(first_sampler);
    return [&, sampler](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) keep(sampler->sample(given.first + k), 0, k, dof, samples);
    };
  });
}

void draw_free(CheckerHandle& self, const SampleArguments& given, unsigned threads, const py::object& progress,
               Samples& samples) {
  const std::size_t dof = self.dof();
  const FreeSampling how{.sampling = given.sampling, .prior = given.prior, .most_starts = given.most_tries};
  const FreeSampler first_sampler(self.checker(), how, self.kept.closures, self.molecule.ranges);
  run_slices(static_cast<std::size_t>(given.count), threads, progress, [&]() -> Slice {
    const auto sampler = std::make_shared<FreeSampler>(first_sampler);
    return [&, sampler](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const FreeSample sample = sampler->sample(given.first + k, [] {
          poll();
          return false;
        });
        keep(sample, sample.dead_ends, k, dof, samples);
      }
    };
  });
}

void draw_open(CheckerHandle& self, const SampleArguments& given, unsigned threads, const py::object& progress,
               Samples& samples) {
  const std::size_t dof = self.dof();
  const DofSelection& selection = self.checker().selection();
  run_slices(static_cast<std::size_t>(given.count), threads, progress, [&]() -> Slice {
    return [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::vector<double> q =
            sample_configuration(given.sampling, given.first + k, *self.molecule, selection, self.molecule.ranges);
        std::copy(q.begin(), q.end(), samples.q + k * dof);
      }
    };
  });
}

py::tuple sample(CheckerHandle& self, std::uint64_t count, std::uint64_t seed, std::optional<double> sigma,
                 std::uint64_t first, bool collision_free, bool statistics, std::uint64_t most_tries,
                 const py::object& given_threads, const py::object& progress) {
  if (most_tries == 0) throw py::value_error("tries: 0, expected at least 1");
  const SampleArguments given{count,          first,      as_sampling(seed, sigma),
                              collision_free, most_tries, statistics ? Prior::ramachandran : Prior::independent};
  const unsigned threads = as_threads(given_threads, self.threads);
  const std::size_t dof = self.dof();
  if (dof > 0 && count > (std::uint64_t{1} << 40) / dof)
    throw py::value_error("n: " + std::to_string(count) + " conformations of " + std::to_string(dof) +
                          " values do not fit in memory; draw them in parts (first=)");
  const auto width = static_cast<py::ssize_t>(dof);
  Doubles q(Shape{static_cast<py::ssize_t>(count), width});  // NumPy does not touch the memory
  Samples samples;
  samples.q = q.mutable_data();
  samples.found.assign(static_cast<std::size_t>(count), 1);
  if (collision_free)
    draw_free(self, given, threads, progress, samples);
  else if (!self.kept.closures.empty())
    draw_closed(self, given, threads, progress, samples);
  else
    draw_open(self, given, threads, progress, samples);
  std::size_t rows = 0;
  for (std::size_t k = 0; k < samples.found.size(); ++k) {
    if (samples.found[k] == 0) continue;
    if (rows != k) std::copy_n(samples.q + k * dof, dof, samples.q + rows * dof);
    ++rows;
  }
  const py::object found = rows == count ? py::object(q) : q[py::slice(0, static_cast<py::ssize_t>(rows), 1)];
  return py::make_tuple(found, to_booleans(std::move(samples.found)), samples.unclosed.load(), samples.refused.load());
}

/// Indices of the closures that random starts do not close.
py::array_t<std::int64_t> unclosable(CheckerHandle& self, std::uint64_t seed, std::optional<double> sigma) {
  const Sampling sampling = as_sampling(seed, sigma);
  if (self.kept.closures.empty()) return to_array(std::vector<std::int64_t>());
  return to_array(
      run_aside([=, molecule = self.molecule, selection = self.checker().selection(), closures = self.kept.closures] {
        const auto open = find_unclosable(*molecule, selection, sampling, molecule.ranges, closures);
        return std::vector<std::int64_t>(open.begin(), open.end());
      }));
}

void check_start(const Structure& structure, Walker& walker) {
  const std::vector<Hit> hits = walker.collisions();
  if (hits.empty()) return;
  const auto name = [&](PrimitiveId i) { return label(structure, static_cast<std::uint32_t>(index(i))); };
  throw ModelError("walk: the start collides in " + std::to_string(hits.size()) + " pairs, first " +
                   name(hits.front().first) + " and " + name(hits.front().second) +
                   "; expected a start without collisions (exempt_reference=True exempts those of the file)");
}

py::tuple walk(CheckerHandle& self, std::uint64_t steps, double sigma, std::uint64_t count, std::uint64_t seed,
               std::uint64_t every, const py::object& start, const py::object& progress) {
  const std::size_t dof = self.dof();
  if (!(sigma > 0.0 && sigma <= 1e9)) throw py::value_error("step_size: expected an angle above 0, at most 1e9 rad");
  if (dof > 0 && (count < 1 || count > dof))  // Walker refuses a molecule without a free torsion
    throw py::value_error("changes: " + std::to_string(count) + ", expected 1 to " + std::to_string(dof) +
                          ", the number of free torsions");
  if (every < 1) throw py::value_error("every: 0, expected at least 1");
  WalkOptions options{
      .closures = self.kept.closures, .changes = static_cast<std::size_t>(count), .sigma = sigma, .seed = seed};
  if (!start.is_none()) {
    const Configurations given = as_configurations(start, "start", dof);
    if (!given.one) throw py::value_error("start: two dimensions, expected shape (" + std::to_string(dof) + ",)");
    options.start.assign(given[0].begin(), given[0].end());
  }
  Walker walker = run_aside([options, molecule = self.molecule, checker = self.checker()] {
    Walker made(checker, options);
    check_start(molecule.structure(), made);
    return made;
  });
  std::vector<double> configurations;                                        // a row per `every` steps
  run_slices(static_cast<std::size_t>(steps), 1, progress, [&]() -> Slice {  // one thread: slices come in order
    return [&](std::size_t begin, std::size_t end) {
      for (std::size_t step = begin; step < end; ++step) {
        walker.step();
        if ((step + 1) % every != 0) continue;
        const std::span<const double> q = walker.configuration();
        configurations.insert(configurations.end(), q.begin(), q.end());
      }
    };
  });
  const std::span<const double> end = walker.configuration();
  const auto rows = static_cast<py::ssize_t>(configurations.size() / dof);
  const WalkCounts counts = walker.counts();
  return py::make_tuple(to_array(std::move(configurations), {rows, static_cast<py::ssize_t>(dof)}),
                        to_array(std::vector<double>(end.begin(), end.end())), counts.accepted, counts.unclosed);
}

}  // namespace

void add_sampling(CheckerClass& checker) {
  checker
      .def("_sample", &sample, py::arg("n"), py::arg("seed"), py::arg("sigma"), py::arg("first"),
           py::arg("collision_free"), py::arg("statistics"), py::arg("tries"), py::arg("threads"), py::arg("progress"))
      .def("unclosable", &unclosable, py::arg("seed") = 1, py::arg("sigma") = py::none(),
           "unclosable(self, seed=1, sigma=None)\n--\n\n"
           "Return indices of closures that random starts do not close, for Checker(..., open_closures=).\n\n"
           "seed, sigma: as in sample(). Empty for most molecules.")
      .def("_walk", &walk, py::arg("steps"), py::arg("step_size"), py::arg("changes"), py::arg("seed"),
           py::arg("every"), py::arg("start"), py::arg("progress"));
}

}  // namespace hinge::python
