# Verdicts of shaken grasps beside Bullet's, in double precision, where it is installed.
pkg_check_modules(BULLET64 QUIET IMPORTED_TARGET bullet-float64)
if(BULLET64_FOUND)
  add_executable(bench_verdicts bench/verdicts_bench.cpp bench/verdicts/grip_scene.cpp bench/verdicts/convex_pieces.cpp
                                bench/verdicts/bullet_grip.cpp)
  target_include_directories(bench_verdicts PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(bench_verdicts PRIVATE clench_geometry nlohmann_json::nlohmann_json PkgConfig::BULLET64)
endif()
