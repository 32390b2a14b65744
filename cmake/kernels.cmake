# Compiles every kernels/**/*.comp into tables (SPIR-V, GLSL text, bindings) and native code.
# A kernel that glslang or spirv-val rejects stops the build; one that breaks cmake/kernel_rules.cmake stops
# the configuration.

include(${CMAKE_CURRENT_LIST_DIR}/kernel_rules.cmake)
file(GLOB_RECURSE taut_kernel_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/*.comp)
file(GLOB taut_element_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/elements/*.glsl)
file(GLOB taut_kernel_shared CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/shared/*)
list(APPEND taut_kernel_shared ${taut_element_files})
taut_check_kernels(${taut_kernel_files})
set(taut_generated ${PROJECT_BINARY_DIR}/generated/taut/kernels)
set(taut_kernel_sources)
set(taut_kernel_stems)

# taut-kernelc leaves files alone that would not change. Ninja takes that as up to date (restat); Make would
# run the command again in every build, so there `touch` is one more command.
macro(taut_touch)
    set(touch)
    if(NOT CMAKE_GENERATOR MATCHES "Ninja")
        set(touch COMMAND ${CMAKE_COMMAND} -E touch ${ARGN})
    endif()
endmacro()

# Kernels with a line "//! lanes" are compiled once more, several elements at a time, for processors that the
# program finds out about when it runs (docs/lanes.md). Bitwise equality between executors, and between the two,
# needs separate multiply and add, and no other liberties.
set(taut_kernel_level -O3)
if(TAUT_SANITIZE)
    set(taut_kernel_level -O0) # GCC optimises checked code of this length for many minutes a file
endif()
set(taut_kernel_options "$<$<CONFIG:Release,RelWithDebInfo>:${taut_kernel_level}>;$<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>;-ffp-contract=off;-fno-math-errno;-fno-trapping-math;-Wno-shadow;-Wno-conversion;-Wno-sign-conversion;-Wno-unused-parameter")
# Eight lanes fill the registers, and blocks are so long that the processor sees little more than one at a time:
# the order in which GCC leaves instructions matters more than elsewhere (docs/lanes.md).
set(taut_lanes_options "${taut_kernel_options};-mavx2;$<$<CXX_COMPILER_ID:GNU>:-fschedule-insns>")
set(taut_lanes 0)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 8
   AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    set(taut_lanes 1)
endif()

# taut_compile_kernel(KERNEL STEM [ELEMENT]): the generated sources of one kernel, of one element where it has one.
function(taut_compile_kernel kernel stem)
    set(outputs ${taut_generated}/${stem}.hpp ${taut_generated}/${stem}.cpp ${taut_generated}/${stem}.native.cpp)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${kernel})
    set(read_by_both ${kernel})
    if(ARGN)
        list(APPEND read_by_both ${PROJECT_SOURCE_DIR}/kernels/${ARGN})
    endif()
    file(STRINGS ${kernel} has_lanes REGEX "^//! lanes$")
    if(has_lanes)
        list(APPEND outputs ${taut_generated}/${stem}.lanes.cpp)
        set_source_files_properties(${taut_generated}/${stem}.lanes.cpp PROPERTIES
            OBJECT_DEPENDS "${read_by_both}" COMPILE_OPTIONS "${taut_lanes_options}")
        if(NOT taut_lanes)
            set_source_files_properties(${taut_generated}/${stem}.lanes.cpp PROPERTIES HEADER_FILE_ONLY ON)
        endif()
    endif()
    taut_touch(${outputs})
    add_custom_command(
        OUTPUT ${outputs}
        COMMAND taut-kernelc ${kernel} ${PROJECT_SOURCE_DIR}/kernels ${taut_generated} ${ARGN}
        ${touch}
        DEPENDS taut-kernelc ${kernel} ${taut_kernel_shared}
        COMMENT "Kernel ${stem}"
        VERBATIM)
    set_source_files_properties(${taut_generated}/${stem}.native.cpp PROPERTIES
        OBJECT_DEPENDS "${read_by_both}" COMPILE_DEFINITIONS TAUT_LANES=${taut_lanes}
        COMPILE_OPTIONS "${taut_kernel_options}")
    set(taut_kernel_stems ${taut_kernel_stems} ${stem} PARENT_SCOPE)
    set(taut_kernel_sources ${taut_kernel_sources} ${outputs} PARENT_SCOPE)
endfunction()

foreach(kernel IN LISTS taut_kernel_files)
    cmake_path(GET kernel STEM stem)
    taut_elements_of(${kernel} elements)
    foreach(element IN LISTS elements)
        taut_compile_kernel(${kernel} ${stem}_${element} elements/${element}.glsl)
    endforeach()
    if(NOT DEFINED elements)
        taut_compile_kernel(${kernel} ${stem})
    endif()
endforeach()

# The registry: find_kernel(name, variant, precision).
set(registry "// Generated. Do not edit.\n#include \"taut/runtime/base/registry.hpp\"\n#include \"taut/runtime/base/error.hpp\"\n#include <string>\n\nnamespace taut::kernels {\n")
foreach(stem IN LISTS taut_kernel_stems)
    string(APPEND registry "namespace ${stem} { std::span<const KernelInfo> all(); }\n")
endforeach()
string(APPEND registry "}\n\nnamespace taut {\n\nstd::vector<const KernelInfo*> all_kernels()\n{\n    std::vector<const KernelInfo*> out;\n")
foreach(stem IN LISTS taut_kernel_stems)
    string(APPEND registry "    for (const KernelInfo& k : kernels::${stem}::all()) out.push_back(&k);\n")
endforeach()
string(APPEND registry "    return out;\n}\n\n} // namespace taut\n")
file(CONFIGURE OUTPUT ${taut_generated}/registry.cpp CONTENT "${registry}" @ONLY)

taut_touch(${taut_generated}/builtin_includes.cpp)
add_custom_command(
    OUTPUT ${taut_generated}/builtin_includes.cpp
    COMMAND taut-kernelc --includes ${PROJECT_SOURCE_DIR}/kernels ${taut_generated}/builtin_includes.cpp
    ${touch}
    DEPENDS taut-kernelc ${taut_kernel_shared}
    VERBATIM)
