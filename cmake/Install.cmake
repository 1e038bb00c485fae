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

# What comes from the declarations is written by the executable itself: the pages of the stages and of the messages, and
# completions of the shells that load them from a folder.
set(written)
function(write_text file)
  get_filename_component(folder ${file} DIRECTORY)
  add_custom_command(OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND $<TARGET_FILE:facetmill> ${ARGN} > ${file}.part
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
