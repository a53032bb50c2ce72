#!/bin/sh
# Sets the machine up, builds, and runs every functional test. With --all everything: the benchmarks
# are built, the library's tests run under sanitizers, arbitrary data and random models for longer,
# and clang-tidy over the sources.
#
# usage: scripts/test.sh [--all] [ctest argument ...]
set -eu
cd "$(dirname "$0")/.."
if [ "${1:-}" = --all ]; then
  shift
  scripts/setup.sh --thorough
else
  scripts/setup.sh functional_tests
fi
exec ctest --preset release --parallel "$(nproc)" "$@"
