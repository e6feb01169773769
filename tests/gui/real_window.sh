#!/usr/bin/env bash
# A real window on a virtual screen: xdotool moves mouse and keys as a person would, and files say what came of it.
# Usage: real_window.sh CURLEW GUI_TESTS RESET_ONCE. Exit code 77: xvfb or xdotool is missing, nothing was tested.
set -euo pipefail
curlew=$1 gui_tests=$2 reset_once=$3
for tool in Xvfb xdotool; do
  command -v $tool >/dev/null || {
    echo "no $tool here: not tested"
    exit 77
  }
done

folder=$(mktemp -d)
screen=
window=
# shellcheck disable=SC2317
clean_up() {
  [[ -z $window ]] || kill "$window" 2>/dev/null || true
  [[ -z $screen ]] || kill "$screen" 2>/dev/null || true
  rm -rf "$folder"
}
trap clean_up EXIT
fail() {
  echo "FAILED: $*" >&2
  cat "$folder/window.log" >&2
  exit 1
}

places=$("$gui_tests" "[.places]" | grep ^place)
# middle WIDGET [SHARE]: the pixel at a share of the widget's width, half its height.
at() {
  awk -v name="$1" -v share="${2:-0.5}" '
    { widget = $6; for (k = 7; k <= NF; ++k) widget = widget " " $k }
    widget == name { printf "%d %d\n", $2 + share * ($4 - $2), ($3 + $5) / 2; found = 1 }
    END { exit !found }' <<<"$places"
}
click() {
  local place
  place=$(at "$1") || fail "no widget $1"
  # shellcheck disable=SC2086
  xdotool mousemove $place sleep 0.4 mousedown 1 sleep 0.3 mouseup 1 sleep 0.5
}
# wait_for FILE: the first file of that pattern, within 20 s.
wait_for() {
  local k
  for k in $(seq 100); do
    compgen -G "$folder/$1" | head -n 1 && return
    sleep 0.2
  done
  fail "$1 did not come"
}

for display in $(seq 90 120); do
  [[ ! -e /tmp/.X$display-lock ]] && break
done
Xvfb ":$display" -screen 0 1280x720x24 -nolisten tcp -noreset >/dev/null 2>&1 &
screen=$!
export DISPLAY=:$display
for _ in $(seq 50); do
  xdotool getdisplaygeometry >/dev/null 2>&1 && break
  sleep 0.1
done

cd "$folder"
CURLEW_RESET_FILE=$folder/reset LD_PRELOAD=$reset_once "$curlew" gui dam_break_2d >"$folder/window.log" 2>&1 &
window=$!
focus_window() {
  local id
  for _ in $(seq 100); do
    id=$(xdotool search --name '^Curlew$' 2>/dev/null | head -n 1) && [[ -n $id ]] && break
    sleep 0.2
  done
  [[ -n $id ]] || fail "no window came"
  # A window that is not yet on the screen cannot have the focus.
  for _ in $(seq 50); do
    xdotool windowfocus "$id" 2>/dev/null && return
    sleep 0.2
  done
  fail "the window takes no focus"
}
focus_window
sleep 2

# A slider that is dragged reaches the solver: the checkpoint of its state says so.
# shellcheck disable=SC2046
xdotool mousemove $(at viscosity.nu 0.05) sleep 0.4 mousedown 1 sleep 0.3 mousemove $(at viscosity.nu 0.5) sleep 0.4 mouseup 1 sleep 0.4
click step
click step
click Checkpoint
state=$(wait_for 'out/dam_break_2d/checkpoint_000.curlew')
nu=$(grep -a -o '"viscosity.nu": *[0-9.e-]*' "$state" | grep -o '[0-9.e-]*$')
awk -v nu="$nu" 'BEGIN { exit !(nu > 0.02 && nu < 0.03) }' || fail "the solver reads nu = $nu, expected about 0.025"

# It runs, and pauses.
xdotool key space sleep 2 key space sleep 0.5
click Energy.csv
rows=$(wc -l <"$(wait_for 'out/dam_break_2d/energy_000.csv')")
[[ $rows -gt 10 ]] || fail "only $rows rows after two seconds of playing"

