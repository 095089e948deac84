#!/usr/bin/env bash
# Makes the bundled gaits anew from the motion they are fitted to. For developers who have it: gaits/fitted/README.md
# says where it is from.
#
#   scripts/make_gaits.sh [PROGRAM] [MOTION_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/surefoot}
motion=${2:-${SUREFOOT_MOTION:-../shared/motion}}
takes=$motion/o3de_mocap_bvh
game_clips=$motion/ual1_locomotion_glb/UAL1_50clips_mannequin.glb
gaits=gaits/fitted
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fit() { "$program" fit "$@" >/dev/null; }
fit "$takes" --to default --family -o $gaits/human.json
fit "$takes" --to default --family --reverse --travel 180 --range 0.3,2 -o $gaits/back.json
fit "$takes" --to default --family --on-the-spot -o $gaits/turn.json
fit "$game_clips#Crouch_Fwd_Loop" --to default -o "$work/crouch.json"
fit "$work/crouch.json" --stretch 0.3,1.4 -o $gaits/crouch.json
fit "$game_clips#Idle_Loop" --to default -o "$work/idle.json"
fit "$work/idle.json" --shift-weight -o $gaits/idle.json
"$program" author --synthetic -o "$work/project" >/dev/null
for side in left right; do
  fit "$work/project/clips/strafe_$side.glb" -o "$work/strafe.json"
  fit "$work/strafe.json" --stretch 0.3,1.6 -o $gaits/strafe_$side.json
done
fit $gaits/human.json --stairs 0.17,0.28 -o $gaits/stairs_up.json
fit $gaits/human.json --stairs -0.17,0.28 -o $gaits/stairs_down.json
ls -l $gaits
