include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(REMOVE_RECURSE ${WORK}/find_package)
must("configuring" ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${WORK}/find_package -DCMAKE_PREFIX_PATH=${PREFIX}
     -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=Release)
must("building" ${CMAKE_COMMAND} --build ${WORK}/find_package)
must("running" ${WORK}/find_package/consumer)
check_consumer("${output}")

# 0.2 kg below a spring of s^4 / (2 a), a = 1e-3 m^4/J: s = (m g a / 2)^(1/3) = 0.09937 m.
must("running" ${WORK}/find_package/elements)
if(NOT output STREQUAL "height -1.0994 m, by hand -1.0994 m\n")
    message(FATAL_ERROR "the consumer with an element of its own printed: ${output}")
endif()
