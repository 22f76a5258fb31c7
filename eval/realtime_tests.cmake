# Read by ctest: gives the label realtime to the tests of processes, middleware and clocks, whose outcome a busy machine
# could change (ci/busy).
set(realtime
  "^eval/(Dds|Robot(Server|Limits)|Soak|Freenect|Interruption|LiveStatus|Killed|Track|CommandLine|Commands|Outputs|RunFolder)")
foreach(test IN LISTS eval_tests_TESTS)
  if(test MATCHES "${realtime}")
    set_tests_properties(${test} PROPERTIES LABELS realtime)
  endif()
endforeach()
foreach(test IN LISTS eval_long_tests)
  if(test MATCHES "${realtime}")
    set_tests_properties(${test} PROPERTIES LABELS "long;realtime")
  endif()
endforeach()
