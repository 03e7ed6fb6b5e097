// test_header: it makes the precompiled header of the test programs, and has no tests of its own
