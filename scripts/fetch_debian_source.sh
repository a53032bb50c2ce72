#!/bin/sh
# Unpacks the sources of an installed Debian package into <cache folder>/<version> and prints that path.
#
# usage: scripts/fetch_debian_source.sh <package> <cache folder>
#
# The system's apt configuration stays as it is: a private list is derived from the entries that
# offer the installed version. Needs no root.
set -eu

[ $# -eq 2 ] || { echo "usage: $0 <package> <cache folder>" >&2; exit 2; }
package=$1

fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# One field of the installed package, for example `${source:Version}`.
installed() { dpkg-query -W -f "$1" "$package" 2>/dev/null; }

[ "$(installed '${db:Status-Status}')" = installed ] || fail "the package $package is not installed."
binary_version=$(installed '${Version}')
source_version=$(installed '${source:Version}')
source_package=$(installed '${source:Package}')

mkdir -p "$2"
cache=$(cd "$2" && pwd)
target=$cache/${source_version#*:} # colons are no good in the names of folders
if [ -f "$target/.complete" ]; then
  echo "$target"
  exit 0
fi
command -v dpkg-source >/dev/null || fail "dpkg-source is missing: install dpkg-dev."

# Base addresses of the repositories that offer the installed version.
repositories() {
  apt-cache madison "$package" |
    awk -F ' *[|] *' -v version="$binary_version" '
      $2 == version && $3 ~ / Packages$/ { split($3, field, " "); sub(/\/+$/, "", field[1]); print field[1] }' |
    sort -u
}

offering=$(repositories)
if [ -z "$offering" ]; then
  # Container images come without package lists.
  as_root=
  [ "$(id -u)" -eq 0 ] || as_root=sudo
  $as_root apt-get -qq update >&2 || true
  offering=$(repositories)
fi
[ -n "$offering" ] || fail "no repository of this system offers $package $binary_version."

work=$cache/.work-$$
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
mkdir -p "$work/sources" "$work/lists/partial" "$work/archives/partial" "$work/unpacked"

# The same entries with `deb` turned into `deb-src`; entries of other repositories are left out, as
# many of them have no sources.
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
  [ -f "$list" ] || continue
  awk -v offering="$offering" '
    BEGIN { count = split(offering, address, "\n") }
    $1 == "deb" {
      for (i = 1; i <= NF; ++i) {
        uri = $i
        sub(/\/+$/, "", uri)
        for (j = 1; j <= count; ++j)
          if (uri == address[j]) { sub(/deb/, "deb-src"); print; next }
      }
    }' "$list" >> "$work/sources/entries.list"
done
for list in /etc/apt/sources.list.d/*.sources; do
  [ -f "$list" ] || continue
  awk -v offering="$offering" '
    BEGIN { RS = ""; FS = "\n"; count = split(offering, address, "\n") }
    {
      binary = 0; wanted = 0; off = 0; stanza = ""; field = ""
      for (i = 1; i <= NF; ++i) {
        if ($i ~ /^#/) continue
        if ($i ~ /^[A-Za-z]/) { field = tolower($i); sub(/:.*/, "", field) }
        if (field == "types") {
          if ($i ~ /(^|[ \t:])deb([ \t]|$)/) binary = 1
          continue
        }
        # Restricts the entry to binary indices.
        if (field == "targets") continue
        if (field == "enabled" && tolower($i) ~ /(no|false|0)[ \t]*$/) off = 1
        if (field == "uris") {
          words = split($i, word, /[ \t]+/)
          for (k = 1; k <= words; ++k) {
            sub(/^[Uu][Rr][Ii][Ss]:/, "", word[k])
            sub(/\/+$/, "", word[k])
            for (j = 1; j <= count; ++j) if (word[k] == address[j]) wanted = 1
          }
        }
        stanza = stanza $i "\n"
      }
      if (binary && wanted && !off) printf "Types: deb-src\n%s\n", stanza
    }' "$list" >> "$work/sources/entries.sources"
done

private_apt() {
  set -- -qq \
    -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/sources" \
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work" -o Dir::Cache::Archives="$work/archives" \
    -o APT::Update::Post-Invoke-Success::= -o Acquire::Languages=none "$@"
  # The download user of root's apt may not enter private folders.
  [ "$(id -u)" -ne 0 ] || set -- -o APT::Sandbox::User=root "$@"
  apt-get "$@"
}

private_apt update >&2 || fail "the source lists of $(echo $offering) cannot be read."
(cd "$work" && private_apt source --only-source --download-only "$source_package=$source_version" >&2) ||
  fail "the source package $source_package $source_version cannot be had."
dpkg-source -q --no-check -x "$work"/*.dsc "$work/unpacked/tree" >&2
touch "$work/unpacked/tree/.complete"
rm -rf "$target"
mv "$work/unpacked/tree" "$target"
echo "$target"
