#!/usr/bin/env bash
# Makes assets/pictures/hemisphere.png: the hemisphere scene with three turbulence methods beside plain DFSPH, cut open
# and coloured by vorticity, with the kinetic energy that is left. Takes ten minutes on two cores; needs ImageMagick.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

build=${1:-build/release}
out=${2:-out/hemisphere_picture}
mkdir -p "$out"
sed -e 's|^  "camera":.*|  "camera": {"position": [1.6, 0.62, 2.75], "target": [1.6, 0.24, 0.6], "field_of_view": 27},|' \
  -e 's|^  "look":.*|  "look": {"colour_by": "vorticity", "colour_map": "magma", "range": [0, 12], "cut": {"axis": "z", "at": 0.62}, "background": "dark"}|' \
  assets/scenes/hemisphere.json >"$out/hemisphere.json"

panel() {
  local name=$1 label=$2
  shift 2
  "$build/curlew" run "$out/hemisphere.json" --time 5.4 --fps 5 --frames --size 960x300 --quiet --overwrite \
    --set energy.guard=false --out "$out/$name" "$@"
  local energy
  energy=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "kinetic") k = i } END { printf "%.0f", $k }' \
    "$out/$name/stats.csv")
  convert "$out/$name/frames/000027.png" -font DejaVu-Sans -pointsize 20 -fill white -annotate +16+44 "$label: $energy J" \
    "$out/$name.png"
}
panel plain "DFSPH" &
panel refined "vorticity refinement, alpha 1" --set vorticity_refinement.alpha=1
wait
panel spun "micropolar, nu_t 0.05" --set micropolar.nu_t=0.05 &
panel spun_more "micropolar, nu_t 0.2" --set micropolar.nu_t=0.2
wait
convert \( "$out/plain.png" "$out/refined.png" +append \) \( "$out/spun.png" "$out/spun_more.png" +append \) -append \
  "$out/hemisphere.png"
printf '%s\n' "$out/hemisphere.png"
