#!/usr/bin/env bash
# What a release needs beside `make test`. A tool that is missing is installed, or is an error. Steps may be named:
# calls package python wheels rotor octave browser deb c-sanitizers sanitizers c-threads fuzz platforms; without names all are made.
set -euo pipefail

NIGHTLY=nightly-2026-10-30
HOST=$(rustc -vV | sed -n 's/^host: //p')
NEEDS_GLIBC=2.17
FUZZ_SECONDS=${FUZZ_SECONDS:-60}
CARGO=${CARGO:-cargo}
PYTHON=${PYTHON:-$PWD/out/venv/bin/python}
out=$PWD/out/release-check
mkdir -p "$out"

have() { command -v "$1" > /dev/null || tools/install.sh "${2:-$1}"; command -v "$1" > /dev/null; }
nightly() {
    rustup toolchain list | grep -q "^$NIGHTLY" || rustup toolchain install "$NIGHTLY" --profile minimal -c rust-src
}
# A command that must fail: it is checked by a defect that it must find.
must_fail() { if "$@" > "$out/planted.log" 2>&1; then echo "found nothing: $*" >&2; exit 1; fi; }

# A million random calls of the C ABI.
calls() { CAGEDYN_CALLS=1000000 $CARGO test --release --locked --test interfaces -- calls:: --nocapture; }

# The crate builds from what would be published.
package() { $CARGO package --locked; }

# A clean Python, the wheel from this folder, which is for every Python 3, its tests and the ten lines of its page.
python() {
    rm -rf "$out/venv" "$out/wheel" python/build
    python3 -m venv "$out/venv"
    "$out/venv/bin/python" -m pip wheel -q --disable-pip-version-check --no-deps -w "$out/wheel" ./python
    local wheel=("$out"/wheel/cagedyn-*-py3-none-*.whl)
    ! "$out/venv/bin/python" -m zipfile -l "$wheel" | grep cpython || { echo "$wheel has what is for one Python" >&2; exit 1; }
    "$out/venv/bin/python" -m pip install -q --disable-pip-version-check "$wheel[test,examples,study]"
    "$out/venv/bin/python" -m pytest -q -p no:cacheprovider python/tests
    sed -n '/^```python$/,/^```$/{/^```/d;p}' python/README.md > "$out/page.py"
    "$out/venv/bin/python" "$out/page.py"
}

# The wheel that is released, with its tests, in all Pythons that are here.
wheels() { TESTS=1 make wheels-test; }

# A rotor of ROSS on bearings.
rotor() {
    make out/rotor-venv/ready
    $CARGO build --release --locked --lib
    out/rotor-venv/bin/python -c "import ross"
    CAGEDYN_LIBRARY=$PWD/target/release/libcagedyn.so PYTHONPATH=python \
        out/rotor-venv/bin/python -m pytest -q -p no:cacheprovider python/tests/test_rotor_ross.py
}

# Octave by way of the gateway for MATLAB, and what reads the tables of the tool.
octave() {
    have mkoctfile octave-dev
    have octave-cli octave
    "$PYTHON" -m pip install -q --disable-pip-version-check -r python/requirements-formats.txt
    CAGEDYN_REQUIRE_ALL_HOSTS=1 CAGEDYN_PYTHON=$PYTHON $CARGO test --release --locked --test interfaces -- hosts:: formats:: octave
}

# Reports in a browser.
browser() {
    have chromium chromium
    CAGEDYN_REQUIRE_ALL_HOSTS=1 $CARGO test --release --locked --test interfaces -- report::
}

# The Debian package installs, a program builds against it, and it goes without a trace.
deb() {
    have dpkg-shlibdeps dpkg-dev
    make deb
    local package as_root=
    package=$(ls out/cagedyn_*.deb)
    [ "$(id -u)" = 0 ] || as_root=sudo
    $as_root dpkg -i "$package"
    cagedyn info /usr/share/cagedyn/scenes/nu2310.json > "$out/info.txt"
    cc -std=c99 -Wall -Werror /usr/share/doc/cagedyn/examples/nu2310.c $(pkg-config --cflags --libs cagedyn) -o "$out/nu2310"
    "$out/nu2310" /usr/share/cagedyn/scenes/nu2310.json "$out/nu2310.csv"
    dpkg -c "$package" > "$out/package.txt"
    grep -q man/man1/cagedyn-run.1.gz "$out/package.txt" || { echo "there is no manual" >&2; exit 1; }
    grep -q bash-completion/completions/cagedyn "$out/package.txt" || { echo "there are no completions" >&2; exit 1; }
    dpkg -L cagedyn | while read -r file; do [ -d "$file" ] || echo "$file"; done > "$out/files.txt"
    $as_root dpkg -r cagedyn
    while read -r file; do [ ! -e "$file" ] || { echo "$file is left" >&2; exit 1; }; done < "$out/files.txt"
}

# The C and C++ tests with the sanitizers of the compiler, which also watch the memory of the library.
c-sanitizers() {
    $CARGO build --release --locked --lib
    ln -sf libcagedyn.so target/release/libcagedyn.so.0
    local flags="-g -O1 -fsanitize=address,undefined -fno-sanitize-recover=all"
    cc $flags tools/planted/planted.c -pthread -o "$out/planted-c"
    must_fail "$out/planted-c" overflow
    must_fail "$out/planted-c" undefined
    "$out/planted-c" nothing || { echo "finds what is not there" >&2; exit 1; }
    local test scene
    for test in model sim limits errors threads integrator batch guide motion whirl heat; do
        scene=scenes/nu2310.json
        case $test in
            guide | whirl) scene=scenes/grease_guide.json ;;
            heat) scene=scenes/grease_guide_heat.json ;;
        esac
        cc -std=c11 $flags -Iinclude ctests/test_$test.c -o "$out/test_$test" -Ltarget/release -lcagedyn -lm -pthread \
            -Wl,-rpath,"$PWD/target/release"
        "$out/test_$test" $scene
    done
    for test in cpp cpp_analysis; do
        c++ -std=c++17 $flags -Iinclude ctests/test_$test.cpp -o "$out/test_$test" -Ltarget/release -lcagedyn -pthread \
            -Wl,-rpath,"$PWD/target/release"
    done
    "$out/test_cpp" scenes/nu2310.json
    "$out/test_cpp_analysis" scenes/grease_guide_heat.json all
}

