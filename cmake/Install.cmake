# SPDX-License-Identifier: MIT OR Apache-2.0
# What is installed, and where. Nothing installed knows the prefix: it may be moved.
include(CMakePackageConfigHelpers)

set(embound_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/embound")
install(DIRECTORY include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp" PATTERN "*.f90")
if(EMBOUND_BUILD_SHARED)
  install(PROGRAMS "${embound_shared}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(FILES "${embound_stage}/lib/${embound_soname}" "${embound_stage}/lib/libembound.so"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}")
endif()
if(EMBOUND_BUILD_STATIC)
  install(FILES "${embound_static}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
endif()
install(FILES README.md CHANGELOG.md LICENSE-MIT LICENSE-APACHE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${embound_stage}/third-party" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# CMake package
configure_package_config_file(cmake/embound-config.cmake.in "${PROJECT_BINARY_DIR}/embound-config.cmake"
  INSTALL_DESTINATION "${embound_package_dir}" PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/embound-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/embound-config.cmake" "${PROJECT_BINARY_DIR}/embound-config-version.cmake"
  DESTINATION "${embound_package_dir}")

# pkg-config: `embound` links what find_package's embound::embound links, `embound-static` the static
# library even where the shared one lies beside it, which `pkg-config --static` cannot say.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(embound_pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
  file(RELATIVE_PATH embound_pc_up "/p/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/p")
  string(REGEX REPLACE "/$" "" embound_pc_up "${embound_pc_up}")
  set(embound_pc_prefix "\${pcfiledir}/${embound_pc_up}")
endif()
foreach(dir INCLUDEDIR LIBDIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${dir}}")
    set(embound_pc_${dir} "${CMAKE_INSTALL_${dir}}")
  else()
    set(embound_pc_${dir} "\${prefix}/${CMAKE_INSTALL_${dir}}")
  endif()
endforeach()
list(TRANSFORM embound_system_libraries PREPEND "-l" OUTPUT_VARIABLE embound_pc_system)
list(JOIN embound_pc_system " " embound_pc_system)

function(embound_install_pc name libs libs_private)
  configure_file(cmake/embound.pc.in "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()
set(embound_pc_static "\${libdir}/libembound.a ${embound_pc_system}")
if(EMBOUND_BUILD_SHARED)
  embound_install_pc(embound "-L\${libdir} -lembound" "${embound_pc_system}")
else()
  embound_install_pc(embound "${embound_pc_static}" "")
endif()
if(EMBOUND_BUILD_STATIC)
  embound_install_pc(embound-static "${embound_pc_static}" "")
endif()
