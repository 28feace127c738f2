# SPDX-License-Identifier: GPL-3.0-or-later
# The arrows of the house, checked when CMake configures: which of Reflet's targets may reach which,
# and which third-party families each may reach, over everything that they link, through however
# many targets. A forbidden edge stops the configuration with the path that leads to it.
#
#   app/desktop > app/shell > app/document > app/pipeline > importers, core/gpu, core/io > core
#                     app/shell > widgets > core/gpu, core
#   app/cli > app/pipeline                              (importers may use core/io)

# ---- The rules ----

# One row per target: NAME, then TARGETS it may reach, then the FAMILIES of libraries below.
function(_reflet_arrow name)
    cmake_parse_arguments(ARG "" "" "TARGETS;FAMILIES" ${ARGN})
    set_property(GLOBAL APPEND PROPERTY REFLET_GRAPH_KNOWN ${name})
    set_property(GLOBAL PROPERTY REFLET_GRAPH_TARGETS_${name} "${ARG_TARGETS}")
    set_property(GLOBAL PROPERTY REFLET_GRAPH_FAMILIES_${name} "${ARG_FAMILIES}")
endfunction()

function(_reflet_define_arrows)
    set_property(GLOBAL PROPERTY REFLET_GRAPH_KNOWN "")
    set(engine reflet_core reflet_io reflet_gpu reflet_importers)
    set(libraries OpenGL OpenImageIO GDAL)
    _reflet_arrow(reflet_core)
    _reflet_arrow(reflet_io TARGETS reflet_core FAMILIES OpenImageIO GDAL)
    _reflet_arrow(reflet_gpu TARGETS reflet_core FAMILIES OpenGL)
    _reflet_arrow(reflet_importers TARGETS reflet_core reflet_io FAMILIES OpenImageIO GDAL)
    _reflet_arrow(reflet_pipeline TARGETS ${engine} FAMILIES ${libraries})
    _reflet_arrow(reflet_cli TARGETS ${engine} reflet_pipeline FAMILIES ${libraries})
    _reflet_arrow(reflet-cli TARGETS ${engine} reflet_pipeline reflet_cli FAMILIES ${libraries})
    _reflet_arrow(reflet_widgets TARGETS reflet_core reflet_gpu FAMILIES OpenGL Qt)
    _reflet_arrow(reflet_document TARGETS ${engine} reflet_pipeline FAMILIES ${libraries} Qt)
    set(desktop ${engine} reflet_pipeline reflet_document reflet_widgets)
    _reflet_arrow(reflet_shell TARGETS ${desktop} FAMILIES ${libraries} Qt)
    _reflet_arrow(reflet TARGETS ${desktop} reflet_shell FAMILIES ${libraries} Qt)
endfunction()

# What belongs to a family: CMake targets, plain names, -l flags and paths of libraries alike.
set(_reflet_families Qt OpenGL OpenImageIO GDAL)
set(_reflet_family_Qt "^Qt[0-9]*(::|[A-Z])")
set(_reflet_family_OpenGL
    "^(OpenGL::|(OpenGL|GLX|GL|GLU|GLEW|EGL|GLESv[12].*|GLdispatch|OSMesa|epoxy|glfw3?|gbm)$|epoxy::|GLEW::|GLUT::|glfw)")
set(_reflet_family_OpenImageIO "^OpenImageIO(_Util)?(::|$)")
set(_reflet_family_GDAL "^(GDAL::|gdal$|GDAL$)")

# Tests, fuzzers and benchmarks stand outside the house, but those of core's own folders load no
# more than core does: starting OpenImageIO alone costs a quarter of a second in every process.
set(_reflet_outside "^(test|fuzz|bench)_")
set(_reflet_core_tests
    "/tests/unit/(base|math|geo|city|heightfield|environment|baking|reconstruction|glossy|curved|traffic|coverage|rendering|project|samples)$")

# ---- The walk ----

# All targets that are built from `folder` and below.
function(_reflet_targets_below folder result)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
    foreach(subfolder IN LISTS subfolders)
        _reflet_targets_below(${subfolder} below)
        list(APPEND targets ${below})
    endforeach()
    set(${result} ${targets} PARENT_SCOPE)
endfunction()

# The names in link items, generator expressions opened up: whatever may be linked in some
# configuration counts as linked.
function(_reflet_names_in items result)
    string(REGEX REPLACE "::@\\([^)]*\\)" "" items "${items}")
    string(REGEX REPLACE "\\$<TARGET_(EXISTS|POLICY|PROPERTY|GENEX_EVAL):[^<>]*>" "" items "${items}")
    string(REGEX REPLACE "\\$<[A-Za-z_]+:" ";" items "${items}")
    string(REGEX REPLACE "\\$<|>:|>|," ";" items "${items}")
    list(REMOVE_DUPLICATES items)
    list(REMOVE_ITEM items "")
    set(${result} "${items}" PARENT_SCOPE)
endfunction()

# "-lGL", "/usr/lib/libGL.so.1" and "libGL.a" are all GL.
function(_reflet_plain_name item result)
    if(NOT item MATCHES "::")
        get_filename_component(item "${item}" NAME)
        string(REGEX REPLACE "^-l:?" "" item "${item}")
        if(item MATCHES "\\.(so|a)([.0-9]*)$")
            string(REGEX REPLACE "\\.(so|a)[.0-9]*$" "" item "${item}")
            string(REGEX REPLACE "^lib" "" item "${item}")
        endif()
    endif()
    set(${result} "${item}" PARENT_SCOPE)
endfunction()

