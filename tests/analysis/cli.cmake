# The contract of `surefoot analyze`: exit codes, JSON that parses, the same bytes on any number of threads.
# Variables: PROGRAM, SCRATCH (a folder to write to), CLIPS (real clips, optional: without them a small BVH is made here).

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")

function(check what)
  if(NOT (${ARGN}))
    message(SEND_ERROR "failed: ${what}\n  exit code ${code}\n  ${err}")
  endif()
endfunction()

# run(THREADS ARGUMENTS...) sets code, out, err and said, the length of err
function(run threads)
  set(ENV{SUREFOOT_THREADS} ${threads})
  execute_process(COMMAND "${PROGRAM}" analyze ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
  string(LENGTH "${err}" said)
  foreach(name code out err said)
    set(${name} "${${name}}" PARENT_SCOPE)
  endforeach()
endfunction()

# A body of hips and two legs, which glides forward for three frames: enough for every key.
set(legs "")
set(side_x 0.1)
foreach(side Left Right)
  string(APPEND legs "JOINT ${side}UpLeg\n{\nOFFSET ${side_x} 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    "JOINT ${side}Leg\n{\nOFFSET 0 -0.45 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    "JOINT ${side}Foot\n{\nOFFSET 0 -0.42 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    "End Site\n{\nOFFSET 0 -0.05 0.2\n}\n}\n}\n}\n")
  set(side_x -0.1)
endforeach()
string(REPEAT " 0" 18 zeros)
set(bvh "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n"
  "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n${legs}}\nMOTION\nFrames: 3\n"
  "Frame Time: 0.0333333\n0 0.92 0 0 0 0${zeros}\n0 0.92 0.04 0 0 0${zeros}\n0 0.92 0.08 0 0 0${zeros}\n")
string(CONCAT bvh ${bvh})
file(WRITE "${SCRATCH}/glide.bvh" "${bvh}")
file(WRITE "${SCRATCH}/broken.bvh" "HIERARCHY\nROOT a\n{\n")
file(WRITE "${SCRATCH}/mixed/glide.bvh" "${bvh}")
file(WRITE "${SCRATCH}/mixed/broken.bvh" "HIERARCHY\nROOT a\n{\n")
file(MAKE_DIRECTORY "${SCRATCH}/empty")

run(1 --json "${SCRATCH}/glide.bvh")
check("a sound clip gives 0" code EQUAL 0)
string(JSON count LENGTH "${out}" clips)
check("one clip is listed" count EQUAL 1)
string(JSON count LENGTH "${out}" clips 0)
check("with the 24 keys of the contract" count EQUAL 24)
string(JSON name GET "${out}" clips 0 name)
check("named after its file" name STREQUAL "glide")
string(JSON frames GET "${out}" clips 0 frames)
check("of three frames" frames EQUAL 3)
string(JSON type TYPE "${out}" clips 0 speed_mps)
check("its speed is a number" type STREQUAL "NUMBER")
string(JSON type TYPE "${out}" clips 0 cadence_steps_min)
check("its cadence, which it does not have, is null" type STREQUAL "NULL")
string(JSON count LENGTH "${out}" failed)
check("nothing failed" count EQUAL 0)

run(1 "${SCRATCH}/glide.bvh")
check("the table gives 0" code EQUAL 0)
check("and names the clip" out MATCHES "glide")

run(1 --json "${SCRATCH}/mixed")
check("one unreadable clip of two gives 0" code EQUAL 0)
string(JSON count LENGTH "${out}" clips)
check("the other is listed" count EQUAL 1)
string(JSON file GET "${out}" failed 0 file)
check("and the failed one is named" file MATCHES "broken.bvh")
string(JSON error GET "${out}" failed 0 error)
check("with the reason" error MATCHES "ends inside its hierarchy")
check("which stands on standard error, too" err MATCHES "broken.bvh")

run(1 --json --strict "${SCRATCH}/mixed")
check("--strict gives 2 for it" code EQUAL 2)
string(JSON count LENGTH "${out}" clips)
check("but lists the other still" count EQUAL 1)

foreach(bad "${SCRATCH}/broken.bvh" "${SCRATCH}/missing.bvh" "${SCRATCH}/empty" "${SCRATCH}/glide.bvh#nothing")
  run(1 --json "${bad}")
  check("${bad} gives 2" code EQUAL 2)
  check("${bad} is explained on standard error" said GREATER 0)
endforeach()
foreach(misuse --no-such-flag "--role;nonsense=x;${SCRATCH}/glide.bvh" "--unit-scale;-1;${SCRATCH}/glide.bvh" "")
  run(1 ${misuse})
  check("'${misuse}' gives 2" code EQUAL 2)
  check("'${misuse}' is explained on standard error" said GREATER 0)
endforeach()

set(clips ${SCRATCH}/mixed ${SCRATCH}/glide.bvh ${CLIPS})
run(1 --json --cycles ${clips} --csv "${SCRATCH}/one.csv")
set(one "${out}")
run(8 --json --cycles ${clips} --csv "${SCRATCH}/eight.csv")
check("8 threads print the bytes that 1 prints" out STREQUAL one)
file(READ "${SCRATCH}/one.csv" one)
file(READ "${SCRATCH}/eight.csv" eight)
check("and write the same CSV" eight STREQUAL one)
check("which begins with the contract's keys" one MATCHES "^name,file,frames,fps,duration_s,joints,speed_mps,")
