#!/bin/sh
# usage: run.sh <seconds>   fuzzes from the kept corpus, which stays as it is; going through that
# alone takes some minutes, and counts
#
# A finding is left in build/sanitize/fuzz/findings; run fuzz_mesh with that file as its only
# argument to see it again.
set -eu
cd "$(dirname "$0")/../.."
work=build/sanitize/fuzz/corpus
rm -rf "$work"
mkdir -p "$work" build/sanitize/fuzz/findings
# New inputs go into the first folder.
exec build/sanitize/tests/fuzz/fuzz_mesh "$work" tests/fuzz/corpus \
  -max_total_time="$1" -timeout=600 -rss_limit_mb=3000 -max_len=1024 -len_control=0 -print_final_stats=1 \
  -artifact_prefix=build/sanitize/fuzz/findings/
