#!/bin/sh
# Installs Debian packages, as root or through sudo, and says so.
set -eu
echo "installing with apt-get: $*"
as_root=""
[ "$(id -u)" = 0 ] || as_root="sudo"
$as_root apt-get update -qq
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq "$@"
