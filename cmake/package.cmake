# SPDX-License-Identifier: Apache-2.0
# The Debian packages, one a component; deploy/package.sh makes them. What stands outside the prefix, or
# is made for the packages alone, is left out of `cmake --install`.
set(made ${PROJECT_BINARY_DIR}/package)  # by deploy/package.sh
install(FILES deploy/config/boat.toml DESTINATION /etc/lodesman COMPONENT runtime EXCLUDE_FROM_ALL)
foreach(component runtime bench)
  install(DIRECTORY ${made}/man-${component}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
foreach(package lodesman lodesman-bench lodesman-doc)
  string(REPLACE lodesman- "" component ${package})
  string(REPLACE lodesman runtime component ${component})
  install(FILES deploy/package/copyright ${made}/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES deploy/package/overrides/${package} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

# The maintainers' scripts share a function, and nothing that is installed.
file(READ deploy/package/refuse_under_way refuse_under_way)
foreach(script preinst prerm postinst postrm)
  configure_file(deploy/package/${script} ${made}/control/${script} @ONLY USE_SOURCE_PERMISSIONS)
endforeach()
configure_file(deploy/package/conffiles ${made}/control/conffiles COPYONLY)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lodesman)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Lodesman maintainers <maintainers@lodesman.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${made})
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_THREADS 0)
set(CPACK_COMPONENTS_ALL runtime bench doc)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_DEBUGINFO_PACKAGE OFF)
set(CPACK_DEBIAN_RUNTIME_DEBUGINFO_PACKAGE ON)
set(CPACK_DEBIAN_BENCH_DEBUGINFO_PACKAGE ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME lodesman)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "obstacle avoidance for an autonomous surface vehicle
Sees underwater obstacles with a forward-looking sonar and steers round
them, in real time: services for the boat's computer, and the
operator's command.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "systemd | systemd-standalone-sysusers, passwd")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libjs-dygraphs")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "gpsd, lodesman-bench, lodesman-doc")
foreach(file preinst prerm postinst postrm conffiles)
  list(APPEND CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${made}/control/${file})
endforeach()

set(CPACK_DEBIAN_BENCH_PACKAGE_NAME lodesman-bench)
set(CPACK_DEBIAN_BENCH_DESCRIPTION "obstacle avoidance for an autonomous surface vehicle: simulation
Sails scenarios on simulated and on emulated devices, draws what was
sailed and what was seen in sonar frames. A boat does without it.")
set(CPACK_DEBIAN_BENCH_PACKAGE_DEPENDS "lodesman (= ${PROJECT_VERSION}-1)")
set(CPACK_DEBIAN_BENCH_PACKAGE_RECOMMENDS gnuplot-nox)

set(CPACK_DEBIAN_DOC_PACKAGE_NAME lodesman-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DOC_DESCRIPTION "obstacle avoidance for an autonomous surface vehicle: documents
What the programs do, how a boat is wired, set and operated, and why it
is built as it is.")
include(CPack)
