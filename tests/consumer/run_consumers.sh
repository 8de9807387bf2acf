#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and runs the examples of docs/examples as a user does: an installed package, fetched sources as shared
# libraries, headers alone, and pkg-config. Arguments: a finished build folder, the C++ compiler. Half of the examples
# are compiled by clang++ if it is there.
set -euo pipefail
cd "$(dirname "$0")"
build=$1
compiler=$2
other=$(command -v clang++ || echo "$compiler")
root=$(cd ../.. && pwd)
examples=$root/docs/examples
scratch=$build/consumers
rm -rf "$scratch"
mkdir -p "$scratch"

echo "== install, then move: nothing installed may remember where it was installed"
cmake --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/prefix"
"$scratch/prefix/bin/biocd" --version
for file in share/man/man1/biocd.1 share/man/man1/robocd.1 share/bash-completion/completions/biocd \
  share/doc/hinge/LICENSE share/doc/hinge/docs/tutorial/first_protein.md; do
  [ -s "$scratch/prefix/$file" ] || { echo "not installed: $file"; exit 1; }
done

# Not optimised, all sources of a target at once: only building and running is tested.
consume() {  # arguments: folder of the example, compiler, cmake arguments
  echo "== $1"
  cmake -G Ninja -S "$examples/$1" -B "$scratch/$1" -DCMAKE_CXX_COMPILER="$2" -DCMAKE_CXX_FLAGS=-O0 \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 -DCMAKE_PROJECT_INCLUDE="$PWD/checks.cmake" \
    "${@:3}" >"$scratch/$1.log" 2>&1 || { cat "$scratch/$1.log"; exit 1; }
  cmake --build "$scratch/$1" >"$scratch/$1-build.log" 2>&1 || { cat "$scratch/$1-build.log"; exit 1; }
}
expect() {  # arguments: expected output, command
  local output
  output=$("${@:2}")
  [ "$output" = "$1" ] || { echo "${*:2} prints '$output', expected '$1'"; exit 1; }
}
free_loops="507 of 1000 conformations are free"
elbow="elbow at 0 rad: free
elbow at 3 rad: collides"
protein=$root/molecular/data/1ubq.pdb

consume find_package "$compiler" -DCMAKE_PREFIX_PATH="$scratch/prefix"
expect "$free_loops" "$scratch/find_package/loop" "$protein"

# The second library takes a minute more, so only the exhaustive tests ask for it.
molecular=${HINGE_TEST_ALL:+ON}
consume fetch_content "$other" -DFETCHCONTENT_SOURCE_DIR_HINGE="$root" -DBUILD_SHARED_LIBS=ON \
  -DHINGE_BUILD_MOLECULAR="${molecular:-OFF}"
[ -z "$molecular" ] || expect "$free_loops" "$scratch/fetch_content/loop" "$protein"
expect free "$scratch/fetch_content/arm" "$root/robotics/data/arm.urdf"
library=$(find "$scratch/fetch_content" -name 'libhinge_robotics.so.[0-9]*' -type f)
# Only T, functions of the library's own: std is visible, and so are its templates, which are weak.
exported=$(nm -D --defined-only --demangle "$library" | grep ' T ')
grep -q 'hinge::robotics::read_urdf' <<<"$exported" || { echo "$library does not export read_urdf"; exit 1; }
if grep -E ' T (tinyxml2|hinge::robotics::convex_hull)' <<<"$exported"; then
  echo "$library exports private functions"
  exit 1
fi

consume header_only "$compiler" -DHINGE_INCLUDE="$root/include"
expect "$elbow" "$scratch/header_only/balls"

echo "== pkg-config"
PKG_CONFIG_PATH=$(dirname "$(find "$scratch/prefix" -name hinge.pc)")
export PKG_CONFIG_PATH
case " $(pkg-config --cflags hinge) " in *" -ffp-contract=off "*) ;; *) pkg-config --cflags hinge; exit 1 ;; esac
# shellcheck disable=SC2046
"$other" -std=c++20 -Wall -Wextra -Werror $(pkg-config --cflags hinge) core.cpp -o "$scratch/core"
"$scratch/core"
# shellcheck disable=SC2046
"$other" -std=c++20 "$examples/find_package/loop.cpp" $(pkg-config --cflags --libs hinge-molecular) -o "$scratch/loop"
expect "$free_loops" "$scratch/loop" "$protein"
# shellcheck disable=SC2046
"$other" -std=c++20 "$examples/fetch_content/arm.cpp" $(pkg-config --cflags --libs hinge-robotics) -o "$scratch/arm"
expect free "$scratch/arm" "$root/robotics/data/arm.urdf"
echo "consumers: all ways work"
