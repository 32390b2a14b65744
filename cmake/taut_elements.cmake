# Compiles kernels for elements: Taut's own build includes this, and so does find_package(taut), for
# taut_add_elements(). Needs taut_kernel_folder: kernels/ of the source tree, or where it was installed, with
# shared/, elements/ and methods/. Installed, the headers of native kernels stand in taut_native_folder.

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
if(TAUT_SANITIZE)
    # Optimised, since what lanes are made of is all inline: the file of a collider takes the compiler over two
    # minutes at -O0, and 3 s so. Reads and writes of buffers are checked here; arrays on the stack and undefined
    # arithmetic in the scalar form, which is made of the same text.
    list(APPEND taut_lanes_options -O1 -fno-sanitize=undefined $<$<CXX_COMPILER_ID:GNU>:--param=asan-stack=0>)
endif()
set(taut_lanes 0)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 8
   AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    set(taut_lanes 1)
endif()

# taut_generate_kernel(KERNEL STEM FOLDER OUT [ELEMENT]): OUT becomes the sources that are generated into FOLDER
# of one kernel, for one element where it has one; the target that compiles them must live in this directory.
function(taut_generate_kernel kernel stem folder out)
    set(outputs ${folder}/${stem}.hpp ${folder}/${stem}.cpp ${folder}/${stem}.native.cpp)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${kernel})
    set(read_by_both ${kernel})
    if(ARGN)
        cmake_path(ABSOLUTE_PATH ARGN BASE_DIRECTORY ${taut_kernel_folder} OUTPUT_VARIABLE element)
        list(APPEND read_by_both ${element})
    endif()
    file(STRINGS ${kernel} has_lanes REGEX "^//! lanes$")
    set(has_values)
    if(ARGN)
        file(STRINGS ${element} has_values REGEX "^//! collider .* values") # indexes with what it works out
    endif()
    if(has_lanes AND NOT has_values)
        list(APPEND outputs ${folder}/${stem}.lanes.cpp)
        set_source_files_properties(${folder}/${stem}.lanes.cpp PROPERTIES
            OBJECT_DEPENDS "${read_by_both}" COMPILE_OPTIONS "${taut_lanes_options}")
        if(NOT taut_lanes)
            set_source_files_properties(${folder}/${stem}.lanes.cpp PROPERTIES HEADER_FILE_ONLY ON)
        endif()
    endif()
    taut_touch(${outputs})
    file(GLOB included CONFIGURE_DEPENDS ${taut_kernel_folder}/shared/* ${taut_kernel_folder}/elements/*
         ${taut_kernel_folder}/colliders/*)
    add_custom_command(
        OUTPUT ${outputs}
        COMMAND taut-kernelc ${kernel} ${taut_kernel_folder} ${folder} ${ARGN}
        ${touch}
        DEPENDS taut-kernelc ${read_by_both} ${included}
        COMMENT "Kernel ${stem}"
        VERBATIM)
    # A program's precompiled headers are made with other options than these.
    set_source_files_properties(${folder}/${stem}.native.cpp ${folder}/${stem}.lanes.cpp PROPERTIES
        SKIP_PRECOMPILE_HEADERS ON)
    set_source_files_properties(${folder}/${stem}.native.cpp PROPERTIES
        OBJECT_DEPENDS "${read_by_both}" COMPILE_DEFINITIONS TAUT_LANES=${taut_lanes}
        COMPILE_OPTIONS "${taut_kernel_options}")
    set(${out} ${outputs} PARENT_SCOPE)
endfunction()

# taut_batch_kernels(OUT FOLDER SOURCES...): OUT becomes the sources of taut_generate_kernel with eight tables, and
# eight kernels of native code, in one file (TAUT_UNITY): most of what one takes to compile is what all include.
function(taut_batch_kernels out folder)
    set(sources ${ARGN})
    foreach(kind .native "")
        set(files ${sources})
        list(FILTER files INCLUDE REGEX "/[a-z0-9_]+${kind}\\.cpp$")
        list(LENGTH files count)
        set(number 0)
        while(number LESS count)
            list(SUBLIST files ${number} 8 some)
            set(batch ${folder}/batch_${number}${kind}.cpp)
            list(TRANSFORM some REPLACE ".+" "#include \"\\0\"" OUTPUT_VARIABLE lines)
            list(JOIN lines "\n" lines)
            file(CONFIGURE OUTPUT ${batch} CONTENT "// Generated. Do not edit.\n${lines}\n" @ONLY)
            set_source_files_properties(${some} PROPERTIES HEADER_FILE_ONLY ON)
            set_source_files_properties(${batch} PROPERTIES OBJECT_DEPENDS "${some}" SKIP_PRECOMPILE_HEADERS ON)
            if(kind)
                set_source_files_properties(${batch} PROPERTIES COMPILE_DEFINITIONS TAUT_LANES=${taut_lanes}
                    COMPILE_OPTIONS "${taut_kernel_options}")
            endif()
            list(APPEND sources ${batch})
            math(EXPR number "${number} + 8")
        endwhile()
    endforeach()
    set(${out} ${sources} PARENT_SCOPE)
endfunction()

# taut_add_elements(TARGET FILES FILE...): compiles the kernels of every method that an element's line
# "//! methods" names, and adds them to TARGET, which includes "taut/kernels/<element>.hpp" and hands
# kernels::<element>::all() to taut::add_element() (docs/how-to/add-an-element.md).
function(taut_add_elements target)
    cmake_parse_arguments(PARSE_ARGV 1 given "" "" "FILES")
    if(NOT given_FILES)
        message(FATAL_ERROR "taut_add_elements(${target}): expected FILES and at least one element")
    endif()
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_elements)
    file(MAKE_DIRECTORY ${folder}/taut/kernels)
    file(GLOB_RECURSE kernels CONFIGURE_DEPENDS ${taut_kernel_folder}/methods/*.comp)
    set(sources)
    foreach(file IN LISTS given_FILES)
        cmake_path(ABSOLUTE_PATH file NORMALIZE OUTPUT_VARIABLE path)
        if(NOT EXISTS ${path})
            message(FATAL_ERROR "taut_add_elements(${target}): there is no file ${path}")
        endif()
        cmake_path(GET path STEM element)
        set(stems)
        foreach(kernel IN LISTS kernels)
            taut_is_for(${kernel} ${path} wanted)
            if(wanted)
                cmake_path(GET kernel STEM stem)
                taut_generate_kernel(${kernel} ${stem}_${element} ${folder}/taut/kernels outputs ${path})
                list(APPEND sources ${outputs})
                list(APPEND stems ${stem}_${element})
            endif()
        endforeach()
        taut_list_kernels(${element} ${folder}/taut/kernels/${element}.hpp ${stems})
    endforeach()
    if(TAUT_UNITY)
        taut_batch_kernels(sources ${folder} ${sources})
    endif()
    target_sources(${target} PRIVATE ${sources})
    target_include_directories(${target} PRIVATE ${folder} ${taut_kernel_folder} ${taut_native_folder})
endfunction()

# taut_list_kernels(ELEMENT HEADER STEMS...): writes the header that names all kernels of an element.
function(taut_list_kernels element header)
    set(includes)
    set(calls)
    foreach(stem IN LISTS ARGN)
        string(APPEND includes "#include \"taut/kernels/${stem}.hpp\"\n")
        string(APPEND calls "${stem}::all(), ")
    endforeach()
    file(CONFIGURE OUTPUT ${header} @ONLY CONTENT "// Generated. Do not edit.
#pragma once
${includes}
#include <span>
#include <vector>

namespace taut::kernels::${element} {
inline std::vector<std::span<const KernelInfo>> all() { return {${calls}}; }
} // namespace taut::kernels::${element}
")
endfunction()

# taut_is_for(KERNEL FILE OUT): whether the kernel is compiled for the element in FILE: its line "//! each element
# of METHOD" names one of the element's line "//! methods". Kernels with a line "//! each collider" are compiled
# for the files with a line "//! collider", and with a line "//! each collider with faces" for those that say
# "faces" in it.
function(taut_is_for kernel file out)
    file(STRINGS ${kernel} method REGEX "^//! each element of ")
    file(STRINGS ${file} methods REGEX "^//! methods .*")
    file(STRINGS ${kernel} each_collider REGEX "^//! each collider$")
    file(STRINGS ${kernel} each_with_faces REGEX "^//! each collider with faces$")
    file(STRINGS ${file} collider REGEX "^//! collider ")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    string(REPLACE "//! each element of " "" method "${method}")
    set(${out} OFF PARENT_SCOPE)
    if((method AND "${methods} " MATCHES " ${method} ") OR (each_collider AND collider)
       OR (each_with_faces AND collider MATCHES " faces"))
        set(${out} ON PARENT_SCOPE)
    endif()
endfunction()
