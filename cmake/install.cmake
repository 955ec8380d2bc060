# SPDX-License-Identifier: Apache-2.0
# Where things go with `cmake --install`. Programs find what is shared beside themselves, whatever the
# prefix.
include(GNUInstallDirs)
install(TARGETS lodesman lodesman-low lodesman-high RUNTIME)
if(TARGET lodesman-allocations)  # where lodesman rt-test looks for it
  install(TARGETS lodesman-allocations LIBRARY DESTINATION lib/lodesman)
endif()
install(DIRECTORY deploy/config deploy/pictures DESTINATION ${CMAKE_INSTALL_DATADIR}/lodesman/deploy)
install(DIRECTORY hal_sim/scenarios hal_sim/vessels DESTINATION ${CMAKE_INSTALL_DATADIR}/lodesman/hal_sim)
install(DIRECTORY docs/ TYPE DOC)
install(FILES README.md LICENSE TYPE DOC)
install(FILES deploy/udev/60-lodesman.rules DESTINATION lib/udev/rules.d)
