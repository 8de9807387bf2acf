// SPDX-License-Identifier: BSD-3-Clause
// Writes trajectories for tests and benchmarks as strings of bytes. Shares no code with the readers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"

namespace hinge::test {

using Frame = std::vector<Vec3>;

/// Appends numbers to `bytes`, in big-endian or little-endian order.
class ByteWriter {
 public:
  explicit ByteWriter(bool big) : big_(big) {}
  std::string bytes;

  void number(std::uint64_t value, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) bytes += static_cast<char>(value >> (8 * (big_ ? size - 1 - k : k)) & 0xff);
  }
  void i4(std::int64_t value) { number(static_cast<std::uint64_t>(value), 4); }
  void f4(double value) { number(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4); }
  void f8(double value) { number(std::bit_cast<std::uint64_t>(value), 8); }

 private:
  bool big_;
};

/// The variants of DCD files. marker: bytes of a record length; fourth: a fourth coordinate per atom.
struct DcdStyle {
  bool big = false;
  bool charmm = true;
  bool cell = false;
  bool fourth = false;
  std::size_t marker = 4;
  std::vector<std::size_t> moving{};  ///< atoms in frames after the first; the others are fixed; empty: all move
  std::int64_t claimed = -1;          ///< number of frames in the header; -1: the real number
};

/// Returns a DCD file of these frames (angstrom); at least one frame.
inline std::string dcd_file(const std::vector<Frame>& frames, const DcdStyle& style = {}) {
  ByteWriter out(style.big);
  const auto record = [&](std::size_t size, const auto& write) {
    out.number(size, style.marker);
    write();
    out.number(size, style.marker);
  };
  const std::size_t atoms = frames.at(0).size();
  record(84, [&] {
    out.bytes += "CORD";
    out.i4(style.claimed < 0 ? static_cast<std::int64_t>(frames.size()) : style.claimed);
    for (int k = 0; k < 7; ++k) out.i4(1);
    out.i4(style.moving.empty() ? 0 : static_cast<std::int64_t>(atoms - style.moving.size()));
    if (style.charmm) {
      out.f4(0.002);
      out.i4(style.cell ? 1 : 0);
      out.i4(style.fourth ? 1 : 0);
    } else {
      out.f8(0.002);  // 8 bytes in X-PLOR files: the second half must not be read as a flag
      out.i4(0);
    }
    for (int k = 0; k < 7; ++k) out.i4(0);
    out.i4(style.charmm ? 35 : 0);
  });
  record(4 + 2 * 80, [&] {
    out.i4(2);
    out.bytes += std::string(160, 'x');
  });
  record(4, [&] { out.i4(static_cast<std::int64_t>(atoms)); });
  if (!style.moving.empty())
    record(4 * style.moving.size(), [&] {
      for (const std::size_t i : style.moving) out.i4(static_cast<std::int64_t>(i) + 1);
    });
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (style.cell)
      record(48, [&] {
        for (int k = 0; k < 6; ++k) out.f8(90.0);
      });
    std::vector<std::size_t> written = style.moving;
    if (f == 0 || written.empty()) {
      written.resize(atoms);
      for (std::size_t i = 0; i < atoms; ++i) written[i] = i;
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      record(4 * written.size(), [&] {
        for (const std::size_t i : written) out.f4(frames[f][i][axis]);
      });
    if (style.fourth)
      record(4 * written.size(), [&] {
        for (std::size_t i = 0; i < written.size(); ++i) out.f4(7);
      });
  }
  return out.bytes;
}

