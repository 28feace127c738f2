// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/base/Program.h"

#include <epoxy/gl.h>

namespace reflet {

void deleteProgram(unsigned id) {
    glDeleteProgram(id);
}

void Program::use() const {
    glUseProgram(id());
}

int Program::location(std::string_view name) const {
    const auto known = m_locations.find(name);
    if (known != m_locations.end())
        return known->second;
    std::string text(name);
    const int found = glGetUniformLocation(id(), text.c_str());
    m_locations.emplace(std::move(text), found);
    return found;
}

void Program::set(std::string_view name, int value) const {
    glProgramUniform1i(id(), location(name), value);
}
void Program::set(std::string_view name, unsigned value) const {
    glProgramUniform1ui(id(), location(name), value);
}
void Program::set(std::string_view name, float value) const {
    glProgramUniform1f(id(), location(name), value);
}
void Program::set(std::string_view name, const glm::vec2& value) const {
    glProgramUniform2fv(id(), location(name), 1, &value[0]);
}
void Program::set(std::string_view name, const glm::ivec2& value) const {
    glProgramUniform2iv(id(), location(name), 1, &value[0]);
}
void Program::set(std::string_view name, const glm::vec3& value) const {
    glProgramUniform3fv(id(), location(name), 1, &value[0]);
}
void Program::set(std::string_view name, const glm::vec4& value) const {
    glProgramUniform4fv(id(), location(name), 1, &value[0]);
}
void Program::set(std::string_view name, const glm::mat3& value) const {
    glProgramUniformMatrix3fv(id(), location(name), 1, GL_FALSE, &value[0][0]);
}
void Program::set(std::string_view name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, &value[0][0]);
}

}  // namespace reflet
