#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compiles every_answer.cpp with two compilers, with and without optimisation and contraction, for three instruction
# sets, and compares the output. Verdicts and pairs must be equal in every build; poses and distances in every build
# without contraction, which the exported target disables. It also compiles with libc++ and, on x86-64, for ARM64 and
# Windows, and runs these programs under qemu and Wine, if all that is there. Argument: a build folder. CPU time: half an
# hour.
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${1:?a folder to build in}
jobs=${HINGE_JOBS:-$(nproc)}
mkdir -p "$out"
eigen=$(pkg-config --variable=includedir eigen3 2>/dev/null || echo /usr/include)/eigen3
[ -d "$eigen" ] || eigen=/usr/include/eigen3
common="-std=c++20 -DNDEBUG -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -Iinclude -Itests -isystem $eigen"
export out common

levels="x86-64 x86-64-v3 x86-64-v4"
[ "$(uname -m)" = x86_64 ] || levels=native
lowest=${levels%% *}
windows_compiler=x86_64-w64-mingw32-g++-posix wine=/usr/lib/wine/wine64
export windows_compiler wine

builds() {
  local compiler level optimised contraction
  for compiler in g++ clang++; do
    command -v "$compiler" >/dev/null || continue
    for optimised in -O3 -O0; do
      for level in $levels; do
        for contraction in off fast; do
          # There is no contraction without optimisation or without fused multiply-add instructions.
          [ "$contraction" = fast ] && { [ "$optimised" = -O0 ] || [ "$level" = x86-64 ]; } && continue
          echo "$compiler $optimised $contraction $level"
        done
      done
    done
  done
  if echo '#include <vector>' | clang++ -stdlib=libc++ -x c++ -fsyntax-only - 2>/dev/null; then
    echo "clang++_libc++ -O3 off $lowest"
  fi
  if [ "$(uname -m)" = x86_64 ] && command -v aarch64-linux-gnu-g++ >/dev/null &&
    command -v qemu-aarch64 >/dev/null; then
    echo "aarch64-linux-gnu-g++ -O3 off armv8-a"
  fi
  if command -v "$windows_compiler" >/dev/null && [ -x "$wine" ]; then
    echo "$windows_compiler -O3 off x86-64"
  fi
}

build_and_run() {
  local compiler=$1 optimised=$2 contraction=$3 level=$4
  local name=$compiler$optimised-$contraction-$level
  local program=$out/$name start=$SECONDS status=0
  local main=$out/main.o link=(g++) libraries=(-ltbb) emulator=() more=() compile=("$compiler")
  # Debian has TBB for these only as a foreign architecture, or not at all.
  case $compiler in
    clang++_libc++)
      more=(-DHINGE_ONE_THREAD) main=$out/main-libc++.o
      compile=(clang++ -stdlib=libc++) link=("${compile[@]}") libraries=()
      ;;
    aarch64-linux-gnu-g++)
      more=(-DHINGE_ONE_THREAD -Wno-psabi) main=$out/main-arm64.o
      link=("$compiler" -static) libraries=() emulator=(qemu-aarch64)
      ;;
    "$windows_compiler")
      more=(-DHINGE_ONE_THREAD) main=$out/main-windows.o program=$out/$name.exe
      link=("$compiler" -static) libraries=() emulator=(env "WINEPREFIX=$(realpath "$out")/wine" WINEDEBUG=-all "$wine")
      ;;
  esac
  # shellcheck disable=SC2086 # flags are several words
  [ "$main" = "$out/main.o" ] || "${compile[@]}" $common -O1 -c tests/isa/main.cpp -o "$main"
  # shellcheck disable=SC2086
  if ! "${compile[@]}" $common ${more[@]+"${more[@]}"} $optimised -march="$level" -ffp-contract="$contraction" \
    -c tests/isa/every_answer.cpp -o "$out/$name.o" ||
    ! "${link[@]}" "$main" "$out/$name.o" ${libraries[@]+"${libraries[@]}"} -o "$program"; then
    echo "$name does not compile" >&2
    return 1
  fi
  rm "$out/$name.o"
  local compiled=$((SECONDS - start))
  ${emulator[@]+"${emulator[@]}"} "$program" >"$out/$name.txt" 2>"$out/$name.err" || status=$?
  sed -i 's/\r$//' "$out/$name.txt"
  echo "$status $compiled $((SECONDS - start - compiled))" >"$out/$name.status"
}
export -f build_and_run

# shellcheck disable=SC2086
g++ $common -O1 -march="$lowest" -c tests/isa/main.cpp -o "$out/main.o"
builds | xargs -L 1 -P "$jobs" bash -c 'build_and_run "$@"' build

hashes() { grep -E "^[^|]*\|($1)\|" "$2" || true; }
# A missing hash is a difference too, except those of several threads, which some programs leave out.
differing() { diff <(hashes "$1" "$2") <(hashes "$1" "$3") | grep '^[<>]' | grep -cv '^<.* threads|' || true; }

reference='' failures=0
printf '%-28s %-5s %-11s %-10s %-9s %-19s %s\n' compiler opt contraction level verdicts 'poses and distances' seconds
while read -r compiler optimised contraction level; do
  name=$compiler$optimised-$contraction-$level
  read -r status compiled ran <"$out/$name.status"
  if [ "$status" -eq 77 ]; then
    printf '%-28s %-5s %-11s %-10s not run: this CPU has not these instructions\n' "$compiler" "$optimised" \
      "$contraction" "$level"
    continue
  fi
  [ -n "$reference" ] || reference=$out/$name.txt
  verdicts=$(differing verdicts "$reference" "$out/$name.txt")
  numbers=$(differing 'poses|distances' "$reference" "$out/$name.txt")
  lines=$(hashes 'poses|distances' "$reference" | wc -l)
  [ "$verdicts" -eq 0 ] && [ "$status" -eq 0 ] || failures=$((failures + 1))
  [ "$contraction" = fast ] || [ "$numbers" -eq 0 ] || failures=$((failures + 1))
  printf '%-28s %-5s %-11s %-10s %-9s %-19s %d + %d\n' "$compiler" "$optimised" "$contraction" "$level" \
    "$([ "$verdicts" -eq 0 ] && echo equal || echo "$verdicts DIFFER")" \
    "$([ "$numbers" -eq 0 ] && echo equal || echo "$numbers of $lines differ")" "$compiled" "$ran"
  [ "$status" -eq 0 ] || cat "$out/$name.txt" "$out/$name.err"
done < <(builds)
echo "$(hashes verdicts "$reference" | wc -l) hashes of verdicts and pairs, $failures builds differ"
[ "$failures" -eq 0 ]
