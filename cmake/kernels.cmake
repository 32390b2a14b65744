# Compiles every kernels/**/*.comp into tables (SPIR-V, GLSL text, bindings) and native code.
# A kernel that glslang or spirv-val rejects stops the build; one that breaks cmake/kernel_rules.cmake stops
# the configuration.

include(${CMAKE_CURRENT_LIST_DIR}/kernel_rules.cmake)
file(GLOB_RECURSE taut_kernel_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/*.comp)
file(GLOB taut_element_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/elements/*.glsl
     ${PROJECT_SOURCE_DIR}/kernels/colliders/*.glsl)
file(GLOB taut_kernel_shared CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/shared/*)
list(APPEND taut_kernel_shared ${taut_element_files})
taut_check_kernels(${taut_kernel_files})
set(taut_generated ${PROJECT_BINARY_DIR}/generated/taut/kernels)
set(taut_kernel_sources)
set(taut_kernel_stems)

set(taut_kernel_folder ${PROJECT_SOURCE_DIR}/kernels)
# taut_compile_kernel(KERNEL STEM [ELEMENT]): one kernel of Taut's own.
macro(taut_compile_kernel kernel stem)
    taut_generate_kernel(${kernel} ${stem} ${taut_generated} outputs ${ARGN})
    list(APPEND taut_kernel_stems ${stem})
    list(APPEND taut_kernel_sources ${outputs})
endmacro()

foreach(kernel IN LISTS taut_kernel_files)
    cmake_path(GET kernel STEM stem)
    taut_elements_of(${kernel} elements)
    foreach(element IN LISTS elements)
        cmake_path(GET element STEM name)
        taut_compile_kernel(${kernel} ${stem}_${name} ${element})
        list(APPEND taut_kernels_of_${name} ${stem}_${name})
    endforeach()
    if(NOT DEFINED elements)
        taut_compile_kernel(${kernel} ${stem})
    endif()
endforeach()

# What an ElementKind of Taut's own is made of: kernels::<element>::all(), as for elements of programs.
file(MAKE_DIRECTORY ${taut_generated}/elements)
foreach(file IN LISTS taut_element_files)
    cmake_path(GET file STEM element)
    taut_list_kernels(${element} ${taut_generated}/elements/${element}.hpp ${taut_kernels_of_${element}})
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
