#!/usr/bin/env bash
# Long runs that must not creep: a tank at rest for a million steps, and a dam break of 3k particles with every model on
# for ten simulated minutes. Both must end well, with finite numbers, every particle inside, energy that does not rise,
# water that does not sink, and memory that does not grow. Writes a table. Takes half an hour on one core of its own.
#
# Usage: tests/bench/soak.sh [PROGRAM] [FOLDER]; SHARE=0.01 does a hundredth of both.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

program=${1:-build/release/curlew}
out=${2:-out/soak}
share=${SHARE:-1}
mkdir -p "$out"
failed=0

part() { awk -v whole="$1" -v share="$share" 'BEGIN { printf "%.12g", whole * share }'; }

# Resident kilobytes of a process at even intervals, as long as it runs.
watch_memory() {
  local pause memory
  pause=$(awk -v share="$share" 'BEGIN { print share < 0.1 ? 0.1 : 1 }')
  while memory=$(awk '/^VmRSS:/ { print $2 }' "/proc/$1/status" 2>/dev/null) && [[ -n $memory ]]; do
    echo "$memory"
    sleep "$pause"
  done
}

# What a table of stats says, in fifths of its rows; the rest energy is that of a block of water on the floor.
judge() {
  local stats=$1 memory=$2 rest=$3
  awk -F, -v rest="$rest" -v memory="$memory" '
    function complain(text) { printf "  FAILED: %s\n", text; bad = 1 }
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; columns = NF; next }
    {
      if (NF != columns) complain("line " NR " has " NF " cells of " columns)
      for (i = 1; i < NF; ++i) if ($i !~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/) complain("line " NR ", column " i " is " $i)
      row = NR - 1
      kinetic[row] = $at["kinetic"]; potential[row] = $at["potential"]; mechanical[row] = $at["mechanical"]
      if ($at["outside"] > 0) complain($at["outside"] " particles outside at " $at["time"] " s")
      if (row > 1 && $at["particles"] != particles) complain("particles went from " particles " to " $at["particles"])
      particles = $at["particles"]; step = $at["step"]; time = $at["time"]
    }
    END {
      for (k = 0; k < 5; ++k) {
        from = int(row * k / 5) + 1; to = int(row * (k + 1) / 5)
        for (i = from; i <= to; ++i) {
          calm[k] += kinetic[i] / (to - from + 1); energy[k] += mechanical[i] / (to - from + 1)
        }
      }
      highest = mechanical[1]; lowest = potential[1]; least = calm[0]
      for (i = 1; i <= row; ++i) {
        if (mechanical[i] > highest) highest = mechanical[i]
        if (potential[i] < lowest) lowest = potential[i]
      }
      for (k = 1; k < 4; ++k) if (calm[k] < least) least = calm[k]
      if (highest > 1.005 * mechanical[1]) complain("mechanical energy rose from " mechanical[1] " to " highest " J")
      for (k = 1; k < 5; ++k) if (energy[k] > 1.001 * energy[k - 1])
        complain("mechanical energy rose from " energy[k - 1] " to " energy[k] " J in fifth " k + 1)
      if (calm[4] > 1.5 * least) complain("kinetic energy rose from " least " to " calm[4] " J")
      if (lowest < 0.98 * rest) complain("potential energy fell to " lowest " J, at rest it is " rest)
      while ((getline line < memory) > 0) kilobytes[++samples] = line
      for (i = 1; i <= samples; ++i) {
        if (i <= samples / 2 && kilobytes[i] > first) first = kilobytes[i]
        if (kilobytes[i] > last) last = kilobytes[i]
      }
      if (samples < 8) complain("only " samples + 0 " samples of the memory")
      if (last > first + 1024) complain("memory rose from " first " to " last " kB in the second half")
      printf "  %d steps, %.5g s simulated, %d particles, %d rows\n", step, time, particles, row
      printf "  mechanical energy by fifths:"; for (k = 0; k < 5; ++k) printf " %.2f", energy[k]; print " J"
      printf "  kinetic energy by fifths:"; for (k = 0; k < 5; ++k) printf " %.3g", calm[k]; print " J"
      printf "  lowest potential energy %.2f J, at rest %.2f J\n", lowest, rest
      printf "  memory: %d kB at most in the first half, %d kB in all (%d samples)\n", first, last, samples
      exit bad
    }' "$stats"
}

# soak NAME REST_ENERGY SECONDS_BETWEEN_CHECKPOINTS WORD...
soak() {
  local name=$1 rest=$2 every=$3 process status=0 begin=$SECONDS
  shift 3
  "$program" run "$@" --threads 1 --stats=frame --checkpoint-every "$every" --quiet --overwrite --out "$out/$name" &
  process=$!
  watch_memory "$process" >"$out/$name.memory"
  wait "$process" || status=$?
  printf '%s: exit %d after %d s\n' "$name" "$status" $((SECONDS - begin))
  if [[ $status -ne 0 ]]; then failed=1; fi
  judge "$out/$name/stats.csv" "$out/$name.memory" "$rest" || failed=1
}

# 1000 kg of water: 1 m deep in the tank, 0.5 m on the floor of the dam break.
soak tank 4905 "$(part 500)" still_tank --particles 512 --steps "$(part 1000000)" --fps 2
soak dam_break 2452.5 "$(part 60)" dam_break --particles 3k --time "$(part 600)" --fps 10 \
  --set viscosity.nu=0.001 --set vorticity_refinement.alpha=1 --set micropolar.nu_t=0.1 --set micropolar.gamma=0.002 \
  --set vorticity_confinement.epsilon=0.05
exit "$failed"
