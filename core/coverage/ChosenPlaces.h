// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coverage/Placement.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// A set of rows of a table of services, with what the next one adds and each one is worth. Sums
/// are over samples, not yet divided by their number.
class ChosenPlaces {
public:
    ChosenPlaces(const ServiceTable& table, double secondShare);

    void add(std::size_t row);
    void remove(std::size_t row);
    [[nodiscard]] bool contains(std::size_t row) const { return m_chosen[row] != 0; }

    /// What a row that is not in the set adds to the worth.
    [[nodiscard]] double gain(std::size_t row) const;
    /// The gains of all rows, 0 for those in the set; in parallel.
    [[nodiscard]] std::vector<double> gains() const;
    /// What the worth loses without a row of the set, and the coverage.
    struct Loss {
        double worth = 0.0, coverage = 0.0;
    };
    [[nodiscard]] Loss loss(std::size_t row) const;

    [[nodiscard]] double worth() const;
    [[nodiscard]] double coverage() const;
    [[nodiscard]] float best(std::size_t sample) const { return m_best[sample]; }
    [[nodiscard]] float second(std::size_t sample) const { return m_second[sample]; }

private:
    struct Server {
        float service = 0.0F;
        std::uint32_t row = 0;
    };
    void refresh(std::size_t sample);

    const ServiceTable& m_table;
    double m_first, m_next;  ///< what the best and the second best service count
    std::vector<unsigned char> m_chosen;
    std::vector<std::vector<Server>> m_servers;  ///< by sample; best first, then by row
    std::vector<float> m_best, m_second;
};

}  // namespace reflet
