# cmake -D READELF=... -D PROGRAM=... -P hardened_test.cmake: a release's program has what CMakeLists.txt hardens it with.
cmake_minimum_required(VERSION 3.22)

execute_process(COMMAND ${READELF} -hldW --dyn-syms ${PROGRAM} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
foreach(expected
    "Type: +DYN"             # placed anywhere (PIE)
    "GNU_RELRO" "BIND_NOW"   # nobody writes where its functions' addresses lie
    "__stack_chk_fail"       # an overrun of the stack ends it
    "_chk@GLIBC"             # so does one of a buffer whose size is known
    "__glibcxx_assert_fail") # and an index behind a vector's end
  if(NOT text MATCHES "${expected}")
    message(FATAL_ERROR "${PROGRAM}: found no ${expected}, expected a hardened release")
  endif()
endforeach()
