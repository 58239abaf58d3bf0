#!/usr/bin/env bash
# A real SLURM of one node on loopback, in a folder of its own, for tests.
#
#   tests/trials/slurm/node.sh up FOLDER     installs slurm-wlm and munge if missing, starts the daemons
#   tests/trials/slurm/node.sh down FOLDER   stops the daemons that were started there
#
# Needs root (or a container in which you are root). Uses its own key, sockets and ports. Its
# configuration is linked from /etc/slurm/slurm.conf, since SLURM does not pass SLURM_CONF on to
# jobs; on a machine that has a SLURM configured there it refuses to start.
set -euo pipefail
say() { printf 'slurm node: %s\n' "$*" >&2; }
[ $# -eq 2 ] || { say "usage: node.sh up|down FOLDER"; exit 2; }
action=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)

stop_one() { # pid file
  [ -s "$1" ] || return 0
  local pid
  pid=$(cat "$1")
  kill "$pid" 2>/dev/null || true
  for _ in $(seq 50); do kill -0 "$pid" 2>/dev/null || break; sleep 0.1; done
  rm -f "$1"
}

down() {
  stop_one "$folder/slurmd.pid"
  stop_one "$folder/slurmctld.pid"
  stop_one "$folder/munged.pid"
  [ "$(readlink /etc/slurm/slurm.conf 2>/dev/null)" != "$folder/slurm.conf" ] || rm -f /etc/slurm/slurm.conf
}

up() {
  [ "$(id -u)" -eq 0 ] || { say "needs root, to start slurmd"; exit 1; }
  missing=()
  command -v slurmctld >/dev/null && command -v slurmd >/dev/null || missing+=(slurm-wlm)
  command -v munged >/dev/null || missing+=(munge)
  if [ ${#missing[@]} -gt 0 ]; then
    say "installing ${missing[*]} from Debian's packages"
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
  fi
  down
  if [ -e /etc/slurm/slurm.conf ] || [ -L /etc/slurm/slurm.conf ]; then
    say "this machine has a SLURM configured in /etc/slurm/slurm.conf: not touching it"; exit 1
  fi
  mkdir -p /etc/slurm "$folder"/{state,spool,log,munge}
  chmod 755 "$folder" "$folder/munge"
  [ -s "$folder/munge/key" ] || (umask 077; head -c 128 /dev/urandom > "$folder/munge/key")
  munged --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/munged.pid" --log-file="$folder/log/munged.log" --seed-file="$folder/munge/seed"
  memory=$(awk '/MemTotal/ {print int($2 / 1024 * 0.9)}' /proc/meminfo)
  port=${SLURM_TEST_PORT:-27817}
  cat > "$folder/slurm.conf" <<CONF
ClusterName=loopback
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CryptoType=crypto/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.log
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
MinJobAge=300
KillWait=5
SchedulerParameters=sched_interval=2,batch_sched_delay=1
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$memory State=UNKNOWN
PartitionName=loopback Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  ln -s "$folder/slurm.conf" /etc/slurm/slurm.conf
  unset SLURM_CONF
  slurmctld -c
  slurmd
  for _ in $(seq 100); do
    state=$(sinfo -h -o %t 2>/dev/null || true)
    [ "$state" = idle ] && { say "up in $folder"; return 0; }
    sleep 0.2
  done
  say "the node did not become idle (state '${state:-none}'); see $folder/log"
  tail -5 "$folder"/log/*.log >&2
  down
  exit 1
}

case $action in
  up) up ;;
  down) down ;;
  *) say "usage: node.sh up|down FOLDER"; exit 2 ;;
esac
