include(CMakePackageConfigHelpers)

# what a plain C program adds to the static library
set(cxx_runtime -lstdc++)
if("c++" IN_LIST CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
  set(cxx_runtime -lc++)
endif()

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/mlcp")
install(FILES capi/mlcp.h DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS mlcp EXPORT mlcpTargets)
install(TARGETS mlcp_static EXPORT mlcpStaticTargets)
install(EXPORT mlcpTargets NAMESPACE mlcp:: DESTINATION "${package_dir}")
install(EXPORT mlcpStaticTargets NAMESPACE mlcp:: DESTINATION "${package_dir}")

configure_package_config_file(cmake/mlcpConfig.cmake.in mlcpConfig.cmake INSTALL_DESTINATION "${package_dir}")
# before 1.0 a minor version may break
write_basic_package_version_file(mlcpConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/mlcpConfig.cmake" "${PROJECT_BINARY_DIR}/mlcpConfigVersion.cmake" DESTINATION "${package_dir}")

# mlcp.pc finds its prefix from where it lies, so that an installed tree may be moved
set(pc_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH pc_to_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
file(RELATIVE_PATH prefix_to_lib "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_LIBDIR}")
file(RELATIVE_PATH prefix_to_include "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
configure_file(mlcp.pc.in mlcp.pc @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/mlcp.pc" DESTINATION "${pc_dir}")
