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
    while read -r file; do rm -f "$DESTDIR$file"; done < "$list"
    rm -f "$list"
    find "$DESTDIR$share" "$DESTDIR$PREFIX/share/doc/cagedyn" -depth -type d -empty -delete
    exit 0
fi

for file in libcagedyn.so libcagedyn.a cagedyn; do
    [ -e "$BUILT/$file" ] || { echo "$BUILT/$file is missing: run 'make build' first, as the user who builds" >&2; exit 1; }
done

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
put() { install -D -m "$1" "$2" "$tree$3"; }

put 755 "$BUILT/libcagedyn.so" "$LIBDIR/libcagedyn.so.$VERSION"
ln -s "libcagedyn.so.$VERSION" "$tree$LIBDIR/libcagedyn.so.0"
ln -s libcagedyn.so.0 "$tree$LIBDIR/libcagedyn.so"
put 644 "$BUILT/libcagedyn.a" "$LIBDIR/libcagedyn.a"
put 755 "$BUILT/cagedyn" "$PREFIX/bin/cagedyn"
put 644 include/cagedyn.h "$PREFIX/include/cagedyn.h"
for file in scenes/*.json schemas/*.json; do put 644 "$file" "$share/$file"; done
for file in LICENSE-MIT LICENSE-APACHE README.md; do put 644 "$file" "$PREFIX/share/doc/cagedyn/$file"; done
mkdir -p "$tree$LIBDIR/pkgconfig"
sed -e "s|@PREFIX@|$PREFIX|" -e "s|@LIBDIR@|$LIBDIR|" -e "s|@VERSION@|$VERSION|" tools/cagedyn.pc.in \
    > "$tree$LIBDIR/pkgconfig/cagedyn.pc"
chmod 644 "$tree$LIBDIR/pkgconfig/cagedyn.pc"
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
