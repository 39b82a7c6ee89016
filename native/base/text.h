// Wording of messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fairing {

// The number with the phrase that goes with it.
inline std::string counted(std::size_t count, std::string_view one, std::string_view many) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

}  // namespace fairing
