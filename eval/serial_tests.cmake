# Read by ctest: what runs in real time over the middleware runs by itself, so that other tests do not hold it up.
foreach(test IN LISTS eval_tests_TESTS eval_long_tests)
  if(test MATCHES "^eval/(Dds|RobotServer|SoakLong)")
    set_tests_properties(${test} PROPERTIES RUN_SERIAL TRUE)
  endif()
endforeach()
