# Wrench spaces compared with qhull.
add_executable(bench_quality bench/quality_bench.cpp bench/peer_qhull.cpp bench/report.cpp)
target_include_directories(bench_quality PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(bench_quality PRIVATE clench_grasp clench_motion clench_io nlohmann_json::nlohmann_json
                                            PkgConfig::QHULL_R)
add_test(NAME "bench: quality" COMMAND bench_quality --brief WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
