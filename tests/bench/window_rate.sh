#!/usr/bin/env bash
# How much of its rate the solver keeps while the window shows it: pairs of a run in a real window on a virtual screen
# and the same steps without one. Usage: window_rate.sh BUILD_FOLDER [PAIRS [SECONDS]]; needs xvfb and xdotool.
set -euo pipefail
build=$(realpath "$1") pairs=${2:-3} seconds=${3:-15}
export OMP_WAIT_POLICY=passive
folder=$(mktemp -d)
screen=
window=
clean_up() {
  [[ -z $window ]] || kill "$window" 2>/dev/null || true
  [[ -z $screen ]] || kill "$screen" 2>/dev/null || true
  rm -rf "$folder"
}
trap clean_up EXIT

places=$("$build/tests/gui_tests" "[.places]" | grep ^place)
click() {
  local place
  place=$(awk -v name="$1" '$6 == name { print int(($2 + $4) / 2), int(($3 + $5) / 2) }' <<<"$places")
  # shellcheck disable=SC2086
  xdotool mousemove $place sleep 0.4 mousedown 1 sleep 0.3 mouseup 1 sleep 1
}
for display in $(seq 90 120); do
  [[ ! -e /tmp/.X$display-lock ]] && break
done
Xvfb ":$display" -screen 0 1280x720x24 -nolisten tcp -noreset >/dev/null 2>&1 &
screen=$!
export DISPLAY=:$display
sleep 1

cd "$folder"
for pair in $(seq "$pairs"); do
  rm -rf out
  "$build/curlew" gui dam_break --particles 20k >/dev/null 2>&1 &
  window=$!
  id=
  for _ in $(seq 100); do
    id=$(xdotool search --name '^Curlew$' 2>/dev/null | head -n 1) && [[ -n $id ]] && break
    sleep 0.2
  done
  xdotool windowfocus "$id" sleep 3
  xdotool mousemove 700 20
  begin=$(date +%s.%N)
  xdotool key space sleep "$seconds" key space
  end=$(date +%s.%N)
  sleep 1
  click Energy.csv
  kill "$window"
  wait "$window" 2>/dev/null || true
  window=
  steps=$(($(wc -l <out/dam_break/energy_000.csv) - 1))
  "$build/curlew" run dam_break --particles 20k --steps "$steps" --out headless --overwrite --quiet
  awk -F, -v wall="$(awk "BEGIN { print $end - $begin }")" -v steps="$steps" -v pair="$pair" '
    NR == 1 { for (k = 1; k <= NF; ++k) if ($k == "ms_step") column = k; next }
    $1 > 0 { alone += $column / 1000 }
    END { if (!column || steps < 10 || alone <= 0) exit 1
          printf "%d: window %.1f steps/s, alone %.1f, share %.3f\n", pair, steps / wall, steps / alone, alone / wall }' \
    headless/stats.csv | tee -a shares
done
awk '{ print $NF }' shares | sort -n | awk '{ s[NR] = $1 } END { print "median share " s[int((NR + 1) / 2)] }'
