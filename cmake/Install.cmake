# cmake --install and the Debian package: the executable, manual pages, shell completions, ready pipelines as examples,
# and what find_package(facetmill) reads.
include(GNUInstallDirs)
install(TARGETS facetmill EXPORT facetmill RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/facetmill)
write_basic_package_version_file(facetmillConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(EXPORT facetmill NAMESPACE facetmill:: FILE facetmillTargets.cmake DESTINATION ${package_dir})
install(FILES cmake/facetmillConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/facetmillConfigVersion.cmake
        DESTINATION ${package_dir})
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY pipelines examples docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES man/facetmill.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES man/facetmill-pipeline.5 DESTINATION ${CMAKE_INSTALL_MANDIR}/man5)

# The pages of the stages and of the messages come from their declarations, so the executable writes them.
set(pages)
foreach(page stages:stages messages:explain)
  string(REGEX REPLACE ":.*" "" name ${page})
  string(REGEX REPLACE ".*:" "" command ${page})
  set(file ${CMAKE_CURRENT_BINARY_DIR}/man/facetmill-${name}.7)
  add_custom_command(OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/man
    COMMAND $<TARGET_FILE:facetmill> ${command} --man > ${file}.part
    COMMAND ${CMAKE_COMMAND} -E rename ${file}.part ${file}
    DEPENDS facetmill COMMENT "Writing the manual page facetmill-${name}(7)" VERBATIM)
  list(APPEND pages ${file})
endforeach()
add_custom_target(manual ALL DEPENDS ${pages})
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man7)

install(FILES tools/completion/facetmill.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME facetmill)
install(FILES tools/completion/facetmill.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

set(CPACK_PACKAGE_NAME facetmill)
set(CPACK_PACKAGE_VENDOR facetmill)
set(CPACK_PACKAGE_CONTACT "facetmill maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_CURRENT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${CPACK_PACKAGE_CONTACT}")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
