# cmake -D ROOTS=... -D NAME=... -D SOURCE_DIR=... -D OUTPUT=... -D DEPFILE=... -P source_hash.cmake: writes OUTPUT, a source
# that defines glovebench::NAME() (MODULE::FUNCTION), the hash of all project files that the roots reach. A file reaches what it includes; a
# header also reaches the sources beside it that implement it, which name it in their first include. An edit of one of
# these files, whose list goes to DEPFILE, changes the hash; an edit of another file does not.
cmake_minimum_required(VERSION 3.22)

set(files)
set(queue ${ROOTS})
while(queue)
  list(POP_FRONT queue file)
  if(file IN_LIST files OR NOT EXISTS ${SOURCE_DIR}/${file})
    continue()
  endif()
  list(APPEND files ${file})
  file(STRINGS ${SOURCE_DIR}/${file} lines REGEX "^#include \"")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" included "${line}")
    list(APPEND queue ${included})
  endforeach()
  if(NOT file MATCHES "\\.h$")
    continue()
  endif()
  get_filename_component(folder ${file} DIRECTORY)
  file(GLOB beside RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/${folder}/*.cpp)
  list(FILTER beside EXCLUDE REGEX "_(test|fuzz)\\.cpp$")
  foreach(source ${beside})
    file(STRINGS ${SOURCE_DIR}/${source} first REGEX "^#include \"" LIMIT_COUNT 1)
    if(first STREQUAL "#include \"${file}\"")
      list(APPEND queue ${source})
    endif()
  endforeach()
endwhile()

foreach(root ${ROOTS})
  if(NOT root IN_LIST files)
    message(FATAL_ERROR "${root}: missing")
  endif()
endforeach()
list(SORT files)
set(text)
set(dependencies)
foreach(file ${files})
  file(SHA256 ${SOURCE_DIR}/${file} hash)
  string(APPEND text "${file} ${hash}\n")
  string(APPEND dependencies " ${SOURCE_DIR}/${file}")
endforeach()
string(SHA256 hash "${text}")
string(SUBSTRING ${hash} 0 32 hash)
string(REGEX REPLACE "([^\n]+)\n" "// \\1\n" list "${text}")
string(REGEX MATCH "^(.*)::([^:]*)$" ignored ${NAME})
file(WRITE ${OUTPUT} "#include <string>

${list}namespace glovebench::${CMAKE_MATCH_1} {

std::string ${CMAKE_MATCH_2}();
std::string ${CMAKE_MATCH_2}() {
  return \"${hash}\";
}

}  // namespace glovebench::${CMAKE_MATCH_1}
")
file(WRITE ${DEPFILE} "${OUTPUT}:${dependencies}\n")
