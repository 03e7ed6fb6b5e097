// test_header: compiles the precompiled header of the test programs, and has no tests of its own
