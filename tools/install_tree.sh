#!/usr/bin/env bash
# Installs what `make build` has built, below $DESTDIR. Everything is put together in a folder first and copied when it is
# complete, so a failure leaves nothing half-installed. `--remove` takes away what was installed.
#
#   PREFIX=/usr/local LIBDIR=/usr/local/lib DESTDIR= VERSION=0.1.0 BUILT=target/release tools/install_tree.sh
set -euo pipefail

for folder in "$PREFIX" "$LIBDIR"; do
    case $folder in
        /*) ;;
        *) echo "PREFIX and LIBDIR must begin with a slash: $folder" >&2; exit 1 ;;
    esac
done
share=$PREFIX/share/cagedyn
list=$DESTDIR$share/installed

if [ "${1:-}" = --remove ]; then
    [ -e "$list" ] || { echo "nothing of cagedyn is installed below $DESTDIR$PREFIX" >&2; exit 1; }
    # A copied tree lists the files of the one that it was copied from.
    while read -r file; do
        case $file in
        "$PREFIX"/* | "$LIBDIR"/*) ;;
        *) echo "$list names $file, which is not below $PREFIX or $LIBDIR; nothing is removed" >&2; exit 1 ;;
        esac
    done < "$list"
    while read -r file; do rm -f "$DESTDIR$file"; done < "$list"
    rm -f "$list"
    for folder in "$share" "$PREFIX/share/doc/cagedyn" "$LIBDIR/cmake/cagedyn"; do
        [ ! -d "$DESTDIR$folder" ] || find "$DESTDIR$folder" -depth -type d -empty -delete
    done
    exit 0
fi

for file in libcagedyn.so libcagedyn.a cagedyn; do
    [ -e "$BUILT/$file" ] || { echo "$BUILT/$file is missing: run 'make build' first, as the user who builds" >&2; exit 1; }
done

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
put() { install -D -m "$1" "$2" "$tree$3"; }

put 755 "$BUILT/libcagedyn.so" "$LIBDIR/libcagedyn.so.$VERSION"
# What the dynamic linker does not need goes; STRIP=: keeps it.
${STRIP:-strip} --strip-unneeded "$tree$LIBDIR/libcagedyn.so.$VERSION"
ln -s "libcagedyn.so.$VERSION" "$tree$LIBDIR/libcagedyn.so.0"
ln -s libcagedyn.so.0 "$tree$LIBDIR/libcagedyn.so"
put 644 "$BUILT/libcagedyn.a" "$LIBDIR/libcagedyn.a"
put 755 "$BUILT/cagedyn" "$PREFIX/bin/cagedyn"
${STRIP:-strip} "$tree$PREFIX/bin/cagedyn"
for file in cagedyn.h cagedyn.hpp cagedyn_analysis.hpp; do put 644 "include/$file" "$PREFIX/include/$file"; done
# The tool knows its commands itself.
"$BUILT/cagedyn" man --out "$tree/man"
for page in "$tree"/man/*.1; do put 644 "$page" "$PREFIX/share/man/man1/$(basename "$page")"; done
rm -r "$tree/man"
complete() {
    "$BUILT/cagedyn" completions "$1" > "$tree/completions"
    put 644 "$tree/completions" "$PREFIX/share/$2"
    rm "$tree/completions"
}
complete bash bash-completion/completions/cagedyn
complete zsh zsh/site-functions/_cagedyn
complete fish fish/vendor_completions.d/cagedyn.fish
for file in scenes/*.json schemas/*.json; do put 644 "$file" "$share/$file"; done
for file in matlab/cagedyn_mex.c matlab/Cagedyn*.m matlab/build_cagedyn.m; do put 644 "$file" "$share/$file"; done
doc=$PREFIX/share/doc/cagedyn
for file in LICENSE-MIT LICENSE-APACHE ./*.md docs/*.md docs/*/*.md docs/images/* docs/results/accuracy/* python/README.md \
    python/examples/*.py python/examples/rotor_ross/*.py python/notebooks/*.ipynb examples/*.c examples/*.h examples/*.cpp examples/*.py examples/*.m examples/*.jl; do
    put 644 "$file" "$doc/$file"
done
# Pages refer to these as in the source tree.
for folder in scenes schemas matlab; do ln -s "../../cagedyn/$folder" "$tree$doc/$folder"; done
mkdir "$tree$doc/include"
for file in cagedyn.h cagedyn.hpp cagedyn_analysis.hpp; do ln -s "../../../../include/$file" "$tree$doc/include/$file"; done
# Texts with the version in them, and the way from the libraries to the prefix.
up=$(realpath -ms --relative-to="$LIBDIR" "$PREFIX")
fill() {
    mkdir -p "$(dirname "$tree$2")"
    sed -e "s|@UP@|$up|" -e "s|@VERSION@|$VERSION|" "$1" > "$tree$2"
    chmod 644 "$tree$2"
}
fill tools/cagedyn.pc.in "$LIBDIR/pkgconfig/cagedyn.pc"
fill tools/cagedynConfig.cmake.in "$LIBDIR/cmake/cagedyn/cagedynConfig.cmake"
fill tools/cagedynConfigVersion.cmake.in "$LIBDIR/cmake/cagedyn/cagedynConfigVersion.cmake"
mapfile -t files < <(cd "$tree" && find . ! -type d | sed 's|^\.||' | sort)
printf '%s\n' "${files[@]}" > "$tree/list"
put 644 "$tree/list" "$share/installed"

# What could not all be copied is taken away again.
copied=()
undo() { for file in "${copied[@]}"; do rm -f "$DESTDIR$file"; done; }
trap 'undo; rm -rf "$tree"' ERR
for file in "${files[@]}" "$share/installed"; do
    mkdir -p "$(dirname "$DESTDIR$file")"
    copied+=("$file")
    cp -P --preserve=mode --remove-destination "$tree$file" "$DESTDIR$file"
done
echo "installed below $DESTDIR$PREFIX, libraries in $DESTDIR$LIBDIR"
