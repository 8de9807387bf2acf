#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Uses Hinge from outside in three ways: installed package, fetched source, pkg-config.
# Arguments: a finished build folder, the C++ compiler.
set -euo pipefail
cd "$(dirname "$0")"
build=$1
compiler=$2
scratch=$build/consumers
rm -rf "$scratch"
mkdir -p "$scratch"

echo "== install, then move: nothing installed may remember where it was installed"
cmake --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/prefix"
"$scratch/prefix/bin/biocd" --version

# Not optimised, several sources at once: only building and running is tested.
consume() {  # arguments: folder, cmake arguments
  echo "== $1"
  cmake -G Ninja -S "$1" -B "$scratch/$1" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS=-O0 -DCMAKE_UNITY_BUILD=ON "${@:2}" >"$scratch/$1.log" 2>&1 ||
    { cat "$scratch/$1.log"; exit 1; }
  cmake --build "$scratch/$1"
  ctest --test-dir "$scratch/$1" --output-on-failure
}
consume find_package -DCMAKE_PREFIX_PATH="$scratch/prefix"
consume subdirectory -DHINGE_ROOT="$(cd ../.. && pwd)"

echo "== pkg-config"
pc=$(dirname "$(find "$scratch/prefix" -name hinge.pc)")
export PKG_CONFIG_PATH=$pc
flags=$(pkg-config --cflags hinge)
case " $flags " in *" -ffp-contract=off "*) ;; *) echo "pkg-config gives: $flags"; exit 1 ;; esac
# shellcheck disable=SC2086
"$compiler" -std=c++20 -Wall -Wextra -Werror $flags core.cpp -o "$scratch/core"
"$scratch/core"
echo "consumers: all three ways work"
