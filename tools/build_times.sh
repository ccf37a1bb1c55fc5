#!/usr/bin/env bash
# Times what building and testing takes, in a fresh clone with a target directory of its own, and prints the tables of
# docs/building.md; with --docs it writes them there. `builds` makes the first table only and takes six minutes, `tests` the others and
# takes an hour. Crates are fetched before.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
docs= parts="builds tests"
for argument; do
    case $argument in
        --docs) docs=1 ;;
        builds | tests) parts=$argument ;;
        *) echo "usage: build_times.sh [--docs] [builds|tests]" >&2; exit 2 ;;
    esac
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git clone -q "$root" "$work/cagedyn"
cd "$work/cagedyn"
unset CARGO_TARGET_DIR
export LC_ALL=C
cargo fetch -q --locked
law=src/laws/traction/self_heating.rs
TIMEFORMAT='%R %U %S'

# One row: wall time and processor time (user and system, with all children) of a command.
row() {
    local name=$1 log="$work/log" times
    shift
    echo "timing: $name" >&2
    if ! times=$({ time "$@" >"$log" 2>&1; } 2>&1); then
        tail -n 40 "$log" >&2
        exit 1
    fi
    read -r wall user system <<<"$times"
    awk -v n="$name" -v w="$wall" -v c="$user" -v s="$system" \
        'BEGIN { printf "| %s | %.0f s | %.0f s |\n", n, w, c + s }'
}

# Changes a constant of a law, so that its code is another.
touch_law() {
    local before
    before=$(sha256sum "$law")
    sed -i "s/^const FAST_STEPS: usize = .*/const FAST_STEPS: usize = $1;/" "$law"
    [ "$before" != "$(sha256sum "$law")" ] || { echo "$law has no FAST_STEPS to change" >&2; exit 1; }
}

builds() {
    row "first command of the README" cargo run --release --locked -- run scenes/nu2310.json --out out
    cargo clean -q --release --package cagedyn
    row "of it library and tool, dependencies being there" cargo build --release --locked
    touch_law 13
    row "release build after touching one law" cargo build --release --locked
    touch_law 12
}

tests() {
    row "\`make test\`, fresh clone" make test
    cp "$work/log" "$work/tests.log"
    row "\`make test\` again" make test
    row "\`make check\` again" make check
    touch_law 13
    row "\`make check\` after touching one law" make check
    touch_law 12
    programs >"$work/programs"
}

# What the test programs take by themselves, those from five seconds on.
programs() {
    echo "| test program | wall time |"
    echo "|---|---:|"
    awk '/Running / { name = $2 == "unittests" ? "unit tests, " $3 : $2 }
        /Doc-tests / { name = "doc tests" }
        /^test result/ {
            time = $NF
            sub("s$", "", time)
            time += 0
            if (time >= 5) printf "%d| `%s` | %.0f s |\n", time, name, time
        }' \
        "$work/tests.log" | sort -rn | sed 's/^[0-9]*//'
}

for part in $parts; do
    {
        echo "| what | wall time | processor time |"
        echo "|---|---:|---:|"
        "$part"
    } >"$work/$part"
done

for table in builds tests programs; do
    [ ! -e "$work/$table" ] || cat "$work/$table"
done
if [ -n "$docs" ]; then
    awk -v work="$work" '
        /<!-- end -->/ { skip = 0 }
        !skip { print }
        /<!-- (builds|tests|programs) -->/ {
            table = work "/" $2
            while ((getline line <table) > 0) {
                if (!skip) print ""
                skip = 1
                print line
            }
        }
    ' "$root/docs/building.md" >"$work/page"
    cp "$work/page" "$root/docs/building.md"
fi
