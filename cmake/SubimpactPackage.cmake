# The library as others see it: subimpact::subimpact, one archive of all floors and the headers in
# include/ alone. The same target comes from add_subdirectory and, installed, from find_package.
get_property(floors GLOBAL PROPERTY SUBIMPACT_FLOORS)
set(objects "${floors}")
list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
add_library(subimpact_whole STATIC ${objects})
add_library(subimpact::subimpact ALIAS subimpact_whole)
set_target_properties(subimpact_whole PROPERTIES
  LINKER_LANGUAGE CXX OUTPUT_NAME subimpact EXPORT_NAME subimpact)
target_compile_features(subimpact_whole PUBLIC cxx_std_20)
target_include_directories(subimpact_whole
  INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
# Linked, and nothing more: none of their headers is included by ours.
target_link_libraries(subimpact_whole
  PRIVATE SUNDIALS::arkode_shared SUNDIALS::cvode_shared SUNDIALS::nvecserial_shared
          SUNDIALS::sunlinsolklu_shared SUNDIALS::sunmatrixsparse_shared
          SUNDIALS::sunnonlinsolfixedpoint_shared KLU::KLU fmt::fmt tomlplusplus::tomlplusplus
          OpenSSL::Crypto Threads::Threads)

if(NOT SUBIMPACT_INSTALL)
  return()
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/subimpact)
set(generated ${PROJECT_BINARY_DIR}/package)
configure_package_config_file(cmake/subimpactConfig.cmake.in ${generated}/subimpactConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${generated}/subimpactConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(TARGETS subimpact_whole EXPORT subimpact COMPONENT library)
install(DIRECTORY include/subimpact TYPE INCLUDE COMPONENT library FILES_MATCHING PATTERN "*.h")
install(EXPORT subimpact NAMESPACE subimpact:: FILE subimpactTargets.cmake
        DESTINATION ${package_dir} COMPONENT library)
install(FILES ${generated}/subimpactConfig.cmake ${generated}/subimpactConfigVersion.cmake
              cmake/FindKLU.cmake
        DESTINATION ${package_dir} COMPONENT library)
install(FILES LICENSE CITATION.cff TYPE DOC COMPONENT licence)

# For pkg-config. The library is static, so what it needs is always linked with it.
file(RELATIVE_PATH prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/subimpact.pc.in ${generated}/subimpact.pc.generator @ONLY)
file(GENERATE OUTPUT ${generated}/subimpact.pc INPUT ${generated}/subimpact.pc.generator)
install(FILES ${generated}/subimpact.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT library)
