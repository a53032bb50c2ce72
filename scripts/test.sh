#!/bin/sh
# Sets the machine up, builds, and runs every test.
set -eu
cd "$(dirname "$0")/.."
scripts/setup.sh --sanitized
exec ctest --preset release --parallel "$(nproc)" "$@"
