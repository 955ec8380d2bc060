# SPDX-License-Identifier: Apache-2.0
# Where things go with `cmake --install`. Programs find what is shared beside themselves, whatever the
# prefix. Each component is a package (cmake/package.cmake).
include(GNUInstallDirs)
set(share ${CMAKE_INSTALL_DATADIR}/lodesman)
install(TARGETS lodesman lodesman-low lodesman-high lodesman-recorder lodesman-console RUNTIME COMPONENT runtime)
if(TARGET lodesman-allocations)  # where lodesman rt-test looks for it
  install(TARGETS lodesman-allocations LIBRARY DESTINATION lib/lodesman COMPONENT runtime)
endif()
install(TARGETS lodesman-bench lodesman-devices RUNTIME COMPONENT bench)
install(DIRECTORY deploy/config deploy/pictures deploy/viewer DESTINATION ${share}/deploy
        COMPONENT runtime PATTERN boat.toml EXCLUDE)
install(DIRECTORY deploy/operator/console/page/ DESTINATION ${share}/console COMPONENT runtime)
install(DIRECTORY hal_sim/scenarios hal_sim/vessels DESTINATION ${share}/hal_sim COMPONENT runtime)
install(DIRECTORY docs/ TYPE DOC COMPONENT doc)
install(FILES README.md TYPE DOC COMPONENT doc)
install(FILES LICENSE TYPE DOC COMPONENT licence)
install(FILES deploy/udev/60-lodesman.rules DESTINATION lib/udev/rules.d COMPONENT runtime)
install(FILES deploy/systemd/lodesman.target deploy/systemd/lodesman-low.service
        deploy/systemd/lodesman-high.service deploy/systemd/lodesman-recorder.service
        deploy/systemd/lodesman-console.service DESTINATION lib/systemd/system COMPONENT runtime)
install(FILES deploy/package/lodesman.sysusers DESTINATION lib/sysusers.d RENAME lodesman.conf
        COMPONENT runtime)
install(FILES deploy/package/lodesman.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME lodesman COMPONENT runtime)
