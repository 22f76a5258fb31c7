# What the static library was linked with has to be found where it is used.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
find_dependency(nlohmann_json 3.11)
find_dependency(fmt)
find_dependency(assimp)
find_dependency(TBB)
find_dependency(hwy)
find_dependency(OpenCV 4 COMPONENTS core imgproc)
find_dependency(PkgConfig)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)

include(${CMAKE_CURRENT_LIST_DIR}/glovebenchTargets.cmake)