# What a slider does to a run is in its figures: dt falls with the Courant number, whose slider is at the end of the list.
click 'show plots'
xdotool mousemove 70 300 sleep 0.3 click --repeat 100 --delay 10 5 sleep 0.5
# shellcheck disable=SC2046
xdotool mousemove $(at time.cfl 0.4) sleep 0.4 mousedown 1 sleep 0.3 mousemove $(at time.cfl 0.02) sleep 0.4 mouseup 1 sleep 0.5
xdotool mousemove 70 300 sleep 0.3 click --repeat 100 --delay 10 4 sleep 0.5
click step
click 'show plots'
click 'Time step.csv'
steps=$(wait_for 'out/dam_break_2d/time_step_000.csv')
awk -F, '{ before = last; last = $3 } END { exit !(last < 0.5 * before) }' "$steps" ||
  fail "dt does not follow time.cfl: $(tail -n 2 "$steps")"
xdotool keydown ctrl key z keyup ctrl sleep 0.3
click step
click step
click 'Time step.csv'
steps=$(wait_for 'out/dam_break_2d/time_step_001.csv')
awk -F, '{ before = last; last = $3 } END { exit !(last > before) }' "$steps" || fail "Ctrl-Z did not take time.cfl back"

# Pictures of the water and of the window.
click Picture
wait_for 'out/dam_break_2d/picture_000.png' >/dev/null
click Window
wait_for 'out/dam_break_2d/window_000.png' >/dev/null

# A film.
if command -v ffprobe >/dev/null; then
  click Film
  xdotool key space sleep 4 key space sleep 0.5
  click Film
  film=$(wait_for 'out/dam_break_2d/film_000.mp4')
  frames=$(ffprobe -v error -count_packets -show_entries stream=nb_read_packets -of csv=p=0 "$film" | tr -d ,)
  [[ $frames -gt 5 ]] || fail "the film has $frames frames"
fi

# The same as pictures.
click Frames
xdotool key space sleep 2 key space sleep 0.5
click Film
wait_for 'out/dam_break_2d/frames_000/000001.png' >/dev/null

# The driver loses what it held: a new window comes, the run is the same, and the film that was under way is written.
if command -v ffprobe >/dev/null; then
  click Film
  xdotool key space sleep 2 key space sleep 0.5
fi
click Checkpoint
before=$(wait_for 'out/dam_break_2d/checkpoint_001.curlew')
touch reset
for _ in $(seq 50); do
  grep -q "driver was reset" window.log && break
  sleep 0.2
done
grep -q "driver was reset" window.log || fail "nobody noticed that the driver was reset"
sleep 1
focus_window
sleep 1
click Checkpoint
sleep 1
after=$(ls -t "$folder"/out/dam_break_2d/checkpoint_*.curlew | head -n 1)
[[ $after != "$before" ]] || fail "no checkpoint after the reset"
cmp -s "$before" "$after" || fail "the run after the reset is another one"
! command -v ffprobe >/dev/null || wait_for 'out/dam_break_2d/film_001.mp4' >/dev/null

# From the start, and to the same bits as without a window.
click reset
sleep 1
for _ in 1 2 3; do click step; done
click Checkpoint
sleep 1
state=$(ls -t "$folder"/out/dam_break_2d/checkpoint_*.curlew | head -n 1)
"$curlew" run --resume "$state" --steps 5 --out a --quiet
nu=$(grep -a -o '"viscosity.nu": *[0-9.e-]*' "$state" | grep -o '[0-9.e-]*$')
cfl=$(grep -a -o '"time.cfl": *[0-9.e-]*' "$state" | grep -o '[0-9.e-]*$')
"$curlew" run dam_break_2d --set viscosity.nu="$nu" --set time.cfl="$cfl" --steps 5 --out b --quiet
hash_of() { tail -n 1 "$1/stats.csv" | sed 's/.*,//'; }
[[ -n $(hash_of a) && $(hash_of a) == "$(hash_of b)" ]] || fail "the window's run ends with another hash: $(hash_of a) $(hash_of b)"

# Another scene.
click scene
click 'scene free_fall'
sleep 1.5
click Picture
wait_for 'out/free_fall/picture_000.png' >/dev/null

xdotool keydown ctrl key q keyup ctrl
for _ in $(seq 50); do
  kill -0 "$window" 2>/dev/null || break
  sleep 0.1
done
kill -0 "$window" 2>/dev/null && fail "Ctrl-Q did not close the window"
wait "$window" || fail "the window ended with code $?"
window=
[[ -z ${KEEP:-} ]] || cp -r out "$KEEP"
echo "a real window obeyed mouse and keys"
