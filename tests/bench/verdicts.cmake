# Verdicts of shaken grasps on convex pieces, compared with Bullet's in double precision, if it is installed.
pkg_check_modules(BULLET64 QUIET IMPORTED_TARGET bullet-float64)
if(BULLET64_FOUND)
  add_executable(bench_verdicts bench/verdicts_bench.cpp bench/verdicts/grip_scene.cpp bench/verdicts/convex_pieces.cpp
                                bench/verdicts/grip_test.cpp bench/verdicts/our_grip.cpp bench/verdicts/bullet_grip.cpp)
  target_include_directories(bench_verdicts PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(bench_verdicts PRIVATE clench_dynamics nlohmann_json::nlohmann_json PkgConfig::BULLET64)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/verdicts)
  file(MAKE_DIRECTORY ${folder})
  add_test(NAME "bench: verdicts are written" COMMAND clench_app -q run tests/bench/verdicts.lua ${folder} brief WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  add_test(NAME "bench: verdicts" COMMAND bench_verdicts --bullet --limit 1 --brief ${folder}/brief_parallel_jaw_cube.json)
  set_tests_properties("bench: verdicts are written" PROPERTIES FIXTURES_SETUP verdicts)
  set_tests_properties("bench: verdicts" PROPERTIES FIXTURES_REQUIRED verdicts PASS_REGULAR_EXPRESSION "all +1 ")
endif()
