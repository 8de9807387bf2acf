// SPDX-License-Identifier: BSD-3-Clause
// Target: trajectories. The first byte is the number of atoms, the rest is the file; its content shows the format.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "fuzz/bytes.hpp"
#include "fuzz/require.hpp"
#include "fuzz/scratch_file.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/molecular/trajectory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hinge::molecular;
  fuzz::Bytes bytes(data, size);
  Structure molecule;
  molecule.atoms.assign(1 + bytes.byte() % 64, Atom{"CA", "C", 0, '\0', 0, 0});
  molecule.residues.push_back({"ALA", 1, '\0', 0, 0, static_cast<std::uint32_t>(molecule.atoms.size()), {}});
  molecule.chains.push_back({"A", 0, 1});
  // Every second record of the molecule's file is an atom.
  for (std::uint32_t i = 0; i < molecule.atoms.size(); ++i) molecule.atoms[i].record = 2 * i;
  molecule.atom_records = 2 * molecule.atoms.size();
  const fuzz::ScratchFile file("input.traj", bytes.text());
  fuzz::accepts([&] {
    const Trajectory trajectory(file.path(), molecule);
    fuzz::require(trajectory.size() > 0, "a trajectory without frames");
    // Damaged frames are rejected one by one.
    for (std::size_t k = 0; k < std::min<std::size_t>(trajectory.size(), 8); ++k)
      fuzz::accepts([&] {
        const auto frame = trajectory.frame(k);
        fuzz::require(frame.size() == trajectory.atom_count(), "a frame of another number of atoms");
        for (const hinge::Vec3& x : frame) fuzz::require(hinge::is_finite(x), "a coordinate that is not finite");
        fuzz::require(trajectory.kept(frame).size() == molecule.atoms.size(), "atoms lost");
      });
  });
  return 0;
}
