cmake_minimum_required(VERSION 3.22)
# must(WHAT COMMAND...): runs a command, stops with its output if it fails, returns stdout in `output`.
function(must what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
    if(NOT status EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${what} failed (${status}): ${command}\n${out}\n${err}")
    endif()
    set(output "${out}" PARENT_SCOPE)
endfunction()

# The consumer says where the middle of a falling cloth is after 0.5 s: -g t^2 / 2 = -1.22625 m.
function(check_consumer text)
    if(NOT text MATCHES "^height -1\\.226[23] m, taut ${VERSION}\n$")
        message(FATAL_ERROR "the consumer printed: ${text}")
    endif()
endfunction()
