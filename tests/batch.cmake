# cmake -DOUT=batch.cpp -DROOT=tests "-DFILES=a_test.cpp|b_test.cpp" -P batch.cmake
# Writes OUT, which compiles the test files FILES (relative to ROOT) at once, each in a namespace of its own, so that
# helpers of one name do not meet. What they include stands before, at the top: inside a namespace those includes
# find their guards closed.
string(REPLACE "|" ";" files "${FILES}")
set(includes)
set(bodies)
set(number 0)
foreach(file IN LISTS files)
    file(STRINGS ${ROOT}/${file} lines REGEX "^#include ")
    get_filename_component(folder ${file} DIRECTORY)
    foreach(line IN LISTS lines) # beside the test, or found by the path of includes
        string(REGEX REPLACE "^#include |\"" "" header ${line})
        if(EXISTS ${ROOT}/${folder}/${header})
            set(line "#include \"${folder}/${header}\"")
        endif()
        list(APPEND includes "${line}")
    endforeach()
    string(APPEND bodies "namespace batch_${number} {\n#include \"${file}\"\n}\n")
    math(EXPR number "${number} + 1")
endforeach()
list(REMOVE_DUPLICATES includes)
list(JOIN includes "\n" includes)
file(WRITE ${OUT} "${includes}\n\n${bodies}")
