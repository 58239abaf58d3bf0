#!/usr/bin/env bash
# Fills a folder with all that `make setup` would take from the internet, for machines without it:
#   bash tools/offline.sh FOLDER           # where there is internet: wheels and .deb files
#   bash tools/offline.sh FOLDER --wheels  # Python packages alone, where YADE is installed already
# and there, on the same release of Debian and the same kind of processor:
#   apt-get install -y --no-install-recommends FOLDER/debs/*.deb    # as root
#   PIP_NO_INDEX=1 PIP_FIND_LINKS=FOLDER/wheels make setup
set -euo pipefail
say() { printf 'offline: %s\n' "$*" >&2; }
[ $# -ge 1 ] || { say "expected a folder"; exit 1; }
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."

python=/usr/bin/python3
[ ! -x .venv/bin/python ] || python=.venv/bin/python
say "Python packages of requirements-all.lock"
mkdir -p "$folder/wheels"
# pip looks into what is no wheel with what builds it: the lock's setuptools, here as at the set-up
builds=$(mktemp -d)
trap 'rm -rf "$builds"' EXIT
$python -m venv "$builds"
pip() { "$builds/bin/pip" "$@" -q --disable-pip-version-check --require-hashes; }
sed -n '/^setuptools==/,/[^\\]$/p' requirements.lock > "$builds/builds.lock"
pip install -r "$builds/builds.lock"
pip download --no-deps --no-build-isolation --use-pep517 -r requirements-all.lock -d "$folder/wheels"
say "$(find "$folder/wheels" -type f | wc -l) files in $folder/wheels"
[ "${2:-}" != --wheels ] || exit 0

# as if nothing were installed, so that the folder serves a machine that has less than this one
say "YADE and what it needs, from Debian's packages"
mkdir -p "$folder/debs/partial"
: > "$folder/debs/.none"
apt-get install -qq -y --no-install-recommends --download-only \
  -o Dir::State::status="$folder/debs/.none" -o Dir::Cache::archives="$folder/debs" \
  -o Debug::NoLocking=1 yade python3 python3-venv make > /dev/null
rm -rf "$folder/debs/partial" "$folder/debs/.none" "$folder/debs/lock"
say "$(find "$folder/debs" -name '*.deb' | wc -l) files in $folder/debs"
