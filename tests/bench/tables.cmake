# Grasps of objects on a table, shaken and lifted again in MuJoCo.
add_executable(bench_mujoco bench/mujoco_bench.cpp bench/verdicts/mujoco_grip.cpp bench/verdicts/grip_scene.cpp bench/verdicts/convex_pieces.cpp
                            bench/verdicts/grip_test.cpp)
target_include_directories(bench_mujoco PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(bench_mujoco PRIVATE clench_geometry nlohmann_json::nlohmann_json mujoco::mujoco)
set(folder ${CMAKE_CURRENT_BINARY_DIR}/tables)
file(MAKE_DIRECTORY ${folder})
add_test(NAME "bench: tables" COMMAND clench_app -q run tests/bench/tables.lua --hands adaptive_gripper --objects mug --candidates 24 --scenes ${folder}
         WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
add_test(NAME "bench: tables in MuJoCo" COMMAND bench_mujoco --brief --limit 1 ${folder}/adaptive_gripper_mug.json)
set_tests_properties("bench: tables" PROPERTIES FIXTURES_SETUP tables)
set_tests_properties("bench: tables in MuJoCo" PROPERTIES FIXTURES_REQUIRED tables PASS_REGULAR_EXPRESSION "all +1 ")
