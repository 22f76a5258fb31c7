# cmake -D READELF=... -D PROGRAM=... -P hardened_test.cmake: a release's program has what CMakeLists.txt hardens it with.
cmake_minimum_required(VERSION 3.22)

execute_process(COMMAND ${READELF} -hldW ${PROGRAM} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
foreach(expected "Type: +DYN" GNU_RELRO BIND_NOW)
  if(NOT text MATCHES "${expected}")
    message(FATAL_ERROR "${PROGRAM}: found no ${expected}, expected a hardened release")
  endif()
endforeach()
