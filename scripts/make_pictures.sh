#!/usr/bin/env bash
# Makes the pictures of the documentation anew from the program's own clips. For developers: needs node, chromium, and
# three and playwright-core (npm install --no-save three playwright-core; $VIEW_MODULES says where node_modules are).
#
#   scripts/make_pictures.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/surefoot}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$program" author --default -o "$work/project" >/dev/null
clips=$work/project/clips
mkdir -p docs/images
node scripts/view_glb.mjs "$clips"/{walk,run,strafe_left}.glb docs/images/default_set.jpg \
  --views three --columns 8 --size 150 --span 1.95
node scripts/view_glb.mjs "$clips"/{idle,walk,jog,run,back,strafe_left,turn_left}.glb docs/images/contact_sheet.jpg \
  --views side,front --columns 8 --size 130 --span 1.95
# The fitted gaits, ground and stairs, and the walk's personalities and slopes.
fitted() { "$program" gait "$1" "${@:3}" -o "$work/fitted_$2.glb" 2>/dev/null; }
for name in walk jog run back strafe turn idle crouch; do fitted $name $name; done
node scripts/view_glb.mjs "$work"/fitted_{walk,jog,run,back,strafe,turn,idle,crouch}.glb docs/images/fitted_gaits.jpg \
  --views side,front --columns 8 --size 130 --span 1.95
fitted walk up --slope 15
fitted walk down --slope -15
for name in stairs_up stairs_down; do fitted $name $name; done
node scripts/view_glb.mjs "$work"/fitted_{stairs_up,stairs_down,up,down}.glb docs/images/fitted_climbs.jpg \
  --views side,front --columns 8 --size 130 --span 2.2 --floor off
for name in neutral tired proud sneaky drunk elderly; do fitted walk $name --speed 1 --personality $name; done
node scripts/view_glb.mjs "$work"/fitted_{neutral,tired,proud,sneaky,drunk,elderly}.glb docs/images/personalities.jpg \
  --views side,front --columns 8 --size 130 --span 1.95
# Gaits of expressions: the paper's model, what it leaves for later, and the poses of its figures 2 to 9.
gait() { "$program" gait "gaits/$1.gait" ${2:+--preset "$2"} -o "$work/$1${2:+_$2}.glb" >/dev/null; }
for preset in normal_walk crouch_walk limp jog run; do gait bhatti2017 "$preset"; done
node scripts/view_glb.mjs "$work"/bhatti2017_{normal_walk,crouch_walk,limp,jog,run}.glb docs/images/bhatti2017.jpg \
  --views side,front --columns 8 --size 130 --span 1.95
for name in jump cycling stairs climb; do gait "$name"; done
gait stairs down
node scripts/view_glb.mjs "$work"/{jump,cycling,stairs,stairs_down,climb}.glb docs/images/more_gaits.jpg \
  --views side,front --columns 8 --size 130 --span 2.2 --floor off
poses=(shoulder_height_0_6 shoulder_height_0_2 shoulder_height_0_807 shoulder_forward shoulder_back foot_ground_low
  foot_ground_high arm_low arm_high arm_front arm_back stride_height normal_walk crouch_walk)
files=()
for preset in "${poses[@]}"; do
  gait bhatti2017 "$preset"
  files+=("$work/bhatti2017_$preset.glb")
done
node scripts/view_glb.mjs "${files[@]}" docs/images/bhatti2017_poses.jpg \
  --views side --columns 6 --size 120 --span 1.95
# Templates side by side, to scale but for the giant, and what the skin does in deep bends.
down="LeftUpperArm:0,0,-72;RightUpperArm:0,0,72"
"$program" rig adult --fingers -o "$work/adult.glb"
for rig in child long_arms toe_walker; do "$program" rig "$rig" -o "$work/$rig.glb"; done
"$program" rig giant --stature 2.2 -o "$work/giant.glb"
node scripts/view_glb.mjs "$work"/{child,adult,long_arms,toe_walker,giant}.glb docs/images/rigs.jpg \
  --across --views three,side --size 300 --span 3 --follow off --turn "$down"
node scripts/view_glb.mjs "$work"/{adult,giant,toe_walker}.glb docs/images/rig_bends.jpg --across --views three,side \
  --size 400 --span 3 --follow off --turn "LeftUpperLeg:-95,0,0;LeftLowerLeg:120,0,0;RightUpperLeg:20,0,0;\
RightLowerLeg:60,0,0;LeftUpperArm:0,0,75;RightUpperArm:0,0,70;LeftLowerArm:0,-120,0;RightLowerArm:0,100,0;Spine:12,20,0"
# The figures 7 to 10 of the paper on foot placement, out of the page of `walk --all`. Exit code 1: some mark is missed.
"$program" author --synthetic -o "$work/biped" >/dev/null
"$program" walk "$work/biped" --all --course hills --path straight --speed 1.4 -o "$work/walks.html" >/dev/null || [ $? -eq 1 ]
node scripts/shoot_page.mjs "$work/walks.html" .papers docs/images/colvin_figures.png
# The studio (make studio; npm ci in tests/studio).
[ ! -f build/studio/index.html ] || node scripts/studio_pictures.mjs build/studio docs/images
ls -l docs/images
