# The kinds of target of this project: salma_add_library, salma_add_app, salma_add_bench, salma_add_test.
set(SALMA_SANITIZE "" CACHE STRING "Sanitizers for every target, e.g. address,undefined")

add_library(salma_flags INTERFACE)
target_compile_options(salma_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
if(SALMA_SANITIZE)
  # "undefined" leaves out casts of NaN and of large numbers to integers. Assertions of Eigen and of the
  # standard library find wrong indices that stay inside an allocation.
  set(SALMA_SANITIZERS ${SALMA_SANITIZE})
  if(SALMA_SANITIZE MATCHES "undefined")
    string(APPEND SALMA_SANITIZERS ",float-cast-overflow")
  endif()
  target_compile_options(salma_flags INTERFACE -fsanitize=${SALMA_SANITIZERS} -fno-omit-frame-pointer
                                               -fno-sanitize-recover=all -UNDEBUG -D_GLIBCXX_ASSERTIONS)
  target_link_options(salma_flags INTERFACE -fsanitize=${SALMA_SANITIZERS})
endif()

function(salma_require_earlier name)
  foreach(dep ${ARGN})
    if(dep MATCHES "^salma::" AND NOT TARGET ${dep})
      message(FATAL_ERROR "${name} links ${dep}, which is not above it in the data-flow order")
    endif()
  endforeach()
endfunction()

# salma_add_library(<name> HEADERS <h>... SOURCES <cpp>... [PUBLIC <target>...] [PRIVATE <target>...])
function(salma_add_library name)
  cmake_parse_arguments(A "" "" "HEADERS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  salma_require_earlier(${name} ${A_PUBLIC} ${A_PRIVATE})
  add_library(salma_${name} STATIC ${A_SOURCES})
  add_library(salma::${name} ALIAS salma_${name})
  list(TRANSFORM A_HEADERS PREPEND include/salma/${name}/)
  target_sources(salma_${name} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${A_HEADERS})
  target_link_libraries(salma_${name} PUBLIC ${A_PUBLIC}
                                      PRIVATE ${A_PRIVATE} $<BUILD_INTERFACE:salma_flags>)
  target_compile_features(salma_${name} PUBLIC cxx_std_17)
  set_target_properties(salma_${name} PROPERTIES
    EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON
    POSITION_INDEPENDENT_CODE ON)  # the plug-in links it
  install(TARGETS salma_${name} EXPORT salmaTargets FILE_SET HEADERS)
endfunction()

# salma_add_app(<name> [SOURCES <cpp>...] LINK <target>...)
# apps/<name>/main.cpp over the application class in SOURCES, which tests can link as <name>_app.
function(salma_add_app name)
  cmake_parse_arguments(A "" "" "SOURCES;LINK" ${ARGN})
  salma_require_earlier(${name} ${A_LINK})
  add_executable(${name} main.cpp)
  if(A_SOURCES)
    add_library(${name}_app STATIC ${A_SOURCES})
    target_include_directories(${name}_app PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(${name}_app PUBLIC ${A_LINK} salma_app_common salma_flags)
    target_link_libraries(${name} PRIVATE ${name}_app)
  endif()
  target_link_libraries(${name} PRIVATE ${A_LINK} salma_app_common salma_flags)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  install(TARGETS ${name})
endfunction()

# salma_add_bench(<name> SOURCES <cpp>... LINK <target>...)
# A program that measures; built as bench/<name> of the build folder, not installed.
function(salma_add_bench name)
  cmake_parse_arguments(A "" "" "SOURCES;LINK" ${ARGN})
  add_executable(bench_${name} ${A_SOURCES})
  target_link_libraries(bench_${name} PRIVATE ${A_LINK} salma_flags)
  set_target_properties(bench_${name} PROPERTIES
    OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bench)
endfunction()

# salma_add_test(<name> [ALONE] LABEL <label> SOURCES <cpp>... LINK <target>...)
# One test program; every TEST in it is a ctest of its own. ALONE: none runs beside another test.
function(salma_add_test name)
  include(GoogleTest)
  cmake_parse_arguments(A "ALONE" "LABEL;TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT A_TIMEOUT)
    set(A_TIMEOUT 120)
  endif()
  if(SALMA_SANITIZE)
    math(EXPR A_TIMEOUT "${A_TIMEOUT} * 5")
  endif()
  add_executable(${name} ${A_SOURCES})
  target_link_libraries(${name} PRIVATE ${A_LINK} salma_test_support GTest::gtest_main salma_flags)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
                       PROPERTIES LABELS ${A_LABEL} TIMEOUT ${A_TIMEOUT} RUN_SERIAL ${A_ALONE})
endfunction()

function(salma_install_package)
  include(CMakePackageConfigHelpers)
  set(dir ${CMAKE_INSTALL_LIBDIR}/cmake/salma)
  configure_package_config_file(cmake/salmaConfig.cmake.in salmaConfig.cmake INSTALL_DESTINATION ${dir})
  write_basic_package_version_file(salmaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/salmaConfig.cmake ${PROJECT_BINARY_DIR}/salmaConfigVersion.cmake
          DESTINATION ${dir})
  install(EXPORT salmaTargets NAMESPACE salma:: DESTINATION ${dir})
endfunction()
