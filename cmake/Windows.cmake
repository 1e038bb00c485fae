# Windows instead of Dependencies.cmake: all libraries come from the folder of packaging/linux/libraries.sh.
set(FACETMILL_LIBRARIES ${CMAKE_CURRENT_SOURCE_DIR}/build/libraries-windows CACHE PATH "The folder of libraries.sh")
find_package(Threads REQUIRED)

set(windows_libraries "")
foreach(library OpenMeshTools OpenMeshCore draco yaml-cpp nettle png16 z jpeg webp sharpyuv zstd expat meshoptimizer gmpxx
                mpfr gmp tbb12 fmt)
  set(file ${FACETMILL_LIBRARIES}/lib/lib${library}.a)
  if(EXISTS ${file})
    list(APPEND windows_libraries ${file})
  elseif(NOT library STREQUAL sharpyuv)
    message(FATAL_ERROR "There is no lib${library}.a: run packaging/linux/libraries.sh ${FACETMILL_LIBRARIES} windows")
  endif()
endforeach()

add_library(facetmill_dependencies INTERFACE)
target_include_directories(facetmill_dependencies SYSTEM INTERFACE ${FACETMILL_LIBRARIES}/include ${FACETMILL_LIBRARIES}/include/eigen3)
target_compile_definitions(facetmill_dependencies INTERFACE BOOST_ALL_NO_LIB WIN32_LEAN_AND_MEAN NOMINMAX YAML_CPP_STATIC_DEFINE XML_STATIC)
# The many sections of templates exceed the plain object format.
target_compile_options(facetmill_dependencies INTERFACE -Wa,-mbig-obj)
target_link_libraries(facetmill_dependencies INTERFACE Threads::Threads)
add_library(facetmill_cgal_dependencies INTERFACE)
target_link_libraries(facetmill_cgal_dependencies INTERFACE facetmill_dependencies)
target_compile_options(facetmill_cgal_dependencies INTERFACE -frounding-math)
target_compile_definitions(facetmill_cgal_dependencies INTERFACE CGAL_USE_GMPXX=1)
add_library(facetmill_openmesh_dependencies INTERFACE)
target_link_libraries(facetmill_openmesh_dependencies INTERFACE facetmill_dependencies)
target_compile_definitions(facetmill_openmesh_dependencies INTERFACE _USE_MATH_DEFINES)

# library_versions for --version, from the versions of Debian's sources.
function(windows_versions)
  file(STRINGS ${FACETMILL_LIBRARIES}/sources.txt sources)
  set(versions "")
  foreach(pair CGAL=cgal CLI11=cli11 Draco=draco Eigen=eigen3 Expat=expat fmt=fmtlib meshoptimizer=meshoptimizer Nettle=nettle
               nlohmann-json=nlohmann-json3 OpenMesh=openmesh TBB=onetbb tinygltf=tinygltf yaml-cpp=yaml-cpp zlib=zlib zstd=libzstd)
    string(REGEX MATCH "^(.*)=(.*)$" all ${pair})
    set(name ${CMAKE_MATCH_1})
    set(entry ${sources})
    list(FILTER entry INCLUDE REGEX "^${CMAKE_MATCH_2} ")
    string(REGEX MATCH " ([0-9]+:)?([0-9.]+)" all "${entry}")
    list(APPEND versions "${name}=${CMAKE_MATCH_2}")
  endforeach()
  set(library_versions ${versions} PARENT_SCOPE)
endfunction()

# The manifest (UTF-8, long paths) and the version of the file. Windows gives threads and the main thread the stack that
# Linux gives them.
function(windows_executable target)
  enable_language(RC)
  string(REPLACE "." "," version_numbers ${PROJECT_VERSION})
  configure_file(packaging/windows/facetmill.rc.in generated/facetmill.rc @ONLY)
  configure_file(packaging/windows/facetmill.manifest generated/facetmill.manifest COPYONLY)
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated/facetmill.rc)
  windows_link(${target})
endfunction()

function(windows_link target)
  target_link_libraries(${target} PRIVATE facetmill_flags facetmill_dependencies -Wl,--start-group ${windows_libraries} -Wl,--end-group)
  # The wrapped function makes text of paths UTF-8 (src/platform/windows/utf8_paths.cpp).
  target_link_options(${target} PRIVATE -static -Wl,--stack,8388608,--build-id,--no-insert-timestamp,--wrap=mbrtowc)
endfunction()

# `wine platform_tests.exe` tests the calls of the system without the rest of the program.
function(windows_tests)
  set(tests tests/platform/file_names_test.cpp tests/support/main.cpp)
  set_source_files_properties(${tests} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(platform_tests EXCLUDE_FROM_ALL ${tests} ${ARGN})
  set_target_properties(platform_tests PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  target_include_directories(platform_tests PRIVATE tests src ${CMAKE_CURRENT_BINARY_DIR}/generated)
  windows_link(platform_tests)
endfunction()