# What a target links, publicly or not, and what it makes others link.
function(_reflet_edges_of target result)
    get_property(known GLOBAL PROPERTY "REFLET_GRAPH_EDGES_${target}" SET)
    if(NOT known)
        set(items "")
        set(properties LINK_LIBRARIES INTERFACE_LINK_LIBRARIES INTERFACE_LINK_LIBRARIES_DIRECT
            LINK_OPTIONS INTERFACE_LINK_OPTIONS)
        get_target_property(imported ${target} IMPORTED)
        if(imported)
            list(APPEND properties IMPORTED_LINK_INTERFACE_LIBRARIES IMPORTED_LINK_DEPENDENT_LIBRARIES
                IMPORTED_LOCATION IMPORTED_LIBNAME)
            get_target_property(configurations ${target} IMPORTED_CONFIGURATIONS)
            foreach(configuration IN LISTS configurations)
                foreach(kind LINK_INTERFACE_LIBRARIES LINK_DEPENDENT_LIBRARIES LOCATION)
                    list(APPEND properties IMPORTED_${kind}_${configuration})
                endforeach()
            endforeach()
        endif()
        foreach(property IN LISTS properties)
            get_property(value TARGET ${target} PROPERTY ${property})
            list(APPEND items ${value})
        endforeach()
        # Objects of another target may come as sources.
        get_property(sources TARGET ${target} PROPERTY SOURCES)
        list(FILTER sources INCLUDE REGEX "TARGET_OBJECTS:")
        _reflet_names_in("${items};${sources}" names)
        set_property(GLOBAL PROPERTY "REFLET_GRAPH_EDGES_${target}" "${names}")
    endif()
    get_property(names GLOBAL PROPERTY "REFLET_GRAPH_EDGES_${target}")
    set(${result} "${names}" PARENT_SCOPE)
endfunction()

# Why `start` may not reach `name`, which `current` links; empty when it may.
function(_reflet_objection start current name may_reach families result)
    set(${result} "" PARENT_SCOPE)
    get_property(known GLOBAL PROPERTY REFLET_GRAPH_KNOWN)
    if(name IN_LIST known AND NOT may_reach STREQUAL "everything" AND NOT name IN_LIST may_reach)
        set(${result} "${start} may not reach ${name}" PARENT_SCOPE)
        return()
    endif()
    _reflet_plain_name("${name}" plain)
    foreach(family IN LISTS _reflet_families)
        if(NOT family IN_LIST families AND plain MATCHES "${_reflet_family_${family}}")
            set(${result} "${start} may not reach ${family}" PARENT_SCOPE)
            return()
        endif()
    endforeach()
    # Installed libraries also list what they were linked with themselves, by names without targets.
    get_target_property(installed ${current} IMPORTED)
    if(name MATCHES "::" AND NOT TARGET "${name}" AND NOT installed)
        set(${result} "${start} links ${name}, which cannot be seen into: find its package in \
cmake/RefletDependencies.cmake, for all folders" PARENT_SCOPE)
    endif()
endfunction()

# Walks everything that `start` reaches, nearest first, and lists what it may not reach together
# with the shortest path to it.
function(_reflet_walk start may_reach families result)
    set(queue ${start})
    set(seen ${start})
    set(path_of_${start} "${start}")
    set(problems "")
    while(queue)
        list(POP_FRONT queue current)
        _reflet_edges_of(${current} names)
        foreach(name IN LISTS names)
            if(TARGET "${name}")
                get_target_property(aliased "${name}" ALIASED_TARGET)
                if(aliased)
                    set(name ${aliased})
                endif()
            endif()
            if(name IN_LIST seen)
                continue()
            endif()
            list(APPEND seen "${name}")
            set("path_of_${name}" "${path_of_${current}} -> ${name}")
            _reflet_objection(${start} ${current} "${name}" "${may_reach}" "${families}" objection)
            if(objection)
                list(APPEND problems "${objection}:\n    ${path_of_${name}}")
            elseif(TARGET "${name}")
                list(APPEND queue "${name}")
            endif()
        endforeach()
    endwhile()
    set(${result} "${problems}" PARENT_SCOPE)
endfunction()

function(_reflet_check_target target result)
    get_property(known GLOBAL PROPERTY REFLET_GRAPH_KNOWN)
    get_target_property(folder ${target} SOURCE_DIR)
    if(target IN_LIST known)
        get_property(may_reach GLOBAL PROPERTY REFLET_GRAPH_TARGETS_${target})
        get_property(families GLOBAL PROPERTY REFLET_GRAPH_FAMILIES_${target})
    elseif(target MATCHES "${_reflet_outside}")
        set(may_reach everything)
        set(families ${_reflet_families})
        if(folder MATCHES "${_reflet_core_tests}")
            set(families "")
        endif()
    else()
        set(${result} "${target} has no place in the house: give it a row in cmake/LinkGraph.cmake"
            PARENT_SCOPE)
        return()
    endif()
    _reflet_walk(${target} "${may_reach}" "${families}" problems)
    set(${result} "${problems}" PARENT_SCOPE)
endfunction()

# To be called once, at the end of the outermost CMakeLists.txt: every target exists by then.
function(reflet_check_link_graph)
    _reflet_define_arrows()
    _reflet_targets_below(${CMAKE_CURRENT_SOURCE_DIR} targets)
    set(problems "")
    set(checked 0)
    foreach(target IN LISTS targets)
        get_target_property(type ${target} TYPE)
        if(NOT type STREQUAL "UTILITY")
            _reflet_check_target(${target} found)
            list(APPEND problems ${found})
            math(EXPR checked "${checked} + 1")
        endif()
    endforeach()
    if(problems)
        list(JOIN problems "\n  " text)
        message(FATAL_ERROR "The link graph breaks the rules of the house (CONTRIBUTING.md, \"The house\"):\n  ${text}")
    endif()
    message(STATUS "Link graph: ${checked} targets keep to the house")
endfunction()
