cmake_minimum_required(VERSION 3.22)
# Trees of a few files under WORK, configured with the rules of SOURCE/cmake: what must stop a configuration
# is planted in them. Needs -DSOURCE, -DWORK, -DGENERATOR.
file(REMOVE_RECURSE ${WORK})

# plant(FILE LINE): the file with that one line.
function(plant file line)
    file(WRITE ${WORK}/tree/${file} "${line}\n")
endfunction()

# tree(LINES): a project without a language.
function(tree lines)
    file(REMOVE_RECURSE ${WORK})
    plant(CMakeLists.txt "cmake_minimum_required(VERSION 3.22)\nproject(tiny LANGUAGES NONE)\n${lines}")
endfunction()

# Each runs a command and stops unless it ends as it must.
function(configure)
    execute_process(COMMAND ${CMAKE_COMMAND} -G "${GENERATOR}" -S ${WORK}/tree -B ${WORK}/out
                    RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
    set(status ${status} PARENT_SCOPE)
    set(text "${text}" PARENT_SCOPE)
endfunction()

function(must_pass what)
    configure()
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${what}: the configuration stopped:\n${text}")
    endif()
endfunction()

function(must_stop what words)
    configure()
    string(REGEX REPLACE "[ \n]+" " " flat "${text}") # CMake breaks long messages
    if(status EQUAL 0 OR NOT flat MATCHES "${words}")
        message(FATAL_ERROR "${what}: the configuration must stop and say \"${words}\"; it ended with "
                            "${status}:\n${text}")
    endif()
endfunction()
