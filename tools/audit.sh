#!/usr/bin/env bash
# Looks the locked packages up in the public list of known vulnerabilities. Optional: needs the
# internet, and puts pip-audit into a temporary environment of its own.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
.venv/bin/python -m venv "$folder"
"$folder/bin/pip" install -q --disable-pip-version-check pip-audit
"$folder/bin/pip-audit" --requirement requirements-all.lock --require-hashes --disable-pip
