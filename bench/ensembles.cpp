// SPDX-License-Identifier: BSD-3-Clause
// Ensembles in files: time, frames per second and peak memory to read, check and filter them, compared with reading
// their bytes. Each measurement runs in its own process, which also reads the molecule. Arguments: number of
// conformations (1000), residues (994), folder (the system's temporary one). The files are removed at the end.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <ios>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "hinge/batch/ensemble.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "hinge_tools/clock.hpp"
#include "molecular/trajectory_files.hpp"

namespace {

using namespace hinge;
using namespace hinge::molecular;
using tool::Clock;
using tool::seconds_since;

constexpr std::uint64_t seed = 1;
constexpr double sigma = 0.0005;  // rad; most conformations are free at this value

/// Side chains of ideal proteins clash in some places. These pairs are exempt, so that conformations can be free.
CheckOptions rules() {
  CheckOptions options;
  options.exempt_reference = true;
  return options;
}

/// Random sequences of eighteen amino acids; helices of fourteen residues alternate with strands of six.
std::shared_ptr<const Molecule> protein(std::size_t residues) {
  constexpr std::string_view letters = "ADEFGHIKLMNQRSTVWY";
  SampleStream stream(seed, 0);
  std::string sequence, secondary;
  for (std::size_t r = 0; r < residues; ++r) {
    sequence += letters[static_cast<std::size_t>(stream.uniform() * static_cast<double>(letters.size()))];
    secondary += r % 20 < 14 ? 'H' : 'E';
  }
  return std::make_shared<const Molecule>(build_ideal_protein(sequence, secondary));
}

struct Files {
  std::filesystem::path folder;
  std::filesystem::path of(const std::string& extension) const { return folder / ("ensemble." + extension); }
};

void generate(const Files& files, std::size_t residues, std::size_t count) {
  const auto molecule = protein(residues);
  Checker checker(molecule, molecule->select(select_torsions(*molecule, "all", false)), rules());
  const Structure& s = molecule->structure();
  std::ofstream npy(files.of("npy"), std::ios::binary), dcd(files.of("dcd"), std::ios::binary),
      xtc(files.of("xtc"), std::ios::binary);
  TrajectoryWriter to_npy(npy, TrajectoryFormat::npy, s, s.atoms.size(), true),
      to_dcd(dcd, TrajectoryFormat::dcd, s, s.atoms.size());
  test::XtcPacker packer;
  for (std::uint64_t k = 0; k < count; ++k) {
    checker.check(sample_configuration({seed, sigma}, k, checker.dof_count()), {Mode::Kind::any, 0.0});
    const std::vector<Vec3> positions = checker.positions();
    to_npy.add(positions, 0);
    to_dcd.add(positions, 0);
    xtc << packer.frame(positions);
  }
  to_npy.finish();
  to_dcd.finish();
  if (!npy.flush() || !dcd.flush() || !xtc.flush()) throw std::runtime_error("the ensemble could not be written");
}

/// The result that a child process sends to its parent.
struct Told {
  double seconds = 0.0;
  std::uint64_t free = 0;
};

struct Measured {
  Told told;
  double peak_megabytes = 0.0;
};

/// Runs work(), which returns Told, in a child process.
template <class Work>
Measured measure(const Work& work) {
  int ends[2] = {};
  if (pipe(ends) != 0) throw std::runtime_error("cannot create a pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot create a process");
  if (child == 0) {
    int status = 1;
    try {
      const Told told = work();
      status = write(ends[1], &told, sizeof told) == sizeof told ? 0 : 1;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "bench_ensembles: %s\n", error.what());
    }
    _exit(status);
  }
  close(ends[1]);
  Measured measured;
  const bool got = read(ends[0], &measured.told, sizeof measured.told) == sizeof measured.told;
  close(ends[0]);
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0 || !got)
    throw std::runtime_error("a measurement failed");
  measured.peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return measured;
}

Told read_bytes_of(const std::filesystem::path& path) {
  const auto start = Clock::now();
  std::ifstream file(path, std::ios::binary);
  std::vector<char> chunk(std::size_t{1} << 20);
  std::uint64_t sum = 0;
  while (file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || file.gcount() > 0)
    sum += static_cast<unsigned char>(chunk[0]);
  return {seconds_since(start), sum != 0 ? 1U : 0U};
}

Told read_frames(const std::filesystem::path& path, std::size_t residues) {
  const auto molecule = protein(residues);
  const auto start = Clock::now();
  const Trajectory frames(path, molecule->structure());
  double sum = 0.0;
  for (std::size_t k = 0; k < frames.size(); ++k) sum += frames.frame(k).back()[0];
  return {seconds_since(start), sum > 0.0 ? 1U : 0U};
}

