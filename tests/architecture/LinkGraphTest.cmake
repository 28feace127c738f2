# SPDX-License-Identifier: GPL-3.0-or-later
# Run by `cmake -P`: configures scratch projects that use cmake/LinkGraph.cmake and sees that the
# house is accepted and that each forbidden edge is refused with the path that leads to it.
cmake_minimum_required(VERSION 3.25)

get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
set(scratch ${REFLET_SCRATCH}/link-graph)

# Configures a project of interface targets (no compiler needed) with `code` after the house.
function(configure name code)
    file(REMOVE_RECURSE ${scratch}/${name})
    file(WRITE ${scratch}/${name}/CMakeLists.txt "
        cmake_minimum_required(VERSION 3.25)
        project(Scratch LANGUAGES NONE)
        include(${root}/cmake/LinkGraph.cmake)
        foreach(target reflet_core reflet_io reflet_gpu reflet_importers reflet_pipeline reflet_cli
                       reflet-cli reflet_widgets reflet_document reflet_shell reflet)
            add_library(\${target} INTERFACE)
        endforeach()
        foreach(target Qt6::Core Qt6::Widgets OpenGL::OpenGL OpenImageIO::OpenImageIO GDAL::GDAL
                       fmt::fmt)
            add_library(\${target} INTERFACE IMPORTED)
        endforeach()
        ${code}
        reflet_check_link_graph()\n")
    execute_process(COMMAND ${CMAKE_COMMAND} -S ${scratch}/${name} -B ${scratch}/${name}/build
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    set(status "${status}" PARENT_SCOPE)
    set(output "${output}" PARENT_SCOPE)
endfunction()

# Notes a case and, unless `problem` is empty, what is wrong with it.
function(record name problem)
    set_property(GLOBAL APPEND PROPERTY CASES ${name})
    if(problem)
        set_property(GLOBAL APPEND_STRING PROPERTY FAILURES "${name}: ${problem}\n${output}\n")
    endif()
endfunction()

# The project must be accepted.
function(accepts name code)
    configure(${name} "${code}")
    set(problem "")
    if(NOT status EQUAL 0 OR NOT output MATCHES "Link graph: [0-9]+ targets keep to the house")
        set(problem "was refused")
    endif()
    record(${name} "${problem}")
endfunction()

# The project must be refused with a message that holds `objection` and `path`, word for word.
function(refuses name objection path code)
    configure(${name} "${code}")
    string(FIND "${output}" "${objection}" objection_at)
    set(path_at 0)
    if(NOT "${path}" STREQUAL "")
        string(FIND "${output}" "      ${path}\n" path_at)
    endif()
    set(problem "")
    if(status EQUAL 0)
        set(problem "was accepted")
    elseif(objection_at LESS 0 OR path_at LESS 0)
        set(problem "the message does not say: ${objection} ${path}")
    endif()
    record(${name} "${problem}")
endfunction()

set(house "
    target_link_libraries(reflet_core INTERFACE fmt::fmt)
    target_link_libraries(reflet_io INTERFACE reflet_core OpenImageIO::OpenImageIO GDAL::GDAL)
    target_link_libraries(reflet_gpu INTERFACE reflet_core OpenGL::OpenGL)
    target_link_libraries(reflet_importers INTERFACE reflet_core reflet_io)
    target_link_libraries(reflet_pipeline INTERFACE reflet_importers reflet_gpu reflet_io)
    target_link_libraries(reflet_cli INTERFACE reflet_pipeline)
    target_link_libraries(reflet-cli INTERFACE reflet_cli)
    target_link_libraries(reflet_widgets INTERFACE reflet_gpu reflet_core Qt6::Widgets)
    target_link_libraries(reflet_document INTERFACE reflet_pipeline Qt6::Core)
    target_link_libraries(reflet_shell INTERFACE reflet_document reflet_widgets)
    target_link_libraries(reflet INTERFACE reflet_shell)")

accepts(the-house-as-designed "${house}")
accepts(a-test-of-io-may-use-what-io-uses "${house}
    add_library(test_io INTERFACE)
    target_link_libraries(test_io INTERFACE reflet_io)")
accepts(custom-targets-are-no-libraries "${house}
    add_custom_target(docs)")

# Directly.
refuses(core-uses-io "reflet_core may not reach reflet_io:" "reflet_core -> reflet_io" "
    target_link_libraries(reflet_core INTERFACE reflet_io)")
refuses(core-uses-qt "reflet_core may not reach Qt:" "reflet_core -> Qt6::Core" "
    target_link_libraries(reflet_core INTERFACE Qt6::Core)")
refuses(core-uses-opengl "reflet_core may not reach OpenGL:" "reflet_core -> OpenGL::OpenGL" "
    target_link_libraries(reflet_core INTERFACE OpenGL::OpenGL)")
refuses(core-uses-gdal "reflet_core may not reach GDAL:" "reflet_core -> GDAL::GDAL" "
    target_link_libraries(reflet_core INTERFACE GDAL::GDAL)")
refuses(io-uses-opengl "reflet_io may not reach OpenGL:" "reflet_io -> OpenGL::OpenGL" "
    target_link_libraries(reflet_io INTERFACE OpenGL::OpenGL)")
refuses(importers-use-gpu "reflet_importers may not reach reflet_gpu:"
    "reflet_importers -> reflet_gpu" "
    target_link_libraries(reflet_importers INTERFACE reflet_gpu)")
refuses(widgets-use-importers "reflet_widgets may not reach reflet_importers:"
    "reflet_widgets -> reflet_importers" "
    target_link_libraries(reflet_widgets INTERFACE reflet_importers)")
refuses(document-uses-widgets "reflet_document may not reach reflet_widgets:"
    "reflet_document -> reflet_widgets" "
    target_link_libraries(reflet_document INTERFACE reflet_widgets)")

# Through others.
refuses(cli-reaches-qt "reflet-cli may not reach Qt:"
    "reflet-cli -> reflet_pipeline -> plot::plot -> Qt6::Widgets" "
    add_library(plot::plot INTERFACE IMPORTED)
    target_link_libraries(plot::plot INTERFACE Qt6::Widgets)
    target_link_libraries(reflet_pipeline INTERFACE plot::plot)
    target_link_libraries(reflet-cli INTERFACE reflet_pipeline)")
refuses(core-reaches-openimageio "reflet_core may not reach OpenImageIO:"
    "reflet_core -> one::one -> two::two -> OpenImageIO::OpenImageIO" "
    add_library(one::one INTERFACE IMPORTED)
    add_library(two::two INTERFACE IMPORTED)
    target_link_libraries(one::one INTERFACE two::two)
    target_link_libraries(two::two INTERFACE OpenImageIO::OpenImageIO)
    target_link_libraries(reflet_core INTERFACE one::one)")
refuses(pipeline-reaches-itself-from-core "reflet_core may not reach reflet_pipeline:"
    "reflet_core -> helper::helper -> reflet_pipeline" "
    add_library(helper::helper INTERFACE IMPORTED)
    target_link_libraries(helper::helper INTERFACE reflet_pipeline)
    target_link_libraries(reflet_core INTERFACE helper::helper)")
refuses(a-private-dependency-counts "reflet_io may not reach Qt:" "reflet_io -> art -> Qt6Gui" "
    add_library(art STATIC IMPORTED)
    set_target_properties(art PROPERTIES INTERFACE_LINK_LIBRARIES \"\\$<LINK_ONLY:Qt6Gui>\")
    target_link_libraries(reflet_io INTERFACE art)")
refuses(what-an-installed-library-was-linked-with-counts "reflet_io may not reach Qt:"
    "reflet_io -> art -> /usr/lib/libQt5Core.so.5" "
    add_library(art SHARED IMPORTED)
    set_target_properties(art PROPERTIES IMPORTED_CONFIGURATIONS RELEASE
        IMPORTED_LINK_DEPENDENT_LIBRARIES_RELEASE /usr/lib/libQt5Core.so.5)
    target_link_libraries(reflet_io INTERFACE art)")

# By other names.
refuses(pkg-config-target "reflet_core may not reach OpenGL:"
    "reflet_core -> PkgConfig::EPOXY -> /usr/lib/x86_64-linux-gnu/libepoxy.so" "
    add_library(PkgConfig::EPOXY INTERFACE IMPORTED)
    set_target_properties(PkgConfig::EPOXY PROPERTIES
        INTERFACE_LINK_LIBRARIES /usr/lib/x86_64-linux-gnu/libepoxy.so)
    target_link_libraries(reflet_core INTERFACE PkgConfig::EPOXY)")
refuses(plain-name "reflet_core may not reach OpenGL:" "reflet_core -> EGL" "
    target_link_libraries(reflet_core INTERFACE EGL)")
refuses(linker-flag "reflet_core may not reach GDAL:" "reflet_core -> -lgdal" "
    target_link_libraries(reflet_core INTERFACE -lgdal)")
refuses(link-option "reflet_core may not reach OpenGL:" "reflet_core -> -lGL" "
    target_link_options(reflet_core INTERFACE -lGL)")
refuses(path-of-a-library "reflet_core may not reach OpenImageIO:"
    "reflet_core -> /usr/lib/libOpenImageIO.so.2.4" "
    target_link_libraries(reflet_core INTERFACE /usr/lib/libOpenImageIO.so.2.4)")
refuses(in-one-configuration-only "reflet_core may not reach Qt:" "reflet_core -> Qt6::Core" "
    target_link_libraries(reflet_core INTERFACE \"\\$<\\$<CONFIG:Debug>:Qt6::Core>\")")
refuses(under-an-alias "reflet_core may not reach reflet_gpu:" "reflet_core -> reflet_gpu" "
    add_library(Reflet::Gpu ALIAS reflet_gpu)
    target_link_libraries(reflet_core INTERFACE Reflet::Gpu)")

# Tests of core load no more than core does.
refuses(a-test-of-core-uses-io "test_city may not reach GDAL:"
    "test_city -> reflet_io -> GDAL::GDAL" "
    target_link_libraries(reflet_io INTERFACE GDAL::GDAL)
    file(WRITE \${CMAKE_SOURCE_DIR}/tests/unit/city/CMakeLists.txt
        [[add_library(test_city INTERFACE)
          target_link_libraries(test_city INTERFACE reflet_io)]])
    add_subdirectory(tests/unit/city)")

# What cannot be checked is refused.
refuses(unknown-target "helpers has no place in the house" "" "
    add_library(helpers INTERFACE)")
refuses(package-out-of-sight "which cannot be seen into: find its package"
    "reflet_core -> hidden::hidden" "
    target_link_libraries(reflet_core INTERFACE hidden::hidden)")

file(REMOVE_RECURSE ${scratch})
get_property(cases GLOBAL PROPERTY CASES)
get_property(failures GLOBAL PROPERTY FAILURES)
list(LENGTH cases count)
if(failures)
    message(FATAL_ERROR "${failures}")
elseif(count LESS 25)
    message(FATAL_ERROR "only ${count} cases ran")
endif()
message(STATUS "${count} link graphs were judged as they should be")
