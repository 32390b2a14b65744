# A kernel without a test and a second kernel of the same stem stop the configuration.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

tree("include(${SOURCE}/cmake/kernel_rules.cmake)\nfile(GLOB_RECURSE kernels kernels/*.comp)\ntaut_check_kernels(\${kernels})")
plant(kernels/step/wind.comp "// text")
must_stop("a kernel without a test" "wind.comp has no test: expected tests/conformance/wind_test.cpp")
plant(tests/conformance/wind_test.cpp "// test")
must_pass("a kernel with its test")
plant(kernels/collide/wind.comp "// text")
must_stop("two kernels of one stem" "two kernels are called wind.comp")
