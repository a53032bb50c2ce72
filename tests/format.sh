#!/bin/sh
# usage: format.sh <clang-format>
set -eu
cd "$(dirname "$0")/.."
find core filter_massprops tests benchmarks sample_meshes \( -name '*.cpp' -o -name '*.h' \) \
  -exec "$1" --dry-run -Werror {} +
