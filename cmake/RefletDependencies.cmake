# SPDX-License-Identifier: GPL-3.0-or-later
# Third-party packages of Debian 12. Each is linked PRIVATE by the one target that wraps it.

find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(glm CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(tl-expected CONFIG REQUIRED)
find_package(TBB CONFIG REQUIRED)  # before CGAL, which ships a FindTBB of its own
find_package(nlohmann_json CONFIG REQUIRED)
find_package(simdjson CONFIG REQUIRED)
find_package(pugixml CONFIG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PROJ CONFIG REQUIRED)
find_package(CGAL CONFIG REQUIRED)
find_package(embree 3 CONFIG REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
find_package(draco CONFIG REQUIRED)
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)  # compiled by importers/gltf: the library has no options
find_package(CLI11 CONFIG REQUIRED)
find_package(GDAL CONFIG REQUIRED)
find_path(OSMIUM_INCLUDE_DIR osmium/io/reader.hpp REQUIRED)  # libosmium, of headers alone
find_package(EXPAT REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
# OpenImageIO's CMake package needs its tools and lists a folder that does not exist; pkg-config is sound.
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(GEOGRAPHICLIB REQUIRED IMPORTED_TARGET geographiclib)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)  # its CMake package wants its parts for tests too
pkg_check_modules(CITYGML IMPORTED_TARGET citygml)  # for tests alone, where it is installed
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)  # its CMake files name tools of another package
find_package(Qt6 6.4 CONFIG REQUIRED COMPONENTS Core Gui Widgets OpenGL OpenGLWidgets Svg Test)
if(REFLET_TESTS)
    find_package(GTest CONFIG REQUIRED)
endif()
