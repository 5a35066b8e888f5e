#!/usr/bin/env bash
# Runs a team of boats on one machine. Each boat is a process of its own; they exchange packets over MQTT through a
# broker that this script starts on the loopback. In the end all maps are compared. README.md explains the table.
#
#   bash examples/team/run.sh [--boats N] [--features N] [--steps N] [--seed N] [--loss SHARE] [--mode MODE]
#                             [--output FOLDER] [BOAT]
#
# BOAT is the built program; by default build/default/examples/team/boat. Exit status: 0 all maps agree, 77 there is no
# broker, anything else: an error.
set -euo pipefail
export LC_ALL=C  # awk and printf write numbers with a point

here=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
boats=3 features=10 steps=120 seed=1 loss=0.2 mode=joint output="" boat=""
agreement=1e-6  # m

fail() {
  printf 'run.sh: %s\n' "$*" >&2
  exit 1
}

while (($# > 0)); do
  case $1 in
    --boats | --features | --steps | --seed | --loss | --mode | --output)
      (($# > 1)) || fail "$1 takes a value"
      printf -v "${1#--}" '%s' "$2"
      shift 2
      ;;
    -*) fail "unknown option $1" ;;
    *)
      [[ -z $boat ]] || fail "there are two programs: $boat and $1; give one"
      boat=$1
      shift
      ;;
  esac
done
boat=${boat:-${here%/examples/team}/build/default/examples/team/boat}
[[ $boats =~ ^[1-9][0-9]?$ ]] || fail "--boats: $boats must be a number from 1 to 64"

# Debian installs the broker in a folder that only root has in its PATH.
PATH=$PATH:/usr/sbin:/usr/local/sbin
if ! command -v mosquitto >/dev/null; then
  echo "skipped: there is no MQTT broker here; on Debian install the package mosquitto"
  exit 77
fi
[[ -x $boat ]] || fail "$boat does not exist: install libmosquitto-dev and build the examples first"

work=$(mktemp -d "${TMPDIR:-/tmp}/cairn team.XXXXXX")
broker="" pids=()
cleanup() {
  local pid
  for pid in "${pids[@]}" $broker; do kill "$pid" 2>/dev/null || true; done
  wait || true
  rm -rf -- "$work"
}
trap cleanup EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# Only the broker can find out whether a port is free, so it tries one port after the other. `timeout` ends the broker
# even if this script is killed.
start_broker() {
  local attempt i
  for attempt in {1..20}; do
    port=$((20000 + RANDOM % 12000))  # below the ports of outgoing connections
    cat >"$work/mosquitto.conf" <<END
listener $port 127.0.0.1
allow_anonymous true
persistence false
set_tcp_nodelay true
max_queued_messages 0
log_dest stderr
END
    : >"$work/broker.log"
    timeout 300 mosquitto -c "$work/mosquitto.conf" 2>>"$work/broker.log" &
    broker=$!
    for ((i = 0; i < 100; ++i)); do
      if grep -q 'running$' "$work/broker.log"; then return 0; fi
      if ! kill -0 "$broker" 2>/dev/null; then break; fi
      sleep 0.05
    done
    kill "$broker" 2>/dev/null || true
    wait "$broker" || true
    broker=""
    grep -qi 'address already in use' "$work/broker.log" || break
  done
  cat "$work/broker.log" >&2
  fail "the broker does not start (attempt $attempt): see above"
}
start_broker

SECONDS=0
for ((i = 1; i <= boats; ++i)); do
  "$boat" "$i" "$boats" "$features" "$seed" "$steps" "$port" "$loss" "$work/boat_$i.csv" "$mode" &
  pids+=("$!")
done
bad=()
for ((i = 1; i <= boats; ++i)); do
  wait "${pids[i - 1]}" || bad+=("$i")
done
pids=()
((${#bad[@]} == 0)) || fail "these boats failed: ${bad[*]}"
took=$SECONDS

files=()
for ((i = 1; i <= boats; ++i)); do files+=("$work/boat_$i.csv"); done
if [[ -n $output ]]; then
  mkdir -p -- "$output"
  cp -- "${files[@]}" "$output/"
fi

printf '%d boats, %d steps each, %d features, seed %s, loss %s, mode %s: %d s\n\n' \
  "$boats" "$steps" "$features" "$seed" "$loss" "$mode" "$took"
# Only the joint filter gives all boats the same map. With extended observations each boat has a map of its own.
must_agree=0
if [[ $mode == joint ]]; then must_agree=1; fi
awk -F, -v must_agree="$must_agree" -v agreement="$agreement" '
  function abs(v) { return v < 0 ? -v : v }
  function sd(v) { return v > 0 ? sqrt(v) : 0 }
  function larger(a, b) { return a > b ? a : b }
  FNR == 1 { ++boat; count[boat] = 0 }
  $1 == "counter" { counter[boat, $2] = $3 }
  $1 == "landmark" {
    ++count[boat]
    error[boat] += ($3 - $8) ^ 2 + ($4 - $9) ^ 2
    if (boat == 1) {
      x[$2] = $3; y[$2] = $4; sx[$2] = sd($5); sy[$2] = sd($7)
    } else if (!($2 in x)) {
      if (must_agree) print "boat " boat " has landmark " $2 ", boat 1 does not have it"
      missing = 1
    } else {
      where[boat] = larger(where[boat], sqrt(($3 - x[$2]) ^ 2 + ($4 - y[$2]) ^ 2))
      trust[boat] = larger(trust[boat], larger(abs(sd($5) - sx[$2]), abs(sd($7) - sy[$2])))
    }
  }
  END {
    print "boat  published  resent  asked  dropped  delayed  doubled  repeated      used  features" \
      "  apart, m  sigma, m  error, m"
    for (b = 1; b <= boat; ++b) {
      printf "%4d  %9d  %6d  %5d  %7d  %7d  %7d  %8d  %8d  %8d  %8.2g  %8.2g  %8.2f\n", b, counter[b, "published"],
        counter[b, "resent"], counter[b, "requested"], counter[b, "dropped"], counter[b, "delayed"],
        counter[b, "doubled"], counter[b, "repeated"], counter[b, "taken"], count[b], where[b], trust[b],
        count[b] ? sqrt(error[b] / count[b]) : 0
      worst = larger(worst, larger(where[b], trust[b]))
      if (count[b] != count[1]) missing = 1
      if (counter[b, "lost"] + counter[b, "failed"] + counter[b, "refused"] > 0) {
        print "boat " b ": " counter[b, "lost"] " packets given up, " counter[b, "refused"] " refused, " \
          counter[b, "failed"] " not used"
        lacking = 1
      }
    }
    print ""
    if (lacking) { print "FAILED: a packet is not part of the map; every packet must be"; exit 1 }
    if (!must_agree) { print "In this mode every boat has a map of its own."; exit 0 }
    if (count[1] == 0) { print "FAILED: no landmark was mapped"; exit 1 }
    if (missing) { print "FAILED: the maps do not hold the same landmarks"; exit 1 }
    if (!(worst <= agreement)) {
      printf "FAILED: the maps differ by %.2g m, and %g m is allowed\n", worst, agreement
      exit 1
    }
    printf "All maps agree to %.2g m (%g m is allowed).\n", worst, agreement
  }' "${files[@]}"
