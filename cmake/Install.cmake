# cmake --install and the Debian packages: the executable, manual pages, shell completions, and what
# find_package(facetmill) reads; and, as a component of its own, the manual with ready pipelines and examples.
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS facetmill EXPORT facetmill RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/facetmill)
write_basic_package_version_file(facetmillConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(EXPORT facetmill NAMESPACE facetmill:: FILE facetmillTargets.cmake DESTINATION ${package_dir})
install(FILES cmake/facetmillConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/facetmillConfigVersion.cmake
        DESTINATION ${package_dir})
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY pipelines examples docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(FILES man/facetmill.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES man/facetmill-pipeline.5 DESTINATION ${CMAKE_INSTALL_MANDIR}/man5)

# What comes from the declarations is written by the executable itself: the pages of the stages and of the messages, and
# completions of the shells that load them from a folder.
set(written)
function(write_text file)
  get_filename_component(folder ${file} DIRECTORY)
  add_custom_command(OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND facetmill ${ARGN} > ${file}.part
    COMMAND ${CMAKE_COMMAND} -E rename ${file}.part ${file}
    DEPENDS facetmill COMMENT "Writing ${file}" VERBATIM)
  set(written ${written} ${file} PARENT_SCOPE)
endfunction()
write_text(${CMAKE_CURRENT_BINARY_DIR}/man/facetmill-stages.7 stages --man)
write_text(${CMAKE_CURRENT_BINARY_DIR}/man/facetmill-messages.7 explain --man)
install(FILES ${written} DESTINATION ${CMAKE_INSTALL_MANDIR}/man7)
write_text(${CMAKE_CURRENT_BINARY_DIR}/completions/facetmill completions bash)
write_text(${CMAKE_CURRENT_BINARY_DIR}/completions/facetmill.fish completions fish)
add_custom_target(manual ALL DEPENDS ${written})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/completions/facetmill
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/completions/facetmill.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# Two Debian packages. cmake/Debian.cmake adds what only such packages have.
set(CPACK_PACKAGE_NAME facetmill)
set(CPACK_PACKAGE_VENDOR facetmill)
set(CPACK_PACKAGE_CONTACT "facetmill maintainers <facetmill@packages.invalid>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # the descriptions below begin with theirs
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_CURRENT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/cmake/Debian.cmake)
set(CPACK_FACETMILL_CHANGES ${CMAKE_CURRENT_SOURCE_DIR}/CHANGELOG.md)
set(CPACK_COMPONENTS_ALL program doc)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME facetmill)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS facetmill-doc)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"declarative mesh pipelines that end in checked glTF
facetmill turns scans and CAD exports, even broken ones, into checked meshes
for the web, printing and measurement. Pipelines are written in YAML or as
one line of stages: repair, exact cuts and Booleans, simplification with a
measured deviation, checks, reports and pictures. It reads and writes glTF,
PLY, OBJ, OFF, STL, 3MF and Draco, and writes 3D Tiles.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME facetmill-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_RECOMMENDS facetmill)
set(CPACK_DEBIAN_DOC_DESCRIPTION
"manual of facetmill, a mill for facets
facetmill turns scans and CAD exports, even broken ones, into checked meshes
for the web, printing and measurement. This package has its manual, its ready
pipelines, and examples with a scan.")
include(CPack)
