// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/base/ShaderLibrary.h"

#include "core/gpu/base/EmbeddedShaders.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace reflet {

namespace {

constexpr std::string_view kRemedy =
    "Update the graphics driver, or start with LIBGL_ALWAYS_SOFTWARE=1.";

const EmbeddedShader* find(std::string_view file) {
    const auto all = embeddedShaders();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const EmbeddedShader& s) { return s.name == file; });
    return found == all.end() ? nullptr : &*found;
}

/// The text between quotes of an #include line; empty for any other line.
std::string_view includedFile(std::string_view line) {
    constexpr std::string_view kWord = "#include \"";
    if (!line.starts_with(kWord))
        return {};
    line.remove_prefix(kWord.size());
    return line.substr(0, line.find('"'));
}

/// Appends a file; the second number of #line tells the driver's messages which file it was.
Result<void> append(std::string_view file, std::set<std::string, std::less<>>& done,
                    const std::vector<std::string>& defines, std::string& out) {
    const auto text = shaderText(file);
    if (!text)
        return tl::unexpected(text.error());
    const std::size_t number = done.size();
    done.emplace(file);
    int lineNumber = 0;
    for (std::string_view rest = *text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end);
        ++lineNumber;
        const std::string_view part = includedFile(line);
        if (part.empty()) {
            out += line;
        } else if (!done.contains(part)) {
            out += fmt::format("#line 1 {}\n", done.size());
            if (auto added = append(part, done, {}, out); !added)
                return added;
            out += fmt::format("#line {} {}\n", lineNumber + 1, number);
        }
        if (line.starts_with("#version")) {
            for (const std::string& define : defines)
                out += "#define " + define + "\n";
            out += fmt::format("#line {} {}\n", lineNumber + 1, number);
        }
    }
    if (!out.ends_with('\n'))
        out += '\n';
    return {};
}

GLenum stageOf(std::string_view file) {
    if (file.ends_with(".vert.glsl"))
        return GL_VERTEX_SHADER;
    if (file.ends_with(".geom.glsl"))
        return GL_GEOMETRY_SHADER;
    return file.ends_with(".comp.glsl") ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER;
}

template <class Length, class Read>
std::string driverLog(unsigned id, Length length, Read read) {
    GLint size = 0;
    length(id, GL_INFO_LOG_LENGTH, &size);
    std::string text(std::size_t(std::max(size, 1)), '\0');
    GLsizei written = 0;
    read(id, GLsizei(text.size()), &written, text.data());
    text.resize(std::size_t(written));
    return text;
}

Result<void> attachStage(unsigned program, const std::string& file,
                         const std::vector<std::string>& defines) {
    const auto source = shaderSource(file, defines);
    if (!source)
        return tl::unexpected(source.error());
    const unsigned shader = glCreateShader(stageOf(file));
    const char* text = source->c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    Result<void> result;
    if (compiled == GL_FALSE) {
        result = fail(ErrorCode::Internal,
                      "the graphics driver does not compile a shader: " +
                          driverLog(shader, glGetShaderiv, glGetShaderInfoLog),
                      file, std::string(kRemedy));
    }
    glAttachShader(program, shader);
    glDeleteShader(shader);  // lives as long as the program
    return result;
}

}  // namespace

Result<std::string_view> shaderText(std::string_view file) {
    if (const EmbeddedShader* shader = find(file))
        return shader->text;
    return fail(ErrorCode::Internal, "there is no shader of that name", std::string(file));
}

std::vector<std::string> shaderFiles() {
    std::vector<std::string> files;
    for (const EmbeddedShader& shader : embeddedShaders())
        files.emplace_back(shader.name);
    std::sort(files.begin(), files.end());
    return files;
}

Result<std::string> shaderSource(std::string_view file, const std::vector<std::string>& defines) {
    std::string out;
    std::set<std::string, std::less<>> done;
    if (auto added = append(file, done, defines, out); !added)
        return tl::unexpected(added.error().in(fmt::format("while reading {}", file)));
    return out;
}

std::vector<std::string> programNames() {
    std::vector<std::string> names;
    for (const std::string& file : shaderFiles()) {
        if (file.ends_with(".frag.glsl") || file.ends_with(".comp.glsl"))
            names.push_back(file.substr(0, file.size() - 10));
    }
    return names;
}

Result<std::vector<std::string>> programStages(std::string_view name) {
    const std::string base(name);
    if (find(base + ".comp.glsl") != nullptr)
        return std::vector<std::string>{base + ".comp.glsl"};
    const std::string fragment = base + ".frag.glsl";
    const auto text = shaderText(fragment);
    if (!text)
        return tl::unexpected(text.error());
    std::vector<std::string> stages{fragment};
    constexpr std::string_view kOther = "// vertex: ";
    if (const std::size_t at = text->find(kOther); at != std::string_view::npos) {
        const std::string_view rest = text->substr(at + kOther.size());
        stages.emplace_back(rest.substr(0, rest.find('\n')));
    } else {
        stages.push_back(base + ".vert.glsl");
    }
    if (find(base + ".geom.glsl") != nullptr)
        stages.push_back(base + ".geom.glsl");
    return stages;
}

Result<Program> makeProgram(std::string_view name, const std::vector<std::string>& defines) {
    const auto stages = programStages(name);
    if (!stages)
        return tl::unexpected(stages.error());
    Program program(glCreateProgram());
    for (const std::string& stage : *stages) {
        if (auto attached = attachStage(program.id(), stage, defines); !attached)
            return tl::unexpected(attached.error());
    }
    glLinkProgram(program.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        return fail(ErrorCode::Internal,
                    "the graphics driver does not link a program: " +
                        driverLog(program.id(), glGetProgramiv, glGetProgramInfoLog),
                    std::string(name), std::string(kRemedy));
    }
    return program;
}

}  // namespace reflet
