# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DOUTPUT=file.cpp -DFOLDER=resources/shaders -P EmbedShaders.cmake
# Writes all shaders of a folder into one C++ file (core/gpu/base/EmbeddedShaders.h).
file(GLOB files ${FOLDER}/*.glsl)
list(SORT files)
set(text "// Written by cmake/EmbedShaders.cmake.\n#include \"core/gpu/base/EmbeddedShaders.h\"\n\n")
string(APPEND text "namespace reflet {\n\nnamespace {\nconst EmbeddedShader kShaders[] = {\n")
foreach(file IN LISTS files)
    get_filename_component(name ${file} NAME)
    file(READ ${file} source)
    string(APPEND text "    {\"${name}\", R\"glsl(${source})glsl\"},\n")
endforeach()
string(APPEND text "};\n}  // namespace\n\nstd::span<const EmbeddedShader> embeddedShaders() {\n")
string(APPEND text "    return kShaders;\n}\n\n}  // namespace reflet\n")
file(WRITE ${OUTPUT} "${text}")
