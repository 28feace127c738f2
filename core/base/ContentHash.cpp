// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ContentHash.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace reflet {

namespace {
XXH3_state_t* stateOf(void* state) {
    return static_cast<XXH3_state_t*>(state);
}
}  // namespace

ContentHash::ContentHash() : m_state(XXH3_createState()) {
    XXH3_128bits_reset(stateOf(m_state));
}

ContentHash::~ContentHash() {
    XXH3_freeState(stateOf(m_state));
}

ContentHash& ContentHash::add(std::string_view text) {
    return addBytes(std::as_bytes(std::span(text.data(), text.size())));
}

ContentHash& ContentHash::addBytes(std::span<const std::byte> bytes) {
    return beginBytes(bytes.size()).continueBytes(bytes);
}

ContentHash& ContentHash::beginBytes(std::uint64_t size) {
    XXH3_128bits_update(stateOf(m_state), &size, sizeof size);
    return *this;
}

ContentHash& ContentHash::continueBytes(std::span<const std::byte> part) {
    XXH3_128bits_update(stateOf(m_state), part.data(), part.size());
    return *this;
}

std::string ContentHash::hex() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(stateOf(m_state));
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace reflet
