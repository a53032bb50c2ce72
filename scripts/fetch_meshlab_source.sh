#!/bin/sh
# Unpacks the sources of the installed MeshLab into <cache folder>/<version>, where its plugin headers
# and vcglib lie, and prints that path. Debian has no -dev package of MeshLab, and a plugin runs only in
# the version whose headers it was compiled with.
#
# usage: scripts/fetch_meshlab_source.sh <cache folder>
set -eu
[ $# -eq 1 ] || { echo "usage: $0 <cache folder>" >&2; exit 2; }
"$(dirname "$0")/fetch_debian_source.sh" meshlab "$1" || {
  echo "To use another MeshLab tree, configure with -DMESHLAB_SOURCE_DIR= and -DMESHLAB_LIBRARY=." >&2
  exit 1
}
