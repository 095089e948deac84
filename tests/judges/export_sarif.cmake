# Lints a project into OUT/sarif/good, and spoils a copy in OUT/sarif/bad. PROGRAM: surefoot.
file(REMOVE_RECURSE "${OUT}/sarif")
file(MAKE_DIRECTORY "${OUT}/sarif/bad")
execute_process(COMMAND "${PROGRAM}" author --default -o "${OUT}/sarif/a project" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
# Thresholds that make findings of the generated set, which is a clean one.
execute_process(COMMAND "${PROGRAM}" lint "${OUT}/sarif/a project" --sarif "${OUT}/sarif/good/lint.sarif"
                        --threshold too-close.distance=30 --threshold skating-clip.skate=0 --rule uncovered=error
                        --threshold acute-triangle.angle=50
                RESULT_VARIABLE result OUTPUT_QUIET)
if(NOT result EQUAL 1)
  message(FATAL_ERROR "lint: exit code ${result}")
endif()
file(READ "${OUT}/sarif/good/lint.sarif" text)
foreach(rule too-close skating-clip uncovered acute-triangle)
  if(NOT text MATCHES "\"ruleId\": \"${rule}\"")
    message(FATAL_ERROR "no finding of ${rule} in the report")
  endif()
endforeach()
string(REGEX REPLACE "(\"results\": .*)\"level\": \"error\"" "\\1\"level\": \"fatal\"" spoilt "${text}")
string(REGEX REPLACE "(.*)\"startLine\": [0-9]+" "\\1\"startLine\": 0" spoilt "${spoilt}")
file(WRITE "${OUT}/sarif/bad/spoilt.sarif" "${spoilt}")