/// Returns a NumPy file of these frames. type: "<f4", ">f8" and so on; order: fortran_order; shape: replaces the real
/// shape unless empty.
inline std::string npy_file(const std::vector<Frame>& frames, const std::string& type = "<f4", int version = 1,
                            const std::string& order = "False", const std::string& shape = "") {
  const std::size_t atoms = frames.empty() ? 5 : frames[0].size();
  std::string head = "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': ";
  head += shape.empty() ? "(" + std::to_string(frames.size()) + ", " + std::to_string(atoms) + ", 3)" : shape;
  head += ", }";
  head.resize(117, ' ');
  head += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  ByteWriter length(false), out(type[0] == '>');
  length.number(head.size(), version == 1 ? 2 : 4);
  const auto put = [&](double c) { type[2] == '4' ? out.f4(c) : out.f8(c); };
  if (order == "True")
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      for (std::size_t atom = 0; atom < atoms; ++atom)
        for (const Frame& frame : frames) put(frame[atom][axis]);
  else
    for (const Frame& frame : frames)
      for (const Vec3& x : frame)
        for (const double c : {x[0], x[1], x[2]}) put(c);
  return bytes + length.bytes + head + out.bytes;
}

/// Writes XTC files, compressed with runs of small differences as GROMACS does. Input in angstrom; `precision` steps
/// per nanometre.
class XtcPacker {
 public:
  explicit XtcPacker(double precision = 1000.0, std::int64_t magic = 1995) : precision_(precision), magic_(magic) {}

  /// Returns an XTC file of these frames.
  std::string file(const std::vector<Frame>& frames) {
    std::string bytes;
    for (const Frame& f : frames) bytes += frame(f);
    return bytes;
  }

