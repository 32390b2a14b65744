# What Taut uses, all from the system. Package names: scripts in examples/packages.sh.

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE) # without a version: asked for 3.3, Eigen 5 says that it is another one
if(Eigen3_VERSION VERSION_LESS 3.3)
    message(FATAL_ERROR "Eigen ${Eigen3_VERSION} in ${Eigen3_DIR} is too old: 3.3 or later is needed")
endif()
find_package(nlohmann_json 3.2 REQUIRED)
find_package(CLI11 REQUIRED)
if(TAUT_BUILD_TESTS)
    find_package(assimp REQUIRED) # the second opinion on mesh files; the library reads them itself
endif()
find_package(Vulkan REQUIRED)

# Some distributions export glm without a namespace target.
if(NOT TARGET glm::glm)
    add_library(glm::glm INTERFACE IMPORTED)
    target_include_directories(glm::glm INTERFACE ${GLM_INCLUDE_DIRS})
endif()

# glslang and SPIRV-Tools: static libraries whose CMake files differ between releases, so by name.
find_path(TAUT_GLSLANG_INCLUDE glslang/Public/ShaderLang.h REQUIRED)
find_path(TAUT_SPIRV_INCLUDE spirv/unified1/spirv.hpp REQUIRED)
find_library(TAUT_SPIRV_TOOLS NAMES SPIRV-Tools SPIRV-Tools-shared REQUIRED)
set(taut_glslang_libraries)
foreach(name SPIRV glslang-default-resource-limits glslang MachineIndependent GenericCodeGen OSDependent OGLCompiler)
    find_library(TAUT_LIB_${name} NAMES ${name})
    if(TAUT_LIB_${name})
        list(APPEND taut_glslang_libraries ${TAUT_LIB_${name}})
    elseif(name STREQUAL "SPIRV" OR name STREQUAL "glslang")
        message(FATAL_ERROR "lib${name} not found: install glslang-dev (Debian, Ubuntu)")
    endif()
endforeach()
find_library(TAUT_SPIRV_TOOLS_OPT NAMES SPIRV-Tools-opt)
add_library(taut_deps_glslang INTERFACE)
target_include_directories(taut_deps_glslang SYSTEM INTERFACE ${TAUT_GLSLANG_INCLUDE})
target_link_libraries(taut_deps_glslang INTERFACE ${taut_glslang_libraries})
if(TAUT_SPIRV_TOOLS_OPT)
    target_link_libraries(taut_deps_glslang INTERFACE ${TAUT_SPIRV_TOOLS_OPT})
endif()
target_link_libraries(taut_deps_glslang INTERFACE ${TAUT_SPIRV_TOOLS} Threads::Threads)

# Vulkan through volk: headers and a loader that is opened at run time.
find_path(TAUT_VOLK_INCLUDE volk.h REQUIRED)
include(${CMAKE_CURRENT_LIST_DIR}/volk.cmake)
add_library(taut_deps_vulkan INTERFACE)
target_include_directories(taut_deps_vulkan SYSTEM INTERFACE ${Vulkan_INCLUDE_DIRS} ${TAUT_VOLK_INCLUDE})
target_compile_definitions(taut_deps_vulkan INTERFACE VK_NO_PROTOTYPES)
target_link_libraries(taut_deps_vulkan INTERFACE ${CMAKE_DL_LIBS})

if(TAUT_OPENGL)
    find_path(TAUT_EGL_INCLUDE EGL/egl.h)
    find_path(TAUT_GL_INCLUDE GL/glcorearb.h)
    if(NOT TAUT_EGL_INCLUDE OR NOT TAUT_GL_INCLUDE)
        message(WARNING "EGL/egl.h or GL/glcorearb.h not found: building without the OpenGL executor")
        set(TAUT_OPENGL OFF)
    else()
        add_library(taut_deps_opengl INTERFACE)
        target_include_directories(taut_deps_opengl SYSTEM INTERFACE ${TAUT_EGL_INCLUDE} ${TAUT_GL_INCLUDE})
        target_link_libraries(taut_deps_opengl INTERFACE ${CMAKE_DL_LIBS}) # libEGL is opened at run time
    endif()
endif()

# Files: JSON, meshes, PNG.
find_path(TAUT_STB_INCLUDE stb/stb_image_write.h REQUIRED)
add_library(taut_deps_files INTERFACE)
target_include_directories(taut_deps_files SYSTEM INTERFACE ${TAUT_STB_INCLUDE})
target_link_libraries(taut_deps_files INTERFACE nlohmann_json::nlohmann_json)

# Expat reads the XML of .vtu files; without it they are refused in words.
find_path(TAUT_EXPAT_INCLUDE expat.h)
find_library(TAUT_EXPAT NAMES expat)
if(TAUT_EXPAT_INCLUDE AND TAUT_EXPAT)
    target_include_directories(taut_deps_files SYSTEM INTERFACE ${TAUT_EXPAT_INCLUDE})
    target_link_libraries(taut_deps_files INTERFACE ${TAUT_EXPAT})
else()
    set(TAUT_EXPAT "")
    message(WARNING "expat.h or libexpat not found: building without .vtu (Debian, Ubuntu: libexpat1-dev)")
endif()

# Exact numbers for the judge: GMP and its header for C++ (gmpxx.h needs no second library here).
find_path(TAUT_GMP_INCLUDE gmpxx.h REQUIRED)
find_library(TAUT_GMP NAMES gmp REQUIRED)
add_library(taut_deps_exact INTERFACE)
target_include_directories(taut_deps_exact SYSTEM INTERFACE ${TAUT_GMP_INCLUDE})
target_link_libraries(taut_deps_exact INTERFACE ${TAUT_GMP})
