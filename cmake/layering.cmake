# Dependencies between modules (docs/design.md): which may include which. The configuration stops on
# an include that must not exist, and runs again when a file that it read has changed, so a wrong one
# never reaches a compiler. tests/rules/layering.cmake plants some.

function(taut_forbid folder pattern)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.hpp
         ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
    foreach(file IN LISTS files)
        file(STRINGS ${file} hits REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"](${pattern})")
        if(hits)
            message(FATAL_ERROR "${file} may not include: ${hits}\n(see docs/design.md)")
        endif()
    endforeach()
endfunction()

set(upper "taut/(scene|elements|plan|linear|world|judge|report|cli|taut)")
taut_forbid(runtime          "${upper}")
taut_forbid(runtime/base     "taut/runtime/(vulkan|opengl|cpu|compiler|device)|vulkan|volk|GL/|EGL/")
taut_forbid(runtime/cpu      "taut/runtime/(vulkan|opengl)|vulkan/|volk|GL/|EGL/")
taut_forbid(runtime/vulkan   "taut/runtime/(opengl|cpu)|GL/|EGL/")
taut_forbid(runtime/opengl   "taut/runtime/(vulkan|cpu)|vulkan/|volk")
taut_forbid(runtime/compiler "taut/runtime/(vulkan|opengl|cpu)|vulkan/|volk|GL/|EGL/")
taut_forbid(src              "vulkan/|volk|GL/|EGL/")
# scene knows of the runtime only its device-free values (runtime/base); plan also devices on paper.
taut_forbid(src/scene        "taut/(elements|plan|linear|world|judge|report|cli|taut|kernels)|taut/runtime/(device|cpu|vulkan|opengl|compiler)")
taut_forbid(src/elements     "taut/(scene|plan|linear|world|judge|report|cli|taut)|taut/runtime/(device|cpu|vulkan|opengl|compiler)")
taut_forbid(src/plan         "taut/(world|judge|report|cli|taut)|taut/runtime/(cpu|vulkan|opengl|compiler)")
taut_forbid(src/linear       "taut/(plan|world|judge|report|cli|taut)|taut/runtime/(cpu|vulkan|opengl)")
# The judge of what kernels did shares nothing with them: of scene it takes the readers of files.
taut_forbid(src/judge        "taut/(elements|plan|linear|world|report|cli|taut|kernels)|taut/runtime/(device|cpu|vulkan|opengl|compiler)")
# A world asks the judge whether its start is one that contact can hold.
taut_forbid(src/world        "taut/(report|cli)|taut/runtime/(cpu|opengl)")
taut_forbid(src/report       "taut/(cli)|taut/runtime/(cpu|opengl)")
# Every include is from the include root, so that the lines above see all of them.
taut_forbid(runtime          "[^>\"]*\\.\\./|\\./")
taut_forbid(src              "[^>\"]*\\.\\./|\\./")
