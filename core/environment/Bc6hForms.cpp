// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/Bc6hForms.h"

#include <algorithm>
#include <cstdlib>

namespace reflet::bc6h {

namespace {

constexpr int kLowBits = 10;  // of a first colour's channel; those above follow the second's

/// Bits in the order in which blocks hold them, the lowest of the first byte first.
class BitWriter {
public:
    void put(unsigned value, int count) {
        for (int i = 0; i < count; ++i, ++m_place)
            m_block[m_place / 8] |= std::uint8_t((value >> unsigned(i) & 1U) << m_place % 8);
    }
    [[nodiscard]] const Bc6hBlock& block() const { return m_block; }

private:
    Bc6hBlock m_block{};
    std::size_t m_place = 0;
};

class BitReader {
public:
    explicit BitReader(const Bc6hBlock& block) : m_block(block) {}
    [[nodiscard]] unsigned take(int count) {
        unsigned value = 0;
        for (int i = 0; i < count; ++i, ++m_place)
            value |= (unsigned(m_block[m_place / 8]) >> m_place % 8 & 1U) << unsigned(i);
        return value;
    }

private:
    const Bc6hBlock& m_block;
    std::size_t m_place = 0;
};

int secondBits(const Form& form) {
    return form.deltaBits > 0 ? form.deltaBits : form.bits;
}

}  // namespace

bool fits(const Form& form, const Parts& parts) {
    if (form.deltaBits == 0)
        return true;
    // Either may come first: as many steps down as up.
    const int most = (1 << (form.deltaBits - 1)) - 1;
    for (std::size_t c = 0; c < 3; ++c) {
        if (std::abs(parts.second[c] - parts.first[c]) > most)
            return false;
    }
    return true;
}

Bc6hBlock pack(const Form& form, const Parts& parts) {
    BitWriter writer;
    writer.put(form.code, 5);
    for (const int channel : parts.first)
        writer.put(unsigned(channel), kLowBits);
    for (std::size_t c = 0; c < 3; ++c) {
        const int second = form.deltaBits > 0 ? parts.second[c] - parts.first[c] : parts.second[c];
        writer.put(unsigned(second), secondBits(form));
        for (int bit = form.bits - 1; bit >= kLowBits; --bit)
            writer.put(unsigned(parts.first[c]) >> unsigned(bit), 1);
    }
    for (std::size_t i = 0; i < parts.steps.size(); ++i)
        writer.put(parts.steps[i], i == 0 ? 3 : 4);
    return writer.block();
}

const Form* formOf(const Bc6hBlock& block) {
    const auto* form = std::find_if(kForms.begin(), kForms.end(), [&](const Form& each) {
        return each.code == (block[0] & 31U);
    });
    return form == kForms.end() ? nullptr : form;
}

Parts unpack(const Form& form, const Bc6hBlock& block) {
    BitReader reader(block);
    static_cast<void>(reader.take(5));
    Parts parts;
    for (int& channel : parts.first)
        channel = int(reader.take(kLowBits));
    for (std::size_t c = 0; c < 3; ++c) {
        parts.second[c] = int(reader.take(secondBits(form)));
        for (int bit = form.bits - 1; bit >= kLowBits; --bit)
            parts.first[c] |= int(reader.take(1) << unsigned(bit));
        if (form.deltaBits > 0) {
            const int sign = 1 << (form.deltaBits - 1);
            const int delta = (parts.second[c] ^ sign) - sign;
            parts.second[c] = (parts.first[c] + delta) & ((1 << form.bits) - 1);
        }
    }
    for (std::size_t i = 0; i < parts.steps.size(); ++i)
        parts.steps[i] = std::uint8_t(reader.take(i == 0 ? 3 : 4));
    return parts;
}

}  // namespace reflet::bc6h
