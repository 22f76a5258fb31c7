# Read by ctest: gives the label realtime to the tests of processes, middleware and clocks, whose outcome a busy machine
# could change (ci/busy). They wait more than they compute, so they start first and others run beside them.
set(realtime
  "^eval/(Dds|Robot(Server|Limits)|Soak|Freenect|Interruption|LiveStatus|Killed|Track|CommandLine|Commands|Programs|Outputs|RunStore)")
foreach(test IN LISTS eval_tests_TESTS)
  if(test MATCHES "${realtime}")
    set_tests_properties(${test} PROPERTIES LABELS realtime COST 100)
  endif()
endforeach()
foreach(test IN LISTS eval_long_tests)
  if(test MATCHES "${realtime}")
    set_tests_properties(${test} PROPERTIES LABELS "long;realtime" COST 100)
  endif()
endforeach()
