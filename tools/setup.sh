#!/usr/bin/env bash
# Installs what is missing and does nothing when nothing is: YADE from Debian's packages, and the
# locked Python packages in .venv.
#   bash tools/setup.sh       everything: also tests, linters, pages and the report's PDF
#   bash tools/setup.sh run   what runs need alone; the first command adds the rest later
# Interrupted, it starts over; in a folder that was moved or copied it installs anew; started
# twice, one waits for the other.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf 'setup: %s\n' "$*" >&2; }

case "${1:-all}" in
  run) lock=requirements.lock ;;
  all) lock=requirements-all.lock ;;
  *) say "'$1' is not known; expected run, or nothing"; exit 1 ;;
esac

python=/usr/bin/python3
packages=()
compgen -G '/usr/lib/*/yade*/py/yade/__init__.py' >/dev/null || [ -n "${YADE_PREFIX:-}" ] || packages+=(yade)
[ -x $python ] || packages+=(python3)
$python -c 'import ensurepip, venv' 2>/dev/null || packages+=(python3-venv)
if [ $lock = requirements-all.lock ]; then
  # the report's PDF; where YADE is Debian's its packages bring both
  compgen -G '/usr/lib/*/libpangoft2-1.0.so.0' >/dev/null || packages+=(libpangoft2-1.0-0)
  compgen -G '/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf' >/dev/null || packages+=(fonts-dejavu-core)
fi
if [ ${#packages[@]} -gt 0 ]; then
  command -v apt-get >/dev/null || { say "no apt-get here: install ${packages[*]} by hand, then run this again"; exit 1; }
  root=(); [ "$(id -u)" -eq 0 ] || root=(sudo)
  say "installing ${packages[*]} from Debian's packages"
  "${root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${root[@]}" apt-get install -y -qq --no-install-recommends "${packages[@]}" >/dev/null
fi

# one installation at a time: pip inherits the lock, so one that outlives a killed
# installation is waited for as well
exec 9<requirements.lock
if command -v flock >/dev/null; then
  flock -n 9 || { say "waiting for another installation in this folder"; flock 9; }
fi

# A stamp is written when all that it stands for is done, so an interrupted installation is
# repeated. It names the folder, since a virtual environment cannot be moved.
digest() { printf '%s %s' "$(cat "$@" pyproject.toml | sha256sum | cut -d' ' -f1)" "$PWD"; }
stamp=.venv/.installed      # what runs need
rest=.venv/.installed-rest  # and all the rest
wanted=$(digest requirements.lock)
wanted_rest=$(digest requirements.lock requirements-all.lock)
kept() { [ "$(cat "$1" 2>/dev/null)" = "$2" ]; }
! kept $stamp "$wanted" || [ $lock = requirements.lock ] || ! kept $rest "$wanted_rest" || exit 0
! kept $stamp "$wanted" || [ $lock = requirements-all.lock ] || exit 0

# what a link points to belongs to another folder, and would be changed
[ ! -L .venv ] || { say ".venv is a link to $(readlink .venv): remove it, then run this again"; exit 1; }
if ! kept $stamp "$wanted"; then
  $python -m venv --clear .venv
fi
# Python compiles a module when it is first imported; most of them never are
pip=".venv/bin/pip install -q --disable-pip-version-check --no-compile"
say "installing $(grep -c '^[a-z0-9].*==' $lock) Python packages into .venv"
if ! kept $stamp "$wanted"; then
  # what is no wheel is built with the lock's own setuptools, not with what the internet has today
  sed -n '/^setuptools==/,/[^\\]$/p' requirements.lock > .venv/builds.lock
  $pip --require-hashes -r .venv/builds.lock
fi
$pip --require-hashes --no-build-isolation --use-pep517 -r $lock
if ! kept $stamp "$wanted"; then
  $pip --no-deps --no-build-isolation --editable .
  # before Snakemake reads what --configfile names, in which it would run code (rocking/start.py)
  printf '#!%s\nimport sys\n\nfrom rocking.start import main\n\nif __name__ == "__main__":\n    sys.exit(main())\n' \
    "$PWD/.venv/bin/python" > .venv/bin/snakemake  # processes that it forks read this file too
  # Python's own compiling too, of what runs import: the environment may forbid Python to keep it
  .venv/bin/python -m compileall -q smdof yade_scripts workflow
fi
if [ $lock = requirements.lock ]; then
  say "compiling the loops of the main job: half a minute on two free cores, longer on a loaded machine"
else
  say "compiling the solvers: one to two minutes on two free cores, longer on a loaded machine"
fi
env -u PYTHONDONTWRITEBYTECODE .venv/bin/python -m rocking.compile_ahead "${1:-all}"
printf '%s' "$wanted" > $stamp
[ $lock = requirements.lock ] || printf '%s' "$wanted_rest" > $rest
