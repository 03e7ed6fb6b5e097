# The Lua layer and the command: in both builds of Lua, as a module, in a C++ host; and the tests written in Lua.
find_package(PkgConfig REQUIRED)
pkg_check_modules(LUA_CXX REQUIRED IMPORTED_TARGET lua5.4-c++)
pkg_check_modules(LUA_C REQUIRED IMPORTED_TARGET lua5.4)

# models are found for any location of the build tree
function(lua_test name)
  set(environment "CLENCH_MODELS=${PROJECT_SOURCE_DIR}")
  if(CLENCH_SANITIZE)
    list(APPEND environment ${SANITIZER_OPTIONS})
  endif()
  add_test(NAME "${name}" COMMAND ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties("${name}" PROPERTIES ENVIRONMENT "${environment}" SKIP_RETURN_CODE 77)
endfunction()

# the same tests with a Lua that throws and one that uses longjmp
file(GLOB script_sources CONFIGURE_DEPENDS script/*_test.cpp)
clench_test_program(test_script_cxx ${script_sources})
clench_test_program(test_script_c $<TARGET_OBJECTS:test_script_cxx>)
foreach(kind CXX C)
  string(TOLOWER test_script_${kind} target)
  target_link_libraries(${target} PRIVATE clench_script PkgConfig::LUA_${kind})
  if(CLENCH_SANITIZE)
    lua_test(${target} ${target})
  else()
    clench_discover(${target} "script, Lua as ${kind}: ")
  endif()
endforeach()

file(GLOB app_sources CONFIGURE_DEPENDS app/*_test.cpp)
if(NOT CLENCH_VIEWER)
  set_source_files_properties(app/view_verb_test.cpp PROPERTIES HEADER_FILE_ONLY ON)
endif()
clench_test_program(test_app ${app_sources})
# a second implementation of Modbus
pkg_check_modules(MODBUS REQUIRED IMPORTED_TARGET libmodbus)
target_link_libraries(test_app PRIVATE PkgConfig::MODBUS)
# epsilon of grasps by a program that shares no code with the engine
pkg_check_modules(QHULL_R REQUIRED IMPORTED_TARGET qhull_r)
add_executable(recompute_epsilon app/recompute_epsilon.cpp bench/peer_qhull.cpp)
target_include_directories(recompute_epsilon PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
pkg_check_modules(EIGEN REQUIRED IMPORTED_TARGET eigen3)
target_link_libraries(recompute_epsilon PRIVATE PkgConfig::EIGEN nlohmann_json::nlohmann_json PkgConfig::QHULL_R)
target_compile_definitions(test_app PRIVATE
  CLENCH_COMMAND="$<TARGET_FILE:clench_app>" RECOMPUTE_EPSILON="$<TARGET_FILE:recompute_epsilon>")
add_dependencies(test_app clench_app recompute_epsilon)
if(CLENCH_SANITIZE)
  # searches run in parallel to the other tests; the longest ones are left out: C++ tests cover the engine's part of them
  set(long "*of an independent program*,*--verify shakes*,*--force-ratio*")
  set(searches "*search*,*list*,*plan*,*Ctrl-C*")
  lua_test(test_app_searches test_app "--test-case=${searches}" "--test-case-exclude=${long}")
  lua_test(test_app test_app "--test-case-exclude=${searches},${long}")
  set_tests_properties(test_app_searches test_app PROPERTIES COST 1000)
else()
  clench_discover(test_app "app: ")
endif()

file(GLOB_RECURSE lua_files RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS lua/*_test.lua)
if(CLENCH_SANITIZE)  # these draw and close hands for minutes there; C++ tests cover the functions that they call
  list(FILTER lua_files EXCLUDE REGEX "(approach|displaced|examples|jaws|log|models|measures|motion_study|plan|plan_level|plan_page|plan_pause|plan_resume|plan_starts|plan_touch|real_time_loop|supports|urdf_back|view|view_frames|view_keys|view_menus|view_page|view_panels|view_pictures)_test")
endif()
foreach(path ${lua_files})
  lua_test("${path}" clench_app test ${path})
  # the last line of output if something was skipped and nothing failed; COST: long ones start first
  set_tests_properties("${path}" PROPERTIES COST 10 SKIP_REGULAR_EXPRESSION "[0-9]+ passed, 0 failed, [1-9][0-9]* skipped\n$")
endforeach()

if(NOT CLENCH_SANITIZE)
  # some calls and files of the fuzzers, without findings, in a scratch folder of copies that they may overwrite
  set(fuzz ${CMAKE_CURRENT_BINARY_DIR}/fuzz_root)
  set(copies "rm -rf ${fuzz} && mkdir -p ${fuzz}/build && cp -r models worlds tests/data/seeds ${fuzz}")
  lua_test("fuzz: scratch folder" bash -c "${copies} && cd ${fuzz} && ls models/hands/parallel_jaw/*.cfg seeds/grasps.* >list")
  lua_test("fuzz: calls" clench_app -q run ${PROJECT_SOURCE_DIR}/tests/fuzz/api.lua 1 100)
  lua_test("fuzz: files" clench_app -q run ${PROJECT_SOURCE_DIR}/tests/fuzz/files.lua 1 50 list)
  set(fuzzers "fuzz: calls" "fuzz: files")
  if(CLENCH_VIEWER)
    lua_test("fuzz: viewer" clench_app -q run ${PROJECT_SOURCE_DIR}/tests/fuzz/viewer.lua 1 200)
    set_tests_properties("fuzz: viewer" PROPERTIES COST 10)
    list(APPEND fuzzers "fuzz: viewer")
  endif()
  set_tests_properties("fuzz: scratch folder" PROPERTIES FIXTURES_SETUP fuzz_root)
  set_tests_properties(${fuzzers} PROPERTIES WORKING_DIRECTORY ${fuzz} FIXTURES_REQUIRED fuzz_root ENVIRONMENT CLENCH_MODELS=.)

  lua_test("docs/api agrees with the bindings" clench_app doc docs/api --check)

  lua_test("stock Lua loads the module" ${CMAKE_COMMAND} -E env "LUA_CPATH=$<TARGET_FILE_DIR:clench_module>/?.so"
           ${LUA54} tests/embed/stock_lua.lua)

  # separate projects find the package, installed or in its build folder, and run
  set(host "C++ hosts build and run with the package, those of docs/guide/embedding.md among them")
  lua_test("${host}" tests/embed/hosts.sh ${PROJECT_BINARY_DIR} ${CMAKE_COMMAND} ${CMAKE_GENERATOR})
  set_tests_properties("${host}" PROPERTIES COST 10)
endif()
