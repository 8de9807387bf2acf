// SPDX-License-Identifier: BSD-3-Clause
// Five robots: Hinge against FCL, in Debian's build and compiled for this machine. Self-collision, all pairs of
// links, minimum distance, a scene of 1.26 million triangles, and building; poses given, warm and cold caches,
// answers compared.
#include "results.hpp"
#include "robots/run_robots.hpp"

int main(int argc, char** argv) {
  using namespace hinge::bench;
  const Arguments arguments = Arguments::parse(argc, argv, 5, "SECONDS for each query of each robot");
  Results results("robots");
  RobotRatios ratios;
  const int differences = run_robots({200, arguments.number, true, 50}, ratios, results);
  for (const char* peer : {"fcl-best", "fcl-native-best", "fcl-unshared"}) ratios.print(peer, results);
  results.print_missed();
  results.write(arguments.json);
  return differences == 0 ? 0 : 1;
}
