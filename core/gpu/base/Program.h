// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <map>
#include <string>
#include <string_view>

namespace reflet {

void deleteProgram(unsigned id);

/// A linked program. Made by makeProgram() (ShaderLibrary.h).
class Program : public GlName<deleteProgram> {
public:
    Program() = default;
    explicit Program(unsigned id) : GlName(id) {}

    void use() const;
    /// Sets a uniform; one that the linker has dropped is passed over.
    void set(std::string_view name, int value) const;
    void set(std::string_view name, unsigned value) const;
    void set(std::string_view name, float value) const;
    void set(std::string_view name, const glm::vec2& value) const;
    void set(std::string_view name, const glm::ivec2& value) const;
    void set(std::string_view name, const glm::vec3& value) const;
    void set(std::string_view name, const glm::vec4& value) const;
    void set(std::string_view name, const glm::mat3& value) const;
    void set(std::string_view name, const glm::mat4& value) const;

private:
    [[nodiscard]] int location(std::string_view name) const;
    mutable std::map<std::string, int, std::less<>> m_locations;
};

}  // namespace reflet
