#!/usr/bin/env bash
# Draws every picture of examples/README.md anew: `examples/gallery.sh [DIRECTORY]`, examples/pictures by default.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-examples/pictures}
mkdir -p "$out"
cargo build --quiet --release --locked --examples --features plot
programs=${CARGO_TARGET_DIR:-target}/release/examples

# NAME ARGUMENTS…: a picture that moves.
moving() {
  local name=$1
  shift
  "$programs/$name" animate --out "$out/$name.svg" "$@"
}
# NAME FILE ARGUMENTS…: a diagram.
diagram() {
  local name=$1 file=$2
  shift 2
  "$programs/$name" plot --out "$out/$file.svg" "$@"
}

moving four_bar --steps 60
moving slider_crank --steps 60
moving quick_return --steps 60
moving scotch_yoke --steps 60
moving peaucellier --to 6.2832 --steps 60
moving hart --to 6.2832 --steps 60
moving hoecken --steps 60
moving klann --steps 60
moving jansen --steps 48
moving pantograph --to 6.2832 --steps 90
moving scissor_lift --to 6.2832 --steps 30
moving planetary --to 5.236 --steps 60
# Of a car, but with a pinion that can be seen.
moving rack_and_pinion --to 0.25 --steps 40 --set r=0.032
moving cam --steps 60
moving cam_drive --from 0.2 --to 0.4 --steps 60
moving pump_jack --steps 60
moving toggle_press --steps 60
moving engine --steps 60
moving excavator --to 2 --steps 40 --input boom_length=1.30,0.5,-0.5,stick_length=1.98,-0.4,0.4,bucket_length=1.05,0.3,-0.3
moving robot_3rrr --to 1 --steps 60
moving robot_closures --to 1 --steps 60
moving wishbone --to 6.2832 --steps 40
moving squeezer --steps 60
moving car --to 6 --steps 60

diagram hoecken hoecken-curve T
diagram four_bar four_bar-curve tip --along-arc --set l1=0.25,l2=0.2
diagram quick_return quick_return-speed ram.x_dot
diagram cam_drive cam_drive-lift --from 0.2 --to 0.4 tappet.y tappet.y_ddot
diagram robot_3rrr robot_3rrr-motors --to 1 "crank[0].phi" "crank[1].phi" "crank[2].phi"
diagram wishbone wishbone-camber --to 6.2832 rise:camber

# The lecture's four-bar in the guide: a file, and the same as an address that rustdoc shows.
guide=kin-runtime/src/guide
"$programs/four_bar" animate --times 0 --names --out "$guide/four_bar.svg"
encoded=$(tr -d '\n' <"$guide/four_bar.svg" |
  sed 's/%/%25/g; s/#/%23/g; s/</%3C/g; s/>/%3E/g; s/"/%22/g; s/ /%20/g; s/(/%28/g; s/)/%29/g')
printf '[four-bar]: data:image/svg+xml,%s\n' "$encoded" >"$guide/four_bar.md"
