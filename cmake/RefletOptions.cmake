# SPDX-License-Identifier: GPL-3.0-or-later
# Language, warnings and the switches of the presets.

option(REFLET_TESTS "Build the tests" ON)
option(REFLET_WERROR "Treat warnings as errors" OFF)
option(REFLET_FUZZ "Build the libFuzzer targets (clang)" OFF)
option(REFLET_STD_THREAD "Run parallel loops on std::thread instead of oneTBB (thread sanitizer)" OFF)
set(REFLET_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, e.g. address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()

find_program(REFLET_CCACHE ccache)
if(REFLET_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${REFLET_CCACHE})
endif()

# Every processor since 2009; faster paths are chosen at run time (Embree, Highway).
add_compile_options(-march=x86-64-v2 -fno-math-errno -ffp-contract=off)
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-qual)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # False alarms of GCC 12 on std::string and fmt at -O3 (GCC bugs 105329, 105651).
    add_compile_options(-Wno-restrict -Wno-stringop-overflow)
endif()
if(REFLET_WERROR)
    add_compile_options(-Werror)
endif()
# A program loads the libraries that it calls, not all that its own libraries could: a test of an
# importer does without OpenImageIO, whose start takes a quarter of a second.
add_link_options(-Wl,--as-needed)
if(REFLET_SANITIZE)
    add_compile_options(-fsanitize=${REFLET_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${REFLET_SANITIZE})
endif()
if(REFLET_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link
                        -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/ubsan-ignore.txt)
endif()
