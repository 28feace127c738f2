# SPDX-License-Identifier: GPL-3.0-or-later
# Run by `cmake -P`: every source of Reflet keeps to the rules.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/SourceRules.cmake)

get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
find_source_problems(${root} problems count)
if(problems)
    list(JOIN problems "\n  " text)
    message(FATAL_ERROR "These break the rules of tests/architecture/SourceRules.cmake:\n  ${text}")
elseif(count LESS 100)
    message(FATAL_ERROR "only ${count} files were found in ${root}")
endif()
message(STATUS "${count} checks of files found nothing")
