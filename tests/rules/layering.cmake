# A forbidden include stops the configuration, also one that comes with an edit after it.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

# dependency(FILE INCLUDE): planted in a clean tree, it must stop the configuration.
function(dependency file included)
    tree("include(${SOURCE}/cmake/layering.cmake)")
    plant(${file} "#include ${included}")
    must_stop("${included} in ${file}" "may not include")
endfunction()

dependency(src/plan/a.cpp "\"taut/world/world.hpp\"")
dependency(src/scene/deep/a.hpp "\"taut/runtime/device.hpp\"")
dependency(src/scene/a.cpp "\"taut/taut.hpp\"")
dependency(src/world/a.cpp "<vulkan/vulkan.h>")
dependency(runtime/base/a.hpp "\"taut/runtime/device.hpp\"")
dependency(runtime/cpu/a.cpp "\"taut/runtime/vulkan/instance.hpp\"")
dependency(runtime/device.cpp "\"taut/scene/scene.hpp\"")
dependency(src/plan/a.cpp "\"../world/world.hpp\"")
dependency(src/plan/a.cpp "\"./../world/world.hpp\"")
dependency(runtime/cpu/a.cpp "\"taut/runtime/cpu/../vulkan/instance.hpp\"")

tree("include(${SOURCE}/cmake/layering.cmake)\nadd_custom_target(all_done ALL)")
plant(src/world/a.cpp "#include \"taut/plan/plan.hpp\"")
plant(src/plan/a.cpp "#include \"taut/scene/scene.hpp\"")
must_pass("allowed dependencies")
execute_process(COMMAND ${CMAKE_COMMAND} -E sleep 1.1) # Make compares whole seconds on some file systems
plant(src/plan/a.cpp "#include \"taut/world/world.hpp\"")
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/out RESULT_VARIABLE status OUTPUT_VARIABLE text
                ERROR_VARIABLE text)
string(REGEX REPLACE "[ \n]+" " " flat "${text}") # CMake wraps its messages where the path's length wants it
if(status EQUAL 0 OR NOT flat MATCHES "may not include")
    message(FATAL_ERROR "a build after an edit that plants a forbidden include ended with ${status}:\n${text}")
endif()
