// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <memory>
#include <vector>

namespace reflet {

/// A texture with its chain of halved copies, averaged in linear light, so that a far wall gets
/// the mean of what a texel covers.
class MipTexture {
public:
    MipTexture() = default;
    /// An image whose size and bytes disagree counts as empty.
    MipTexture(TextureImage image, bool repeat);
    /// The same of an image that others use too: only the halved copies take memory.
    MipTexture(std::shared_ptr<const TextureImage> image, bool repeat);

    [[nodiscard]] bool empty() const { return m_levels.empty(); }
    /// From the whole image down to one texel, each half of the one before (rounded down).
    [[nodiscard]] const std::vector<std::shared_ptr<const TextureImage>>& levels() const {
        return m_levels;
    }
    /// Linear colour and alpha at uv (v up), averaged over the parallelogram that the two axes span
    /// around it (in uv): trilinear, with up to eight taps along the longer axis.
    [[nodiscard]] glm::vec4 sample(const glm::vec2& uv, const glm::vec2& axisA,
                                   const glm::vec2& axisB) const;
    /// The mean of the whole image.
    [[nodiscard]] glm::vec4 mean() const;

private:
    [[nodiscard]] glm::vec4 texel(const TextureImage& level, int x, int y) const;
    [[nodiscard]] glm::vec4 bilinear(std::size_t level, const glm::vec2& uv) const;

    std::vector<std::shared_ptr<const TextureImage>> m_levels;  ///< none is null
    bool m_repeat = true;
};

}  // namespace reflet
