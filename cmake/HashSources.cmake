# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DOUTPUT=file.h -DFOLDER=core/traffic -DNAME=kConstant -P HashSources.cmake
# Writes a header with the hash of all C++ files of a folder: what they make is kept under it.
file(GLOB files ${FOLDER}/*.cpp ${FOLDER}/*.h)
list(SORT files)
set(all "")
foreach(file IN LISTS files)
    file(SHA256 ${file} hash)
    string(APPEND all ${hash})
endforeach()
string(SHA256 hash "${all}")
file(WRITE ${OUTPUT} "// Written by cmake/HashSources.cmake.
#pragma once

namespace reflet {
inline constexpr const char* ${NAME} = \"${hash}\";
}  // namespace reflet
")
