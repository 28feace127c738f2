# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DREPORT=FILE.json -DPICTURES=FOLDER -P SayComparison.cmake
# Tells in plain words what `reflet-cli compare --json` measured and where the pictures are.

# A number of the report with one decimal, or words where methods agree exactly (null).
function(decibels method result)
    string(JSON value ERROR_VARIABLE problem GET "${report}" methods ${method} psnr)
    if(problem)
        message(FATAL_ERROR "${REPORT}: ${problem}")
    elseif(value STREQUAL "")
        set(value "identical")
    elseif(value MATCHES "^(-?[0-9]+)\\.([0-9])[0-9]*$")
        set(value "${CMAKE_MATCH_1}.${CMAKE_MATCH_2} dB")
    else()
        set(value "${value} dB")
    endif()
    set(${result} "${value}" PARENT_SCOPE)
endfunction()

function(say text)
    execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${text}")
endfunction()

file(READ ${REPORT} report)
decibels(mem mem)
decibels(blend blend)
decibels(nearest nearest)
file(GLOB pictures ${PICTURES}/*.png)
list(LENGTH pictures count)
if(count EQUAL 0)
    message(FATAL_ERROR "no picture was written to ${PICTURES}")
endif()

say("")
say("Pictures of the sample square, each with vehicles that reflect it:")
foreach(picture IN LISTS pictures)
    say("    ${picture}")
endforeach()
say("How close the reflections come to ray tracing (PSNR, more is better):")
say("    Reflet             ${mem}")
say("    plain blending     ${blend}")
say("    nearest probe      ${nearest}")
