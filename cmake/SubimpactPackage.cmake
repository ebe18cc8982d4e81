# The library as others see it, with the headers in include/ alone: subimpact::subimpact runs cases,
# reads and writes them and their results; subimpact::studies has what is made of several runs (error
# bars, comparisons, sweeps) and figures and pages. The same targets come from add_subdirectory and,
# installed, from find_package.
#
#   subimpact_archive(<core or studies> <target> <file> <name for export>)
function(subimpact_archive library target file name)
  get_property(objects GLOBAL PROPERTY SUBIMPACT_OBJECTS_${library})
  add_library(${target} STATIC ${objects})
  add_library(subimpact::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    LINKER_LANGUAGE CXX OUTPUT_NAME ${file} EXPORT_NAME ${name})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
endfunction()
subimpact_archive(core subimpact_core subimpact subimpact)
subimpact_archive(studies subimpact_studies subimpact-studies studies)
# Linked, and nothing more: none of their headers is included by ours.
target_link_libraries(subimpact_core
  PRIVATE SUNDIALS::arkode_shared SUNDIALS::cvode_shared SUNDIALS::nvecserial_shared
          SUNDIALS::sunlinsolklu_shared SUNDIALS::sunmatrixsparse_shared
          SUNDIALS::sunnonlinsolfixedpoint_shared KLU::KLU fmt::fmt tomlplusplus::tomlplusplus
          OpenSSL::Crypto)
target_link_libraries(subimpact_studies
  PUBLIC subimpact_core PRIVATE fmt::fmt OpenSSL::Crypto Threads::Threads)

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
install(TARGETS subimpact_core subimpact_studies EXPORT subimpact COMPONENT library)
install(DIRECTORY include/subimpact TYPE INCLUDE COMPONENT library FILES_MATCHING PATTERN "*.h")
install(EXPORT subimpact NAMESPACE subimpact:: FILE subimpactTargets.cmake
        DESTINATION ${package_dir} COMPONENT library)
install(FILES ${generated}/subimpactConfig.cmake ${generated}/subimpactConfigVersion.cmake
              cmake/FindKLU.cmake
        DESTINATION ${package_dir} COMPONENT library)
install(FILES LICENSE CITATION.cff TYPE DOC COMPONENT licence)

# For pkg-config. The libraries are static, so what they need is always linked with them.
file(RELATIVE_PATH prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
foreach(name IN ITEMS subimpact subimpact-studies)
  configure_file(cmake/${name}.pc.in ${generated}/${name}.pc.generator @ONLY)
  file(GENERATE OUTPUT ${generated}/${name}.pc INPUT ${generated}/${name}.pc.generator)
  install(FILES ${generated}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT library)
endforeach()
