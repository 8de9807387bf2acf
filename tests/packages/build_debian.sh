#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian packages from the files that git tracks, in the folder WORK, checks them with lintian, and compares
# what the installed programs print with what they must: build_debian.sh WORK.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(realpath -m "$1")
version=$(sed -n 's/^hinge (\(.*\)-[^-]*) .*/\1/p' debian/changelog)
grep -q "version_string = \"$version\"" include/hinge/version.hpp ||
  { echo "build_debian.sh: debian/changelog has another version than include/hinge/version.hpp" >&2 && exit 1; }

rm -rf "$work"
mkdir -p "$work/hinge-$version"
git ls-files -z | xargs -0 cp --parents -t "$work/hinge-$version"
tar -C "$work" --exclude=debian -czf "$work/hinge_$version.orig.tar.gz" "hinge-$version"
(cd "$work/hinge-$version" && dpkg-buildpackage -us -uc)
# The packages are not meant for Debian's archive, where the first upload closes a bug.
lintian --info --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "$work"/hinge_*.changes

# The packages, unpacked, do what they are for. The status of a free molecule is 0.
for package in "$work"/*.deb; do dpkg-deb -x "$package" "$work/root"; done
"$work/root/usr/bin/biocd" check molecular/data/1ubq.pdb --exempt-reference
"$work/root/usr/bin/robocd" info robotics/data/arm.urdf
PYTHONPATH=$work/root/usr/lib/python3/dist-packages /usr/bin/python3 -B -c '
import numpy as np
import hinge.molecular as hm
checker = hm.Checker(hm.Molecule("molecular/data/1ubq.pdb"), exempt_reference=True)
assert not checker.collides(np.zeros(checker.dof))
print("hinge in Python: free")'
