include(${CMAKE_CURRENT_LIST_DIR}/taut_elements.cmake)

# taut_check_kernels(KERNELS...): stops the configuration on two kernels of one stem, on a comparison that a kernel or a
# file that kernels include negates directly, and on a kernel without a test: tests/conformance/<stem>_test.cpp must
# exist; of a kernel that is compiled for elements, one a kernel, <stem>_<element>_test.cpp.
# tests/rules/kernel_rules.cmake plants such kernels.
function(taut_check_kernels)
    taut_check_comparisons()
    set(stems)
    foreach(kernel IN LISTS ARGN)
        cmake_path(GET kernel STEM stem)
        if(stem IN_LIST stems)
            message(FATAL_ERROR "two kernels are called ${stem}.comp: the stem must be unique")
        endif()
        list(APPEND stems ${stem})
        taut_elements_of(${kernel} elements)
        foreach(element IN LISTS elements)
            cmake_path(GET element STEM name)
            taut_check_kernel_test(${kernel} ${stem}_${name})
        endforeach()
        if(NOT DEFINED elements)
            taut_check_kernel_test(${kernel} ${stem})
        endif()
    endforeach()
endfunction()

# Drivers may take !(a <= b) for a > b (Mesa's OpenGL does), which differs where one is no number; IS_FINITE asks for that.
function(taut_check_comparisons)
    file(GLOB_RECURSE texts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/*.comp ${PROJECT_SOURCE_DIR}/kernels/*.glsl)
    set(balanced "([^()]|\\([^()]*\\))") # to three parentheses within
    set(balanced "([^()]|\\(${balanced}*\\))")
    set(balanced "([^()]|\\(${balanced}*\\))")
    foreach(text IN LISTS texts)
        file(STRINGS ${text} negated REGEX "^([^/]|/[^/])*! *\\(${balanced}*[<>]")
        if(negated)
            message(FATAL_ERROR "${text} negates a comparison, which drivers turn round without regard to NaN: ${negated}; "
                "write the opposite comparison, and IS_FINITE where NaN matters")
        endif()
    endforeach()
endfunction()

function(taut_check_kernel_test kernel stem)
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/tests/conformance/${stem}_test.cpp)
        message(FATAL_ERROR "${kernel} has no test: expected tests/conformance/${stem}_test.cpp")
    endif()
endfunction()

# taut_elements_of(KERNEL OUT): the elements, or shapes of colliders, that a kernel is compiled for, as files below
# kernels/; OUT is unset for one without a line "//! each element of METHOD" or "//! each collider".
function(taut_elements_of kernel out)
    unset(${out} PARENT_SCOPE)
    file(STRINGS ${kernel} each REGEX "^//! each ")
    if(NOT each)
        return()
    endif()
    file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/elements/*.glsl
         ${PROJECT_SOURCE_DIR}/kernels/colliders/*.glsl)
    set(elements)
    foreach(file IN LISTS files)
        taut_is_for(${kernel} ${file} wanted)
        if(wanted)
            cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/kernels)
            list(APPEND elements ${file})
        endif()
    endforeach()
    set(${out} "${elements}" PARENT_SCOPE)
endfunction()
