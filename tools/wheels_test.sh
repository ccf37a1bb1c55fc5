#!/usr/bin/env bash
# The wheel in an empty environment of every CPython from 3.9 on that is here, without Rust or a compiler in the path: the example of
# its page, and with TESTS=1 the tests of the package. Tells how long pip takes.
#
#   tools/wheels_test.sh out/wheels
set -euo pipefail

wheel=("$1"/cagedyn-*-py3-none-manylinux*.whl)
[ -e "$wheel" ] || { echo "$1 has no wheel: run 'make wheels' first" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed -n '/^```python$/,/^```$/{/^```/d;p}' python/README.md > "$work/page.py"
unset CAGEDYN_LIBRARY PYTHONPATH
tried=0
for python in python3.{9..15}; do
    "$python" -c '' 2> /dev/null || { echo "$python is not there: not tested"; continue; }
    venv=$work/$python
    "$python" -m venv "$venv"
    begin=$(date +%s.%N)
    (PATH=$venv/bin && exec python -m pip install -q --disable-pip-version-check --only-binary :all: "$wheel")
    end=$(date +%s.%N)
    "$venv/bin/python" -c 'import platform, sys; print(platform.python_implementation(), platform.python_version(),
        f"- pip took {float(sys.argv[2]) - float(sys.argv[1]):.1f} s")' "$begin" "$end"
    (PATH=$venv/bin && exec python "$work/page.py")
    if [ "${TESTS:-0}" = 1 ]; then
        "$venv/bin/python" -m pip install -q --disable-pip-version-check "$wheel[test]"
        "$venv/bin/python" -m pytest -q -p no:cacheprovider python/tests
    fi
    tried=$((tried + 1))
done
[ $tried -gt 0 ] || { echo "there is no CPython from 3.9 on in the path" >&2; exit 1; }
