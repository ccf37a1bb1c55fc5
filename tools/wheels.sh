#!/usr/bin/env bash
# One wheel for every CPython from 3.9 on, also on old distributions, without a container: zig links against an old C
# library, auditwheel looks whether it needs nothing newer and gives it its tag.
#
#   PYTHON=out/wheels-venv/bin/python tools/wheels.sh out/wheels
set -euo pipefail

NEEDS_GLIBC=2.17
machine=$(uname -m)
built=$(mktemp -d)
trap 'rm -rf "$built"' EXIT
PATH=$(dirname "$PYTHON"):$PATH
# setuptools would put into the wheel what an earlier build has left there.
rm -rf python/build
CARGO=cargo-zigbuild CARGO_BUILD_TARGET=$machine-unknown-linux-gnu.$NEEDS_GLIBC \
    "$PYTHON" -m pip wheel -q --disable-pip-version-check --no-deps --no-build-isolation -w "$built" ./python
rm -rf "$1"
auditwheel repair --only-plat --plat "manylinux_${NEEDS_GLIBC/./_}_$machine" -w "$1" "$built"/cagedyn-*.whl
auditwheel show "$1"/*.whl
