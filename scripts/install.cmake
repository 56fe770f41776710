# SPDX-License-Identifier: MIT
# What `cmake --install` lays out: the library with its headers and package files, and the tool.
# (boxwood-tests is installed where it is built.)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/boxwood)

install(TARGETS boxwood-lib EXPORT boxwoodTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT boxwoodTargets NAMESPACE boxwood:: DESTINATION ${package_folder})
install(DIRECTORY include/boxwood DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY cl/shared DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/boxwood FILES_MATCHING PATTERN "*.h")
# What functions in TopDownOptions::source may use: to read beside include/boxwood/topdown.hpp.
install(FILES cl/build/strategies.h DESTINATION ${CMAKE_INSTALL_DATADIR}/boxwood/cl/build)
install(FILES cl/influence/distribution.h DESTINATION ${CMAKE_INSTALL_DATADIR}/boxwood/cl/influence)
install(FILES cl/bounds/box.h DESTINATION ${CMAKE_INSTALL_DATADIR}/boxwood/cl/bounds)

configure_package_config_file(scripts/boxwoodConfig.cmake.in ${PROJECT_BINARY_DIR}/boxwoodConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/boxwoodConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(scripts/boxwood.pc.in ${PROJECT_BINARY_DIR}/boxwood.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/boxwood.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${PROJECT_BINARY_DIR}/boxwoodConfig.cmake ${PROJECT_BINARY_DIR}/boxwoodConfigVersion.cmake
  DESTINATION ${package_folder})

if(TARGET boxwood)
  install(TARGETS boxwood RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
