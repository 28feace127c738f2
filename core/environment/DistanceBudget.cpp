// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/DistanceBudget.h"

#include <algorithm>

namespace reflet {

using namespace distance_forms;

namespace {

/// Something that entries can be spent on.
struct Wish {
    enum class What { Plane, Mixture, List } what;
    std::size_t face, index;
    std::size_t entries;
    float gain;  ///< metres of error, over all texels that it concerns

    [[nodiscard]] float worth() const { return gain / float(entries); }
};

std::vector<Wish> wishesOf(const std::vector<DistanceFacePlan>& faces) {
    std::vector<Wish> wishes;
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const auto& planes = faces[face].planes();
        for (std::size_t i = 0; i < planes.size(); ++i)
            wishes.push_back({Wish::What::Plane, face, i, 1, planes[i].harm});
        const auto& blocks = faces[face].blocks();
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            if (!blocks[i].mixture)
                continue;
            const DistanceFacePlan::Mixture& mixture = *blocks[i].mixture;
            const float gain = std::max(blocks[i].roughError - mixture.error, 0.0f);
            if (mixture.isRight || gain > 0.0f)
                wishes.push_back({Wish::What::Mixture, face, i, kSharedEntries, gain});
            if (!mixture.isRight)
                wishes.push_back({Wish::What::List, face, i, kListedEntries, blocks[i].roughError});
        }
    }
    // Equal ones in their order, so that the answer is the same everywhere.
    std::stable_sort(wishes.begin(), wishes.end(),
                     [](const Wish& a, const Wish& b) { return a.worth() > b.worth(); });
    return wishes;
}

}  // namespace

DistanceBudget::DistanceBudget(const std::vector<DistanceFacePlan>& faces, std::size_t capacity) {
    for (const DistanceFacePlan& face : faces) {
        hasPlane.emplace_back(face.planes().size(), 0);
        form.emplace_back(face.blocks().size(), Form::Rough);
    }
    std::size_t left = capacity;
    for (const Wish& wish : wishesOf(faces)) {
        // A list takes the place of a mixture.
        const bool replaces =
            wish.what == Wish::What::List && form[wish.face][wish.index] == Form::Shared;
        const std::size_t price = wish.entries - (replaces ? std::size_t(kSharedEntries) : 0);
        const bool listed =
            wish.what == Wish::What::Mixture && form[wish.face][wish.index] == Form::Listed;
        if (price > left || listed)
            continue;
        left -= price;
        if (wish.what == Wish::What::Plane)
            hasPlane[wish.face][wish.index] = 1;
        else
            form[wish.face][wish.index] =
                wish.what == Wish::What::List ? Form::Listed : Form::Shared;
    }
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const auto& blocks = faces[face].blocks();
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            Form& mine = form[face][i];
            if (blocks[i].plane && hasPlane[face][*blocks[i].plane] != 0)
                mine = Form::Plane;
            // A plane that a mixture needs may have come too late.
            if (mine == Form::Shared &&
                !std::all_of(blocks[i].mixture->planes.begin(), blocks[i].mixture->planes.end(),
                             [&](std::size_t plane) { return hasPlane[face][plane] != 0; }))
                mine = Form::Rough;
        }
    }
}

}  // namespace reflet