# The library itself, compiled with sanitizers: random calls for addresses and leaks, batches and threads for races.
sanitizers() {
    nightly
    local kind flags
    for kind in address thread; do
        flags="-Zsanitizer=$kind"
        rustc +$NIGHTLY $flags -Cunsafe-allow-abi-mismatch=sanitizer --target "$HOST" -O tools/planted/planted.rs \
            -o "$out/planted-$kind"
        "$out/planted-$kind" nothing
    done
    must_fail "$out/planted-address" use-after-free
    must_fail "$out/planted-address" leak
    must_fail "$out/planted-thread" race
    RUSTFLAGS=-Zsanitizer=address CAGEDYN_CALLS=100000 $CARGO +$NIGHTLY test --release --locked --target "$HOST" \
        --target-dir target/asan --test interfaces -- calls::
    # The standard library must be watched, too, or its locks are seen as races.
    RUSTFLAGS=-Zsanitizer=thread $CARGO +$NIGHTLY test -Zbuild-std --release --locked --target "$HOST" \
        --target-dir target/tsan --no-default-features --lib -- batch::
}

# The C tests of threads and batches for races, on a library that is compiled with the thread sanitizer. Its runtime is that of
# the Rust compiler, which knows the calls of both compilers.
c-threads() {
    nightly
    RUSTFLAGS=-Zsanitizer=thread $CARGO +$NIGHTLY build -Zbuild-std --release --locked --target "$HOST" \
        --target-dir target/tsan --no-default-features --lib
    local runtime test
    runtime=$(rustc +$NIGHTLY --print sysroot)/lib/rustlib/$HOST/lib/librustc-nightly_rt.tsan.a
    for test in planted threads batch; do
        local source=ctests/test_$test.c
        [ $test != planted ] || source=tools/planted/planted.c
        cc -std=c11 -g -O1 -fsanitize=thread -Iinclude -c "$source" -o "$out/$test-tsan.o"
        cc "$out/$test-tsan.o" "target/tsan/$HOST/release/libcagedyn.a" -Wl,--whole-archive "$runtime" \
            -Wl,--no-whole-archive -Wl,--export-dynamic -lm -pthread -ldl -lrt -lstdc++ -o "$out/$test-tsan"
    done
    must_fail "$out/planted-tsan" race
    "$out/planted-tsan" nothing
    for test in threads batch; do "$out/$test-tsan" scenes/nu2310.json; done
}

# Fuzzing of what comes from outside, from a committed corpus on.
fuzz() {
    nightly
    command -v cargo-fuzz > /dev/null || $CARGO install --locked cargo-fuzz --version 0.13.1
    local target
    for target in scene overrides restore calls; do
        mkdir -p "fuzz/work/$target"
        $CARGO +$NIGHTLY fuzz run "$target" "fuzz/work/$target" "fuzz/corpus/$target" -- \
            -max_total_time="$FUZZ_SECONDS" -rss_limit_mb=4096
    done
}

# Old C libraries and other processors: linked by zig, run by qemu; types and header for Windows and macOS.
platforms() {
    have qemu-aarch64 qemu-user
    "$PYTHON" -m pip install -q --disable-pip-version-check cargo-zigbuild==0.24.0 ziglang==0.17.1
    local bin target newest
    bin=$(dirname "$PYTHON")
    export PATH=$bin:$PATH
    for target in x86_64-unknown-linux-gnu aarch64-unknown-linux-gnu; do
        rustup target add $target
        $CARGO zigbuild --release --locked --lib --no-default-features --target $target.$NEEDS_GLIBC \
            --target-dir target/zig
        newest=$(objdump -T target/zig/$target/release/libcagedyn.so | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -1)
        echo "$target needs $newest"
        [ "$(printf '%s\n' "GLIBC_$NEEDS_GLIBC" "$newest" | sort -V | tail -1)" = "GLIBC_$NEEDS_GLIBC" ]
    done
    # A program for the other processor, with the static library, and its output beside that of this one.
    "$PYTHON" -m ziglang cc -target aarch64-linux-musl -std=c99 -O1 -Iinclude -c examples/forces.c -o "$out/forces.o"
    "$PYTHON" -m ziglang cc -target aarch64-linux-gnu.$NEEDS_GLIBC -std=c99 -O1 -Iinclude examples/forces.c \
        target/zig/aarch64-unknown-linux-gnu/release/libcagedyn.a -lm -lpthread -ldl -lunwind -o "$out/forces-aarch64"
    have aarch64-linux-gnu-gcc gcc-aarch64-linux-gnu
    qemu-aarch64 -L /usr/aarch64-linux-gnu "$out/forces-aarch64" scenes/nu2310.json > "$out/forces-aarch64.txt"
    diff "$out/forces-aarch64.txt" examples/expected/forces.txt
    for target in x86_64-pc-windows-gnu aarch64-apple-darwin; do
        rustup target add $target
        $CARGO check --locked --lib --no-default-features --target $target --target-dir target/zig
    done
}

for step in ${*:-calls package python wheels rotor octave browser deb c-sanitizers sanitizers c-threads fuzz platforms}; do
    echo "== $step"
    $step
done
echo "release check: all steps passed"
