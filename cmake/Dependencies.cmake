# Everything comes from Debian's packages; nothing is downloaded. The names of the packages: tools/deps.sh.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(yaml-cpp REQUIRED)
find_library(YAML_CPP_LIBRARY yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(NETTLE REQUIRED IMPORTED_TARGET nettle)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(SECCOMP REQUIRED IMPORTED_TARGET libseccomp)
find_package(EXPAT REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(CGAL REQUIRED)
find_package(draco CONFIG QUIET)
find_library(GMP_LIBRARY gmp REQUIRED)
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)
find_path(DRACO_INCLUDE_DIR draco/compression/decode.h REQUIRED)
find_library(DRACO_LIBRARY draco REQUIRED)

add_library(facetmill_dependencies INTERFACE)
target_link_libraries(facetmill_dependencies INTERFACE
  Threads::Threads fmt::fmt TBB::tbb nlohmann_json::nlohmann_json ${YAML_CPP_LIBRARY} CLI11::CLI11 Eigen3::Eigen PkgConfig::NETTLE
  ZLIB::ZLIB PNG::PNG JPEG::JPEG PkgConfig::WEBP PkgConfig::ZSTD EXPAT::EXPAT PkgConfig::SECCOMP
  meshoptimizer::meshoptimizer ${DRACO_LIBRARY} ${GMP_LIBRARY})
target_include_directories(facetmill_dependencies SYSTEM INTERFACE ${TINYGLTF_INCLUDE_DIR} ${DRACO_INCLUDE_DIR})

add_library(facetmill_cgal_dependencies INTERFACE)
target_link_libraries(facetmill_cgal_dependencies INTERFACE CGAL::CGAL Eigen3::Eigen TBB::tbb fmt::fmt)

# OpenMesh by its files: the names of its CMake targets differ between Debian 12 and 13.
find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh REQUIRED)
find_library(OPENMESH_CORE_LIBRARY OpenMeshCore REQUIRED)
find_library(OPENMESH_TOOLS_LIBRARY OpenMeshTools REQUIRED)
add_library(facetmill_openmesh_dependencies INTERFACE)
target_include_directories(facetmill_openmesh_dependencies SYSTEM INTERFACE ${OPENMESH_INCLUDE_DIR})
target_link_libraries(facetmill_openmesh_dependencies INTERFACE ${OPENMESH_TOOLS_LIBRARY} ${OPENMESH_CORE_LIBRARY} fmt::fmt)
