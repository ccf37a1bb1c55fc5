#!/usr/bin/env bash
# A Debian package of what `make build` has built, in the folder that is given: library, headers, tool, scenes, schemas, docs.
#
#   BUILT=target/release VERSION=0.1.0 tools/deb.sh out
set -euo pipefail
out=$(mkdir -p "$1" && cd "$1" && pwd)
arch=$(dpkg --print-architecture)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

LIBDIR=/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
export BUILT VERSION LIBDIR PREFIX=/usr DESTDIR=$tree/cagedyn
tools/install_tree.sh > /dev/null
# dpkg knows itself what it has installed.
rm "$DESTDIR/usr/share/cagedyn/installed"
# Debian's zsh looks elsewhere, and its manual pages are compressed.
mkdir -p "$DESTDIR/usr/share/zsh/vendor-completions"
mv "$DESTDIR/usr/share/zsh/site-functions/_cagedyn" "$DESTDIR/usr/share/zsh/vendor-completions/"
rmdir "$DESTDIR/usr/share/zsh/site-functions"
gzip -9n "$DESTDIR"/usr/share/man/man1/*.1

# What the library and the tool need, by the tool that Debian has for it.
mkdir -p "$tree/debian" "$DESTDIR/DEBIAN"
printf 'Source: cagedyn\n\nPackage: cagedyn\nArchitecture: any\n' > "$tree/debian/control"
needs=$(cd "$tree" && dpkg-shlibdeps -O "cagedyn$LIBDIR/libcagedyn.so.$VERSION" cagedyn/usr/bin/cagedyn 2>/dev/null)
cat > "$DESTDIR/DEBIAN/control" <<END
Package: cagedyn
Version: $VERSION
Architecture: $arch
Maintainer: the authors of cagedyn <cagedyn@localhost>
Section: science
Priority: optional
Depends: ${needs#shlibs:Depends=}
Installed-Size: $(du -sk "$DESTDIR" | cut -f1)
Description: dynamics of the cage, rollers and rings of a rolling bearing
 Shared and static library with a C and C++ interface, pkg-config and CMake files, a command line tool, example scenes.
END
printf '#!/bin/sh\nldconfig\n' | tee "$DESTDIR/DEBIAN/postinst" > "$DESTDIR/DEBIAN/postrm"
chmod 755 "$DESTDIR/DEBIAN/postinst" "$DESTDIR/DEBIAN/postrm"
dpkg-deb --root-owner-group --build "$DESTDIR" "$out/cagedyn_${VERSION}_$arch.deb"
