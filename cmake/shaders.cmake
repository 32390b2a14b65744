# Compiles runtime/vulkan/shaders/*.vert and *.frag into one header of SPIR-V words, for the pictures.

add_executable(taut-shaderc runtime/compiler/shaderc.cpp)
target_include_directories(taut-shaderc SYSTEM PRIVATE ${TAUT_SPIRV_INCLUDE})
target_link_libraries(taut-shaderc PRIVATE taut_flags taut_deps_glslang)

set(taut_shader_folder ${PROJECT_SOURCE_DIR}/runtime/vulkan/shaders)
file(GLOB taut_shaders CONFIGURE_DEPENDS ${taut_shader_folder}/*.vert ${taut_shader_folder}/*.frag)
file(GLOB taut_shader_includes CONFIGURE_DEPENDS ${taut_shader_folder}/*.glsl)
set(taut_shader_header ${PROJECT_BINARY_DIR}/generated/taut/shaders.hpp)
add_custom_command(
    OUTPUT ${taut_shader_header}
    COMMAND taut-shaderc ${taut_shader_header} ${taut_shaders}
    DEPENDS taut-shaderc ${taut_shaders} ${taut_shader_includes}
    COMMENT "Shaders of the pictures"
    VERBATIM)
