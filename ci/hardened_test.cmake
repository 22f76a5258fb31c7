# cmake -D READELF=... -D PROGRAM=... -P hardened_test.cmake: a release's program has what CMakeLists.txt hardens it with.
cmake_minimum_required(VERSION 3.22)

execute_process(COMMAND ${READELF} -hldW ${PROGRAM} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
foreach(expected "Type: +DYN" GNU_RELRO BIND_NOW)
  if(NOT text MATCHES "${expected}")
    message(FATAL_ERROR "${PROGRAM}: found no ${expected}, expected a hardened release")
  endif()
endforeach()

# The functions that code of these flags calls: -fstack-protector-strong, -D_FORTIFY_SOURCE, -D_GLIBCXX_ASSERTIONS.
execute_process(COMMAND ${READELF} --dyn-syms -W ${PROGRAM} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
foreach(expected " __stack_chk_fail@" " __[a-z]+_chk@" "__glibcxx_assert_fail")
  if(NOT text MATCHES "${expected}")
    message(FATAL_ERROR "${PROGRAM}: found no call of ${expected}, expected a hardened release")
  endif()
endforeach()
