# `cmake --install`: the program, the library, its headers in the layout of the include root
# (taut/<module>/x.hpp), and what find_package(taut) and pkg-config need.

include(CMakePackageConfigHelpers)
set(taut_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/taut)

# ---------------------------------------------------------------- headers
# What a program may use, and nothing else: a header that is not here can change without notice. The test
# install_prefix compiles them (each alone in tests/matrix.sh headers).
set(taut_public_headers
    elements/element.hpp
    scene/scene.hpp scene/kinds.hpp scene/contact.hpp scene/fabric.hpp scene/fabric_readings.hpp scene/method_kind.hpp scene/options.hpp scene/settings.hpp scene/mesh.hpp scene/embed.hpp scene/embedding.hpp
    scene/frame_source.hpp scene/distance_field.hpp
    plan/plan.hpp plan/methods.hpp plan/topology.hpp plan/colouring.hpp plan/material.hpp plan/plate_hinges.hpp plan/solid.hpp plan/surface.hpp
    linear/sparse.hpp linear/matrix_market.hpp linear/check.hpp linear/format.hpp linear/grid.hpp linear/operator.hpp
    linear/device_matrix.hpp linear/stencil.hpp linear/preconditioner.hpp linear/aggregation.hpp linear/multigrid.hpp
    linear/cg.hpp linear/small.hpp linear/solve.hpp
    world/world.hpp world/program_moves.hpp world/program_motion.hpp world/mover.hpp world/hybrid.hpp world/sleep.hpp
    judge/judge.hpp judge/box_tree.hpp judge/mesh_distance.hpp judge/surface.hpp judge/distance.hpp judge/exact.hpp judge/linking.hpp judge/swept.hpp
    report/report.hpp report/energy_lost.hpp report/errors.hpp report/model.hpp report/picture.hpp report/continuum.hpp report/cost_contact.hpp report/cost.hpp
    report/compare.hpp report/volume.hpp report/ablation.hpp report/svg_plot.hpp report/time_series.hpp report/residuals.hpp
    report/gas.hpp report/energy_budget.hpp report/mover_paths.hpp report/soundness.hpp report/scene_budget.hpp
    report/soundness_watch.hpp)
foreach(header IN LISTS taut_public_headers)
    cmake_path(GET header PARENT_PATH module)
    install(FILES src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut/${module})
endforeach()
install(FILES src/taut/taut.hpp ${PROJECT_BINARY_DIR}/generated/taut/version.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut)
install(FILES runtime/device.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut/runtime)
# Of the graphics modules only what an engine needs to bring its own device, and what pictures are described by.
foreach(header compiler/compiler.hpp vulkan/vulkan_device.hpp vulkan/interop.hpp vulkan/draw.hpp)
    cmake_path(GET header PARENT_PATH module)
    install(FILES runtime/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut/runtime/${module})
endforeach()
install(DIRECTORY runtime/base/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut/runtime/base
        FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY ${taut_generated}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut/kernels
        FILES_MATCHING PATTERN "*.hpp")
install(FILES kernels/shared/layouts.h kernels/shared/portable.glsl
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut/kernels/shared)

# ---------------------------------------------------------------- elements of programs (taut_add_elements)
# The kernels' texts, and the headers with which they compile as C++: those cannot be included alone, so they
# stand beside the texts.
install(DIRECTORY kernels/shared kernels/elements kernels/methods DESTINATION ${CMAKE_INSTALL_DATADIR}/taut/kernels)
install(DIRECTORY runtime/cpu/ DESTINATION ${CMAKE_INSTALL_DATADIR}/taut/native/taut/runtime/cpu
        FILES_MATCHING PATTERN "*.hpp")
install(TARGETS taut-kernelc RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES cmake/taut_elements.cmake DESTINATION ${taut_cmake_dir})

# ---------------------------------------------------------------- library and program
install(TARGETS taut EXPORT taut-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET taut-cli)
    install(TARGETS taut-cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    # What the program itself says of scenes, for editors.
    set(taut_schema ${PROJECT_BINARY_DIR}/scene.schema.json)
    add_custom_command(OUTPUT ${taut_schema} COMMAND taut-cli schema > ${taut_schema} DEPENDS taut-cli VERBATIM)
    add_custom_target(taut_schema ALL DEPENDS ${taut_schema})
    install(FILES ${taut_schema} DESTINATION ${CMAKE_INSTALL_DATADIR}/taut)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(EXPORT taut-targets NAMESPACE taut:: DESTINATION ${taut_cmake_dir})

# A static library cannot hold the libraries under it, so a consumer links them too. The config file
# finds them again by name, in the order in which the linker needs them; a hint says where the build
# found them.
set(taut_link_names)
set(taut_link_folders)
foreach(library IN LISTS taut_glslang_libraries TAUT_SPIRV_TOOLS_OPT TAUT_SPIRV_TOOLS TAUT_EXPAT TAUT_GMP)
    if(library)
        cmake_path(GET library STEM LAST_ONLY stem)
        string(REGEX REPLACE "^lib" "" stem "${stem}")
        cmake_path(GET library PARENT_PATH folder)
        list(APPEND taut_link_names ${stem})
        list(APPEND taut_link_folders ${folder})
    endif()
endforeach()
list(REMOVE_DUPLICATES taut_link_folders)

configure_package_config_file(cmake/taut-config.cmake.in ${PROJECT_BINARY_DIR}/taut-config.cmake
                              INSTALL_DESTINATION ${taut_cmake_dir}
                              PATH_VARS CMAKE_INSTALL_BINDIR CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/taut-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/taut-config.cmake ${PROJECT_BINARY_DIR}/taut-config-version.cmake
        DESTINATION ${taut_cmake_dir})

# ---------------------------------------------------------------- pkg-config
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    set(taut_pc_prefix ${CMAKE_INSTALL_PREFIX})
    set(taut_pc_libdir ${CMAKE_INSTALL_LIBDIR})
else() # relative to the file itself, so that the tree can be moved
    file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
    string(REGEX REPLACE "/$" "" up "${up}")
    set(taut_pc_prefix "\${pcfiledir}/${up}")
    set(taut_pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
endif()
if(IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
    set(taut_pc_includedir ${CMAKE_INSTALL_INCLUDEDIR})
else()
    set(taut_pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
set(taut_pc_libs)
foreach(folder IN LISTS taut_link_folders)
    if(NOT folder IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES AND NOT folder MATCHES "^(/usr)?/lib")
        list(APPEND taut_pc_libs -L${folder})
    endif()
endforeach()
foreach(name IN LISTS taut_link_names)
    list(APPEND taut_pc_libs -l${name})
endforeach()
list(APPEND taut_pc_libs -pthread)
if(CMAKE_DL_LIBS)
    list(APPEND taut_pc_libs -l${CMAKE_DL_LIBS})
endif()
if(TAUT_SANITIZE)
    list(APPEND taut_pc_libs -fsanitize=${TAUT_SANITIZE})
endif()
list(JOIN taut_pc_libs " " taut_pc_libs)
configure_file(cmake/taut.pc.in ${PROJECT_BINARY_DIR}/taut.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/taut.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
