# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DTEMPLATE=file.h.in -DOUTPUT=file.h -DFOLDER=core/traffic -P HashSources.cmake
# Writes the template with REFLET_HASH, the hash of all C++ files of a folder.
file(GLOB files ${FOLDER}/*.cpp ${FOLDER}/*.h)
list(SORT files)
set(all "")
foreach(file IN LISTS files)
    file(SHA256 ${file} hash)
    string(APPEND all ${hash})
endforeach()
string(SHA256 REFLET_HASH "${all}")
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
file(TOUCH ${OUTPUT})  # which else stays older than what it is made of