/// Times opening the file and checking all frames. Free frames are written to `out` unless it is empty.
Told check_frames(const std::filesystem::path& path, std::size_t residues, unsigned threads,
                  const std::filesystem::path& out) {
  const auto molecule = protein(residues);
  const Structure& s = molecule->structure();
  Checker checker(molecule, molecule->select({}), rules());
  const auto start = Clock::now();
  const Trajectory frames(path, s);
  std::ofstream file(out, std::ios::binary);
  TrajectoryWriter writer(file, TrajectoryFormat::dcd, s, s.atoms.size());
  struct Result {
    bool collides;
    std::vector<Vec3> positions;
  };
  Told told;
  Ensemble(checker, threads)
      .run(
          frames.size(),
          [&](Checker& own, std::size_t k) {
            Result result{false, frames.frame(k)};
            result.collides = own.check_coordinates(result.positions, {Mode::Kind::any, 0.0}).collides;
            if (result.collides || out.empty()) result.positions = {};
            return result;
          },
          [&](std::size_t, const Result& result) {
            told.free += result.collides ? 0 : 1;
            if (!result.collides && !out.empty()) writer.add(result.positions, 0);
          },
          8);
  if (!out.empty()) writer.finish();
  told.seconds = seconds_since(start);
  return told;
}

void run(const Files& files, std::size_t count, std::size_t residues) {
  const Measured made = measure([&] {
    const auto start = Clock::now();
    generate(files, residues, count);
    return Told{seconds_since(start), 0};
  });
  const Measured alone = measure([&] {
    const auto molecule = protein(residues);
    return Told{0.0, molecule->structure().atoms.size()};
  });
  std::printf(
      "%zu conformations of %zu residues, %llu atoms, seed %llu; generated in %.1f s\n"
      "without frames, only the molecule: peak %.0f MB\n\n| file | MB | task | seconds | frames/s | peak MB | / "
      "reading | free |\n"
      "|---|---|---|---|---|---|---|---|\n",
      count, residues, static_cast<unsigned long long>(alone.told.free), static_cast<unsigned long long>(seed),
      made.told.seconds, alone.peak_megabytes);
  for (const std::string extension : {"npy", "dcd", "xtc"}) {
    const auto path = files.of(extension);
    double reading = 0.0;
    const auto row = [&](const char* what, const Measured& m, const std::string& free) {
      if (reading == 0.0 && std::string_view(what) == "read frames") reading = m.told.seconds;
      std::printf("| %s | %.0f | %s | %.3f | %.0f | %.0f | %.2f | %s |\n", extension.c_str(),
                  static_cast<double>(std::filesystem::file_size(path)) / 1e6, what, m.told.seconds,
                  static_cast<double>(count) / m.told.seconds, m.peak_megabytes,
                  reading > 0.0 ? m.told.seconds / reading : 0.0, free.c_str());
      std::fflush(stdout);
    };
    measure([&] { return read_bytes_of(path); });  // loads the file into the page cache
    row("read bytes", measure([&] { return read_bytes_of(path); }), "");
    row("read frames", measure([&] { return read_frames(path, residues); }), "");
    for (const unsigned threads : {1U, 2U}) {
      const Measured m = measure([&] { return check_frames(path, residues, threads, {}); });
      row(threads == 1 ? "check, 1 thread" : "check, 2 threads", m, std::to_string(m.told.free));
    }
    const Measured m = measure([&] { return check_frames(path, residues, 1, files.of("out")); });
    row("filter to DCD, 1 thread", m, std::to_string(m.told.free));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int k, std::size_t otherwise) {
    return argc > k ? static_cast<std::size_t>(std::strtoull(argv[k], nullptr, 10)) : otherwise;
  };
  const std::size_t count = number(1, 1000), residues = number(2, 994);
  Files files{argc > 3 ? std::filesystem::path(argv[3]) : std::filesystem::temp_directory_path()};
  files.folder /= "hinge-bench-ensembles-" + std::to_string(getpid());
  std::error_code ignored;
  int status = 0;
  try {
    if (count == 0 || residues == 0) throw std::runtime_error("expected at least one conformation and residue");
    std::filesystem::create_directories(files.folder);
    run(files, count, residues);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_ensembles: %s\n", error.what());
    status = 1;
  }
  std::filesystem::remove_all(files.folder, ignored);
  return status;
}
