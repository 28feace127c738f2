# SPDX-License-Identifier: GPL-3.0-or-later
# How Reflet's own targets are made.

# A static library; sources are added by the folders with target_sources().
function(reflet_library name)
    add_library(${name} STATIC)
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
endfunction()

# Makes a target one that uses Qt, with Qt's strict settings.
function(reflet_uses_qt name)
    set_target_properties(${name} PROPERTIES AUTOMOC ON AUTORCC ON)
    target_compile_definitions(${name} PRIVATE QT_NO_KEYWORDS QT_NO_FOREACH QT_NO_CAST_TO_ASCII
        QT_NO_URL_CAST_FROM_STRING QT_NO_NARROWING_CONVERSIONS_IN_CONNECT QT_STRICT_ITERATORS)
endfunction()

add_custom_target(programs)  # all that users start

function(reflet_executable name)
    add_executable(${name} ${ARGN})
    add_dependencies(programs ${name})
endfunction()

# Groups of programs that the sanitizer builds make instead of everything.
add_custom_target(sanitized_tests)  # the tests of core and importers
add_custom_target(tsan_tests)       # those labelled tsan
add_custom_target(fuzzers)

# reflet_test(NAME SOURCES a.cpp ... LIBS reflet_core ... [LABELS tsan|heavy] [TIMEOUT seconds])
# A GoogleTest program whose tests ctest lists one by one. One label at most. Those labelled heavy
# model whole vehicles or cities, from no input: minutes each under a sanitizer, so they stay out there.
function(reflet_test name)
    cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBS;LABELS" ${ARGN})
    add_executable(test_${name} ${ARG_SOURCES})
    target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(test_${name} PRIVATE ${ARG_LIBS} GTest::gtest_main)
    target_compile_definitions(test_${name} PRIVATE REFLET_SOURCE_DIR="${PROJECT_SOURCE_DIR}")

    set(properties SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
    if(ARG_TIMEOUT)
        list(APPEND properties TIMEOUT ${ARG_TIMEOUT})
    endif()
    list(LENGTH ARG_LABELS labels)
    if(labels GREATER 1)
        # gtest_discover_tests() hands its properties on as one flat list.
        message(FATAL_ERROR "test_${name}: a test program has one label at most")
    elseif(labels EQUAL 1)
        list(APPEND properties LABELS ${ARG_LABELS})
    endif()
    include(GoogleTest)
    gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 120
        PROPERTIES ${properties})

    set(others ${ARG_LIBS})
    list(FILTER others INCLUDE REGEX "^reflet_")
    list(REMOVE_ITEM others reflet_core reflet_importers)
    if(NOT others AND NOT "heavy" IN_LIST ARG_LABELS)
        add_dependencies(sanitized_tests test_${name})
    endif()
    if("tsan" IN_LIST ARG_LABELS)
        add_dependencies(tsan_tests test_${name})
    endif()
endfunction()

# reflet_ui_test(NAME SOURCES a.cpp ... LIBS reflet_shell ... [TIMEOUT seconds])
# A GoogleTest program that shows real windows: each test runs on an X server of its own with a
# window manager. The program's main() comes from tests/support/QtTestMain.cpp.
function(reflet_ui_test name)
    cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBS" ${ARGN})
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT 300)
    endif()
    add_executable(test_${name} ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/tests/support/QtTestMain.cpp)
    reflet_uses_qt(test_${name})
    set_target_properties(test_${name} PROPERTIES
        CROSSCOMPILING_EMULATOR ${PROJECT_SOURCE_DIR}/tests/support/with-display)
    target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(test_${name} PRIVATE ${ARG_LIBS} Qt6::Widgets Qt6::Test GTest::gtest)
    target_compile_definitions(test_${name} PRIVATE REFLET_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    include(GoogleTest)
    gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 120
        PROPERTIES TIMEOUT ${ARG_TIMEOUT} SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]" LABELS ui)
endfunction()

# reflet_fuzzer(NAME SOURCES a.cpp ... LIBS ...)
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
    add_dependencies(fuzzers fuzz_${name})
endfunction()
