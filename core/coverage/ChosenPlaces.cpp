// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/ChosenPlaces.h"

#include "core/base/ParallelFor.h"

#include <algorithm>
#include <cassert>

namespace reflet {

ChosenPlaces::ChosenPlaces(const ServiceTable& table, double secondShare)
    : m_table(table),
      m_first(1.0 - secondShare),
      m_next(secondShare),
      m_chosen(table.rows.size(), 0),
      m_servers(table.samples),
      m_best(table.samples, 0.0F),
      m_second(table.samples, 0.0F) {
    assert(secondShare >= 0.0 && secondShare <= 0.5);
}

void ChosenPlaces::refresh(std::size_t sample) {
    const auto& servers = m_servers[sample];
    m_best[sample] = servers.empty() ? 0.0F : servers[0].service;
    m_second[sample] = servers.size() > 1 ? servers[1].service : 0.0F;
}

void ChosenPlaces::add(std::size_t row) {
    if (contains(row))
        return;
    m_chosen[row] = 1;
    for (const ServiceRow::Entry& entry : m_table.rows[row].entries) {
        auto& servers = m_servers[entry.sample];
        const Server server{entry.service, std::uint32_t(row)};
        const auto before = [](const Server& x, const Server& y) {
            return x.service != y.service ? x.service > y.service : x.row < y.row;
        };
        servers.insert(std::upper_bound(servers.begin(), servers.end(), server, before), server);
        refresh(entry.sample);
    }
}

void ChosenPlaces::remove(std::size_t row) {
    if (!contains(row))
        return;
    m_chosen[row] = 0;
    for (const ServiceRow::Entry& entry : m_table.rows[row].entries) {
        std::erase_if(m_servers[entry.sample], [&](const Server& s) { return s.row == row; });
        refresh(entry.sample);
    }
}

double ChosenPlaces::gain(std::size_t row) const {
    double sum = 0.0;
    for (const ServiceRow::Entry& entry : m_table.rows[row].entries) {
        const double best = double(m_best[entry.sample]);
        const double second = double(m_second[entry.sample]);
        const double service = double(entry.service);
        if (service > best)
            sum += m_first * (service - best) + m_next * (best - second);
        else if (service > second)
            sum += m_next * (service - second);
    }
    return sum;
}

std::vector<double> ChosenPlaces::gains() const {
    std::vector<double> gains(m_table.rows.size(), 0.0);
    parallelFor(0, gains.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            if (!contains(row))
                gains[row] = gain(row);
        }
    });
    return gains;
}

ChosenPlaces::Loss ChosenPlaces::loss(std::size_t row) const {
    Loss loss;
    for (const ServiceRow::Entry& entry : m_table.rows[row].entries) {
        const auto& servers = m_servers[entry.sample];
        const auto service = [&](std::size_t k) {
            return k < servers.size() ? double(servers[k].service) : 0.0;
        };
        if (servers[0].row == row) {
            loss.coverage += service(0) - service(1);
            loss.worth += m_first * (service(0) - service(1)) + m_next * (service(1) - service(2));
        } else if (servers[1].row == row) {
            loss.worth += m_next * (service(1) - service(2));
        }
    }
    return loss;
}

double ChosenPlaces::worth() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < m_best.size(); ++i)
        sum += m_first * double(m_best[i]) + m_next * double(m_second[i]);
    return sum;
}

double ChosenPlaces::coverage() const {
    double sum = 0.0;
    for (const float best : m_best)
        sum += double(best);
    return sum;
}

}  // namespace reflet
