#!/usr/bin/env bash
# Fetches LSODA for `make accuracy` and builds it: lsoda.c, the C port of ODEPACK's LSODA in the source package of scipy
# (BSD-3-Clause), with LAPACK of the package scipy-openblas32. Nothing is installed; LSODA is left out when there is no
# network or no pip.
#
#   tools/fetch_peers.sh FOLDER
set -euo pipefail

SCIPY=1.17.1
OPENBLAS=0.3.34.481.3

folder=${1:?usage: fetch_peers.sh FOLDER}
[ -e "$folder/libscipy_lsoda.so" ] && exit 0
if ! python3 -m pip --version >/dev/null 2>&1; then
    echo "no pip for python3: LSODA is left out of the comparison"
    exit 0
fi
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fetch() { python3 -m pip download --quiet --no-deps --dest "$work" "$@"; }

# pip asks the build system of a source package for its metadata even when it only downloads. This stand-in answers, so
# that no build system is needed.
mkdir "$work/stand_in"
cat > "$work/stand_in/mesonpy.py" <<PY
import os

def get_requires_for_build_wheel(config_settings=None):
    return []

def prepare_metadata_for_build_wheel(folder, config_settings=None):
    name = "scipy-$SCIPY.dist-info"
    os.makedirs(os.path.join(folder, name), exist_ok=True)
    with open(os.path.join(folder, name, "METADATA"), "w") as out:
        out.write("Metadata-Version: 2.1\nName: scipy\nVersion: $SCIPY\n")
    return name
PY

if ! fetch --only-binary=:all: "scipy-openblas32==$OPENBLAS" ||
    ! PYTHONPATH="$work/stand_in" fetch --no-build-isolation --no-binary scipy "scipy==$SCIPY"; then
    echo "the package index cannot be reached: LSODA is left out of the comparison"
    exit 0
fi
python3 -m zipfile -e "$work"/scipy_openblas32-*.whl "$work/openblas"
cp "$work"/openblas/scipy_openblas32/lib/*.so* "$folder/"
tar -xzf "$work/scipy-$SCIPY.tar.gz" -C "$work" "scipy-$SCIPY/scipy/integrate/src" "scipy-$SCIPY/LICENSE.txt"
cp "$work/scipy-$SCIPY/LICENSE.txt" "$folder/LICENSE-scipy.txt"
renames=()
for name in daxpy dcopy dscal dgbtrf dgbtrs dgetrf dgetrs; do
    renames+=("-D${name}_=scipy_${name}_")
done
cc -O3 -fPIC -shared -fexceptions "${renames[@]}" -o "$folder/libscipy_lsoda.so" \
    "$work/scipy-$SCIPY/scipy/integrate/src/lsoda.c" -L"$folder" -lscipy_openblas -lm -Wl,-rpath,'$ORIGIN'
