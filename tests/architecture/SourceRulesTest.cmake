# SPDX-License-Identifier: GPL-3.0-or-later
# Run by `cmake -P`: the rules find each kind of fault in small trees, and nothing in a sound one.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/SourceRules.cmake)

set(tree ${REFLET_SCRATCH}/source-rules)

# Puts a file with a licence line and these lines into the tree.
function(put path)
    list(JOIN ARGN "\n" text)
    file(WRITE ${tree}/${path} "// ${spdx}\n${text}\n")
endfunction()

function(start_tree)
    file(REMOVE_RECURSE ${tree})
    put(core/base/Files.h)
    put(core/city/CityModel.h "#include \"core/base/Files.h\"")
    put(core/glossy/Dome.h)
    put(core/io/ImageFile.h)
    put(core/gpu/GlContext.h)
    put(app/pipeline/Bake.h)
    put(app/pipeline/Version.h.in)
endfunction()

# The tree with one more file must have exactly one problem, this one; or none when it is empty.
function(expect problem path)
    start_tree()
    put(${path} ${ARGN})
    judge("${problem}" "${path}")
endfunction()

function(judge problem path)
    find_source_problems(${tree} problems count)
    set_property(GLOBAL APPEND PROPERTY CASES ${path})
    if(NOT "${problems}" STREQUAL "${problem}")
        set_property(GLOBAL APPEND_STRING PROPERTY FAILURES
            "${path}: expected \"${problem}\", found \"${problems}\"\n")
    endif()
endfunction()

# Sound.
expect("" core/city/Sound.cpp "#include \"core/city/CityModel.h\"" "#include \"core/base/Files.h\""
    "#include <CGAL/Plane_3.h>" "#include <vector>" "// #include \"core/io/ImageFile.h\"")
expect("" core/base/ParallelFor.cpp "#include <tbb/parallel_for.h>")
expect("" core/io/ImageFile.cpp "#include <OpenImageIO/imageio.h>" "#include <gdal_priv.h>")
expect("" core/gpu/GlContext.cpp "#include <epoxy/gl.h>" "#include \"core/city/CityModel.h\"")
expect("" widgets/Viewport.h "#include <QOpenGLWidget>" "#include \"core/gpu/GlContext.h\"")
expect("" app/cli/DoctorCommand.cpp "#include \"app/pipeline/Version.h\"")
expect("" app/cli/BakeCommand.cpp "#include \"app/pipeline/Bake.h\"")

# The order inside core.
expect("core/base/A.cpp: may not include \"core/city/CityModel.h\": the order inside core"
    core/base/A.cpp "#include \"core/city/CityModel.h\"")
expect("core/curved/A.h: may not include \"core/glossy/Dome.h\": the order inside core"
    core/curved/A.h "  #  include \"core/glossy/Dome.h\"")

# The arrows between zones.
expect("core/city/A.cpp: may not include \"core/io/ImageFile.h\""
    core/city/A.cpp "#include \"core/io/ImageFile.h\"")
expect("importers/obj/A.cpp: may not include \"core/gpu/GlContext.h\""
    importers/obj/A.cpp "#include \"core/gpu/GlContext.h\"")
expect("widgets/A.cpp: may not include \"app/pipeline/Bake.h\""
    widgets/A.cpp "#include \"app/pipeline/Bake.h\"")
expect("core/io/A.cpp: may not include \"core/gpu/GlContext.h\""
    core/io/A.cpp "#include \"core/gpu/GlContext.h\"")

# Third parties in headers, and where they don't belong.
expect("core/city/A.h: <CGAL/Plane_3.h>: CGAL belongs in .cpp files"
    core/city/A.h "#include <CGAL/Plane_3.h>")
expect("core/gpu/A.h: <epoxy/gl.h>: OpenGL belongs in .cpp files"
    core/gpu/A.h "#include <epoxy/gl.h>")
expect("core/io/A.h: <gdal.h>: GDAL belongs in .cpp files" core/io/A.h "#include <gdal.h>")
expect("core/city/A.cpp: <QString>: Qt is not for this folder" core/city/A.cpp "#include <QString>")
expect("app/pipeline/A.h: <QtCore/QString>: Qt belongs in .cpp files"
    app/pipeline/A.h "#include <QtCore/QString>")
expect("core/city/A.cpp: <ogrsf_frmts.h>: GDAL is not for this folder"
    core/city/A.cpp "#include <ogrsf_frmts.h>")
expect("importers/obj/A.cpp: <EGL/egl.h>: OpenGL is not for this folder"
    importers/obj/A.cpp "#include <EGL/egl.h>")
expect("core/city/A.cpp: <oneapi/tbb.h>: TBB is not for this folder"
    core/city/A.cpp "#include <oneapi/tbb.h>")
expect("app/cli/A.h: <embree3/rtcore.h>: Embree belongs in .cpp files"
    app/cli/A.h "#include <embree3/rtcore.h>")
expect("core/geo/A.h: <proj.h>: PROJ belongs in .cpp files" core/geo/A.h "#include <proj.h>")
expect("importers/A.h: <simdjson.h>: simdjson belongs in .cpp files"
    importers/A.h "#include <simdjson.h>")

# A header that .cpp files of its own folder alone include may hold what those may include.
function(expect_of_private_header problem includer)
    start_tree()
    put(core/geo/ProjHandles.h "#include <proj.h>")
    put(core/geo/Crs.cpp "#include \"core/geo/ProjHandles.h\"")
    put(${includer} "#include \"core/geo/ProjHandles.h\"")
    judge("${problem}" "private header, included by ${includer}")
endfunction()
expect_of_private_header("" core/geo/CrsTransform.cpp)
set(shown "core/geo/ProjHandles.h: <proj.h>: PROJ belongs in .cpp files")
expect_of_private_header("${shown}" core/geo/Crs.h)
expect_of_private_header("${shown}" core/city/A.cpp)

# Paths and folders that are not known.
expect("core/city/A.cpp: includes \"CityModel.h\", which is no path from the project's root"
    core/city/A.cpp "#include \"CityModel.h\"")
expect("core/misc/A.cpp: lies in no folder of the house: name it in tests/architecture/SourceRules.cmake"
    core/misc/A.cpp)

# Licences.
function(expect_licence_problem path text)
    start_tree()
    file(WRITE ${tree}/${path} "${text}")
    judge("${path}: has no line \"${spdx}\" at its top" ${path})
endfunction()
expect_licence_problem(core/city/A.cpp "#include <vector>\n")
expect_licence_problem(core/city/A.h "// SPDX-License-Identifier: MIT\n")
expect_licence_problem(tests/unit/city/CMakeLists.txt "")
expect_licence_problem(cmake/Extra.cmake "set(a b)\n# late\n# ${spdx}\n")
expect_licence_problem(resources/shaders/sky.frag.glsl "#version 450 core\n")
expect_licence_problem(dev "#!/bin/bash\nset -e\n# ${spdx}\n")
expect_licence_problem(.ci/run "#!/bin/bash\n")

file(REMOVE_RECURSE ${tree})
get_property(cases GLOBAL PROPERTY CASES)
get_property(failures GLOBAL PROPERTY FAILURES)
list(LENGTH cases count)
if(failures)
    message(FATAL_ERROR "${failures}")
elseif(count LESS 30)
    message(FATAL_ERROR "only ${count} cases ran")
endif()
message(STATUS "${count} trees were judged as they should be")
