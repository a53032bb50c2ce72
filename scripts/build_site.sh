#!/bin/sh
# Builds the site of all pages by mkdocs; a dead link is an error.
#
# usage: scripts/build_site.sh <folder>
set -eu
[ $# -eq 1 ] || { echo "usage: $0 <folder>" >&2; exit 2; }
mkdir -p "$1"
site=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."

# Pages lie beside the code and link to it: the site has a copy of all.
source=build/site-source
rm -rf "$source"
mkdir -p "$source"
find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print | while read -r file; do
  mkdir -p "$source/$(dirname "$file")"
  ln "$file" "$source/$file" 2>/dev/null || cp "$file" "$source/$file"
done
mkdocs build --quiet --strict --site-dir "$site"
echo "$site/index.html"
