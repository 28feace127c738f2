# SPDX-License-Identifier: GPL-3.0-or-later
# How Reflet's own targets are made.

# A static library; sources are added by the folders with target_sources().
function(reflet_library name)
    add_library(${name} STATIC)
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
    set_property(GLOBAL APPEND PROPERTY REFLET_TARGETS ${name})
endfunction()

function(reflet_executable name)
    add_executable(${name} ${ARGN})
    set_property(GLOBAL APPEND PROPERTY REFLET_TARGETS ${name})
endfunction()

# reflet_test(NAME SOURCES a.cpp ... LIBS reflet_core ... [LABELS tsan ...] [RESOURCE_LOCK x])
# A GoogleTest program whose tests ctest lists one by one.
function(reflet_test name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LIBS;LABELS" ${ARGN})
    add_executable(test_${name} ${ARG_SOURCES})
    target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(test_${name} PRIVATE ${ARG_LIBS} GTest::gtest_main)
    target_compile_definitions(test_${name} PRIVATE REFLET_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    include(GoogleTest)
    gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
        PROPERTIES LABELS "${ARG_LABELS}" SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
endfunction()

# A libFuzzer program (clang, REFLET_FUZZ); its corpus lies in tests/fuzz/corpus/NAME.
function(reflet_fuzzer name)
    if(NOT REFLET_FUZZ)
        return()
    endif()
    cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
    add_executable(fuzz_${name} ${ARG_SOURCES})
    target_include_directories(fuzz_${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(fuzz_${name} PRIVATE ${ARG_LIBS})
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
endfunction()
