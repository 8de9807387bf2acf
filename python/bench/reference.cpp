// SPDX-License-Identifier: BSD-3-Clause
// Times in C++ what python_bench.py times in Python: python_bench_reference PROTEIN CONFIGURATIONS REPEATS.
// CONFIGURATIONS: float64 in rows of one value per degree of freedom. Prints two medians in seconds, of all
// configurations and of one, and the number of those that collide.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/selection.hpp"

namespace {

using namespace hinge::molecular;

template <class Call>
double median_seconds(int repeats, const Call& call) {
  std::vector<double> times;
  for (int k = 0; k < repeats; ++k) {
    const auto start = std::chrono::steady_clock::now();
    call();
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[static_cast<std::size_t>(repeats / 2)];
}

std::vector<double> read_numbers(const char* path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::copy_n(bytes.data(), numbers.size() * sizeof(double), reinterpret_cast<char*>(numbers.data()));
  return numbers;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::fputs("expected PROTEIN CONFIGURATIONS REPEATS\n", stderr);
    return 2;
  }
  const auto molecule = std::make_shared<const Molecule>(read_structure(arguments[1]), MoleculeOptions{});
  Checker checker(molecule, molecule->select(select_torsions(*molecule, "all", false)), CheckOptions{});
  const std::vector<double> all = read_numbers(arguments[2]);
  const std::span<const double> one = std::span(all).first(checker.dof_count());
  const int repeats = std::atoi(arguments[3]);
  std::vector<std::uint8_t> verdicts;
  const double batch = median_seconds(repeats, [&] { verdicts = checker.check_batch(all); });
  constexpr int calls = 1000;
  const double single = median_seconds(repeats, [&] {
    for (int k = 0; k < calls; ++k) checker.check_batch(one);
  });
  std::printf("%.9g %.9g %td\n", batch, single / calls, std::count(verdicts.begin(), verdicts.end(), 1));
}
