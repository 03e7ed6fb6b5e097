# Pictures compared with bare OpenGL.
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
add_executable(bench_picture bench/picture_bench.cpp bench/peer_bare_gl.cpp bench/report.cpp)
target_include_directories(bench_picture PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(bench_picture PRIVATE clench_render clench_motion clench_io PkgConfig::EPOXY)
add_test(NAME "bench: picture" COMMAND bench_picture --brief WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
