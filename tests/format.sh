#!/bin/sh
# usage: format.sh <clang-format>
set -eu
cd "$(dirname "$0")/.."
find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o \
  \( -name '*.cpp' -o -name '*.h' \) -exec "$1" --dry-run -Werror {} +