  /// Returns one frame of an XTC file; up to nine atoms are not compressed.
  std::string frame(const Frame& positions) {
    ByteWriter out(true);
    const auto atoms = static_cast<std::int64_t>(positions.size());
    out.i4(magic_);
    out.i4(atoms);
    out.i4(1);
    out.f4(0.5);
    for (int k = 0; k < 9; ++k) out.f4(k % 4 == 0 ? 10.0 : 0.0);
    out.i4(atoms);
    if (atoms <= 9) {
      for (const Vec3& x : positions)
        for (Eigen::Index a = 0; a < 3; ++a) out.f4(x[a] / 10.0);
      return out.bytes;
    }
    std::vector<Triple> grid;
    for (const Vec3& x : positions) {
      Triple t{};
      for (std::size_t a = 0; a < 3; ++a) t[a] = std::llround(x[static_cast<Eigen::Index>(a)] / 10.0 * precision_);
      grid.push_back(t);
    }
    Triple low = grid[0], high = grid[0];
    for (const Triple& t : grid)
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], t[a]);
        high[a] = std::max(high[a], t[a]);
      }
    out.f4(precision_);
    for (const std::int64_t c : low) out.i4(c);
    for (const std::int64_t c : high) out.i4(c);
    bits_.clear();
    const int small = pack(grid, low, high);
    out.i4(small);
    std::string packed((bits_.size() + 7) / 8, '\0');
    for (std::size_t k = 0; k < bits_.size(); ++k)
      if (bits_[k]) packed[k / 8] = static_cast<char>(packed[k / 8] | 0x80 >> k % 8);
    out.number(packed.size(), magic_ == 1995 ? 4 : 8);
    packed.resize((packed.size() + 3) / 4 * 4, '\0');
    return out.bytes + packed;
  }

 private:
  using Triple = std::array<std::int64_t, 3>;
  /// A large integer, least significant byte first.
  using Big = std::vector<unsigned>;

  /// Returns the side of small range n: the values of GROMACS' tables that the packer uses.
  static std::int64_t side(int n) {
    static const std::vector<std::int64_t> sides = {8,   10,  12,  16,  20,  25,  32,  40,  50,   64,   80,   101, 128,
                                                    161, 203, 256, 322, 406, 512, 645, 812, 1024, 1290, 1625, 2048};
    return sides.at(static_cast<std::size_t>(n - 9));
  }

  void put(std::uint64_t value, int count) {
    for (int k = count - 1; k >= 0; --k) bits_.push_back((value >> k & 1) != 0);
  }
  static void multiply_add(Big& big, std::uint64_t factor, std::uint64_t add) {
    std::uint64_t carry = add;
    for (unsigned& byte : big) {
      carry += byte * factor;
      byte = static_cast<unsigned>(carry & 0xff);
      carry >>= 8;
    }
    for (; carry != 0; carry >>= 8) big.push_back(static_cast<unsigned>(carry & 0xff));
  }
  static int bit_count(Big big) {
    while (!big.empty() && big.back() == 0) big.pop_back();
    return big.empty() ? 0
                       : static_cast<int>(8 * (big.size() - 1) + static_cast<std::size_t>(std::bit_width(big.back())));
  }
  /// Writes three numbers, each below its size, as one number of `count` bits.
  void put_three(const Triple& t, const Triple& sizes, int count) {
    Big big;
    multiply_add(big, 1, static_cast<std::uint64_t>(t[0]));
    multiply_add(big, static_cast<std::uint64_t>(sizes[1]), static_cast<std::uint64_t>(t[1]));
    multiply_add(big, static_cast<std::uint64_t>(sizes[2]), static_cast<std::uint64_t>(t[2]));
    big.resize(16, 0);
    for (std::size_t k = 0; count > 0; ++k, count -= 8) put(big[k], std::min(count, 8));
  }

  /// Packs the atoms and returns the first small range. Greedy: a run has up to eight atoms, each close to the one
  /// before. The range shrinks after long runs and grows without runs.
  int pack(const std::vector<Triple>& grid, const Triple& low, const Triple& high) {
    Triple sizes{};
    bool together = true;
    for (std::size_t a = 0; a < 3; ++a) {
      sizes[a] = high[a] - low[a] + 1;
      together = together && sizes[a] <= 0xffffff;
    }
    Big product;
    multiply_add(product, 1, 1);
    for (const std::int64_t s : sizes) multiply_add(product, static_cast<std::uint64_t>(s), 0);
    const int first_small = 21;
    int small = first_small, last_run = 0;
    std::size_t i = 0;
    const auto near = [&](const Triple& a, const Triple& b, int n) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t d = a[k] - b[k] + side(n) / 2;
        if (d < 0 || d >= side(n)) return false;
      }
      return true;
    };
    while (i < grid.size()) {
      // If a run follows, the format stores the second atom before the first.
      std::vector<Triple> run;
      Triple large = grid[i];
      if (i + 1 < grid.size() && near(grid[i], grid[i + 1], small)) {
        large = grid[i + 1];
        run.push_back(grid[i]);
        Triple last = grid[i];
        for (std::size_t j = i + 2; j < grid.size() && run.size() < 8 && near(grid[j], last, small); ++j) {
          run.push_back(grid[j]);
          last = grid[j];
        }
      }
      Triple t{};
      for (std::size_t a = 0; a < 3; ++a) t[a] = large[a] - low[a];
      if (together)
        put_three(t, sizes, bit_count(product));
      else
        for (std::size_t a = 0; a < 3; ++a)
          put(static_cast<std::uint64_t>(t[a]), static_cast<int>(std::bit_width(static_cast<std::uint64_t>(sizes[a]))));
      int change = 0;
      if (run.empty() && small < 33) change = 1;
      if (run.size() >= 4 && small > 12) change = -1;
      const int length = static_cast<int>(run.size());
      if (length != last_run || change != 0) {
        put(1, 1);
        put(static_cast<std::uint64_t>(3) * run.size() + static_cast<std::uint64_t>(change + 1), 5);
      } else {
        put(0, 1);
      }
      last_run = length;
      Triple last = large;
      for (const Triple& next : run) {
        Triple d{};
        for (std::size_t a = 0; a < 3; ++a) d[a] = next[a] - last[a] + side(small) / 2;
        put_three(d, {side(small), side(small), side(small)}, small);
        last = next;
      }
      i += 1 + run.size();
      small += change;
    }
    return first_small;
  }

  double precision_;
  std::int64_t magic_;
  std::vector<bool> bits_;
};

}  // namespace hinge::test
