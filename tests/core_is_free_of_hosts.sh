#!/bin/sh
# The library serves any host: nothing in core/ includes a header of Qt or MeshLab.
cd "$(dirname "$0")/.." || exit 2
if grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"](Q|qt|common/|meshlab|GL/|filter_massprops/)' \
  --include='*.h' --include='*.cpp' core; then
  echo "core/ includes a host's header." >&2
  exit 1
fi
