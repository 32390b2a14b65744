cmake_minimum_required(VERSION 3.22)
# Sources stay readable: no line over 110 columns, no file over 400 lines; and tests compile with Catch2 2 and 3, whose
# Contains is of texts in the one and of lists in the other. Needs -DSOURCE; git lists the files where there is a checkout.
set(kWidest 110)
set(kLongest 400)
set(extensions "cpp|hpp|h|comp|glsl|vert|frag")
execute_process(COMMAND git -C ${SOURCE} ls-files kernels runtime src tests examples
                RESULT_VARIABLE status OUTPUT_VARIABLE listed ERROR_QUIET)
if(status EQUAL 0 AND listed)
    string(REGEX REPLACE "\n" ";" files "${listed}")
else()
    file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/kernels/* ${SOURCE}/runtime/* ${SOURCE}/src/*
         ${SOURCE}/tests/* ${SOURCE}/examples/*)
endif()

set(faults)
set(read 0)
foreach(file IN LISTS files)
    if(NOT file MATCHES "\\.(${extensions})$" OR NOT EXISTS ${SOURCE}/${file})
        continue()
    endif()
    math(EXPR read "${read} + 1")
    execute_process(COMMAND awk -v widest=${kWidest} -v longest=${kLongest}
        "length($0) > widest { print FNR \": \" length($0) \" columns\" } FILENAME !~ /support.catch/ && /Catch::(Matchers::)?Contains/ { print FNR \": Contains of Catch, not of support/catch.hpp\" } END { if (NR > longest) print NR \" lines\" }"
        ${SOURCE}/${file} OUTPUT_VARIABLE found RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "awk could not read ${file}")
    endif()
    if(found)
        string(REGEX REPLACE "([^\n]+)\n" "  ${file}: \\1\n" found "${found}")
        string(APPEND faults "${found}")
    endif()
endforeach()
if(read LESS 100)
    message(FATAL_ERROR "only ${read} sources found below ${SOURCE}")
endif()
if(faults)
    message(FATAL_ERROR "more than ${kWidest} columns or ${kLongest} lines, or what one Catch2 lacks:\n${faults}")
endif()
